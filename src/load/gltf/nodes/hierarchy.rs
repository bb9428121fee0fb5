//! [`Hierarchy`]: the visible nodes of the scene in order, with the world transforms of all nodes.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use serde_json::Value;

use crate::animation::rig::{self, Placement};
use crate::animation::track::unit_quaternion;
use crate::animation::{Clip, NodeProperty};
use crate::error::Error;
use crate::load::gltf::json::{Node, Root};
use crate::scene::Warnings;

/// The nodes of a file, resolved without recursion, so that any depth is possible.
#[derive(Debug)]
pub(crate) struct Hierarchy {
    /// World transform of every node, visible or not: joints of skins may be outside the scene.
    pub world: Vec<DAffine3>,
    /// Nodes of the drawn scene, each once, depth first. With clips, also those that become visible at some
    /// time.
    pub shown: Vec<usize>,
    /// Rest state of all nodes, and their indices with parents first.
    pub rest: Vec<rig::Node>,
    pub order: Vec<usize>,
}

impl Hierarchy {
    /// Resolves the default scene; without one the first scene; without any scene all root nodes.
    pub(crate) fn new(root: &Root, warnings: &mut Warnings) -> Result<Self, Error> {
        let parents = parents(&root.nodes, warnings)?;
        let rest: Vec<rig::Node> = (root.nodes.iter().zip(&parents).enumerate())
            .map(|(index, (node, parent))| rig::Node {
                name: name(root, index),
                leaves_lines: node.extras.get("motion").and_then(Value::as_bool).unwrap_or(false),
                parent: *parent,
                rest: placement(node, index, warnings),
                weights: weights(root, node),
                visible: is_visible(index, node),
            })
            .collect();
        let (world, order) = world_transforms(&root.nodes, &rest)?;
        let shown = shown(root, &rest, is_visible)?;
        if root.scenes.len() > 1 {
            let number = root.scene.unwrap_or(0);
            warnings.note(format!("scene {number} of {} is drawn", root.scenes.len()));
        }
        Ok(Self { world, shown, rest, order })
    }

    /// Adds nodes that are hidden at rest and become visible in a clip.
    pub(crate) fn add_animated_visibility(&mut self, root: &Root, clips: &[Clip]) -> Result<(), Error> {
        let mut wakes = vec![false; root.nodes.len()];
        for channel in clips.iter().flat_map(|clip| &clip.channels) {
            let Some((node, NodeProperty::Visible)) = channel.target.of_node() else { continue };
            if let Some(own) = wakes.get_mut(node) {
                let times = channel.track.times().iter();
                *own |=
                    times.into_iter().any(|time| channel.track.at(*time).iter().any(|value| *value != 0.0));
            }
        }
        if self.rest.iter().zip(&wakes).any(|(node, wakes)| *wakes && !node.visible) {
            self.shown = shown(root, &self.rest, |index, node| {
                is_visible(index, node) || wakes.get(index).copied().unwrap_or(false)
            })?;
        }
        Ok(())
    }
}

/// Nodes of the drawn scene, each once, depth first, without invisible nodes and their descendants.
fn shown(
    root: &Root,
    rest: &[rig::Node],
    is_visible: impl Fn(usize, &Node) -> bool,
) -> Result<Vec<usize>, Error> {
    let number = root.scene.unwrap_or(0);
    let tops = match root.scenes.get(number) {
        Some(scene) => scene.nodes.clone(),
        None if root.scene.is_some() => {
            let message = format!("is the default scene, but the file has {}", root.scenes.len());
            return Err(Error::new(message).at(format!("scene {number}")));
        }
        None => (rest.iter().enumerate())
            .filter(|(_, node)| node.parent.is_none())
            .map(|(index, _)| index)
            .collect(),
    };
    let mut shown = Vec::new();
    let mut met = vec![false; root.nodes.len()];
    let mut waiting: Vec<usize> = tops.into_iter().rev().collect();
    while let Some(index) = waiting.pop() {
        let Some((node, met)) = root.nodes.get(index).zip(met.get_mut(index)) else {
            let message = format!("points to node {index}, but the file has {}", root.nodes.len());
            return Err(Error::new(message).at(format!("scene {number}")));
        };
        if !std::mem::replace(met, true) && is_visible(index, node) {
            shown.push(index);
            waiting.extend(node.children.iter().rev());
        }
    }
    Ok(shown)
}

/// Parent of each node.
pub(crate) fn parents(nodes: &[Node], warnings: &mut Warnings) -> Result<Vec<Option<usize>>, Error> {
    let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        for &child in &node.children {
            let Some(parent) = parents.get_mut(child) else {
                let message = format!("has node {child} as a child, but the file has {}", nodes.len());
                return Err(Error::new(message).at(format!("node {index}")));
            };
            match parent {
                None => *parent = Some(index),
                Some(_) => warnings.count("nodes with more than one parent, drawn under the first", 1),
            }
        }
    }
    Ok(parents)
}

/// World transforms in topological order, and that order. Nodes that are never reached are part of a cycle.
fn world_transforms(nodes: &[Node], rest: &[rig::Node]) -> Result<(Vec<DAffine3>, Vec<usize>), Error> {
    let mut world = vec![None; nodes.len()];
    let mut order = Vec::with_capacity(nodes.len());
    let parent = |node: usize| rest.get(node).and_then(|node| node.parent);
    let mut ready: Vec<usize> = (0..nodes.len()).filter(|node| parent(*node).is_none()).collect();
    while let Some(index) = ready.pop() {
        // A child that its parent lists twice is reached twice.
        let Some(node) = nodes.get(index).filter(|_| matches!(world.get(index), Some(None))) else {
            continue;
        };
        let above = parent(index).and_then(|parent| world.get(parent).copied().flatten());
        let own = rest.get(index).map_or(DAffine3::IDENTITY, |node| node.rest.transform());
        let place = above.unwrap_or(DAffine3::IDENTITY) * own;
        if !place.is_finite() {
            return Err(Error::new("its transform is not finite").at(format!("node {index}")));
        }
        if let Some(slot) = world.get_mut(index) {
            *slot = Some(place);
        }
        order.push(index);
        ready.extend(node.children.iter().filter(|child| parent(**child) == Some(index)));
    }
    let placed: Vec<DAffine3> = world.iter().copied().flatten().collect();
    if placed.len() < nodes.len() {
        let lost = world.iter().position(Option::is_none).unwrap_or_default();
        return Err(Error::new("it is its own ancestor; the nodes form a cycle")
            .at(format!("node {lost}"))
            .remedy("export the model again"));
    }
    Ok((placed, order))
}

fn is_visible(_: usize, node: &Node) -> bool {
    node.extensions.visibility.as_ref().and_then(|v| v.visible).unwrap_or(true)
}

/// Weights of a node's morph targets: one for each target of any primitive of its mesh.
fn weights(root: &Root, node: &Node) -> Vec<f64> {
    let Some(mesh) = node.mesh.and_then(|mesh| root.meshes.get(mesh)) else { return Vec::new() };
    let mut weights = node.weights.as_ref().unwrap_or(&mesh.weights).clone();
    let targets = mesh.primitives.iter().map(|primitive| primitive.targets.len()).max().unwrap_or(0);
    weights.resize(targets.max(weights.len()), 0.0);
    weights
}

/// The transform of a matrix of a file.
pub(crate) fn affine([a, b, c, _, d, e, f, _, g, h, i, _, x, y, z, _]: [f64; 16]) -> DAffine3 {
    DAffine3::from_mat3_translation(DMat3::from_cols_array(&[a, b, c, d, e, f, g, h, i]), DVec3::new(x, y, z))
}

fn placement(node: &Node, index: usize, warnings: &mut Warnings) -> Placement {
    if let Some(m) = node.matrix {
        return Placement::Matrix(affine(m));
    }
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |quaternion| {
        unit_quaternion(quaternion).unwrap_or_else(|| {
            warnings.note(format!("node {index}: its rotation is not a unit quaternion and is ignored"));
            DQuat::IDENTITY
        })
    });
    Placement::Parts {
        scale: node.scale.map_or(DVec3::ONE, DVec3::from_array),
        rotation,
        translation: node.translation.map_or(DVec3::ZERO, DVec3::from_array),
    }
}

/// Name of a node: its own, that of its mesh, or its number.
pub(crate) fn name(root: &Root, index: usize) -> String {
    let node = root.nodes.get(index);
    let mesh = node.and_then(|node| node.mesh).and_then(|mesh| root.meshes.get(mesh));
    let named = |name: &Option<String>| name.clone().filter(|name| !name.is_empty());
    node.and_then(|node| named(&node.name))
        .or_else(|| mesh.and_then(|mesh| named(&mesh.name)))
        .unwrap_or_else(|| format!("node {index}"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn hierarchy(json: &str) -> Result<(Hierarchy, Warnings), Error> {
        let root: Root = serde_json::from_str(json).unwrap();
        let mut warnings = Warnings::default();
        Hierarchy::new(&root, &mut warnings).map(|hierarchy| (hierarchy, warnings))
    }

    #[test]
    fn node_transforms_multiply_down_the_hierarchy() {
        let json = r#"{"scenes":[{"nodes":[0]}],"nodes":[
            {"children":[1],"scale":[2,2,2],"translation":[1,0,0]},
            {"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 0,3,0,1]}, {}]}"#;
        let (hierarchy, warnings) = hierarchy(json).unwrap();
        assert_eq!(hierarchy.shown, [0, 1]);
        assert_eq!(hierarchy.world[1].transform_point3(DVec3::X), DVec3::new(1.0, 8.0, 0.0));
        assert!(warnings.is_empty());
    }

    #[test]
    fn node_cycles_are_refused() {
        let json = r#"{"scenes":[{"nodes":[0]}],"nodes":[{},{"children":[2]},{"children":[1]}]}"#;
        assert!(hierarchy(json).unwrap_err().to_string().contains("cycle"));
        let json = r#"{"nodes":[{"children":[0]}]}"#;
        assert!(hierarchy(json).unwrap_err().to_string().contains("node 0"));
    }

    #[test]
    fn the_default_or_first_scene_is_shown() {
        let nodes = r#""nodes":[{"children":[2]},{},{}]"#;
        let shown = |head: &str| hierarchy(&format!("{{{head}{nodes}}}")).unwrap().0.shown;
        assert_eq!(shown(""), [0, 2, 1]);
        assert_eq!(shown(r#""scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}],"#), [1]);
        assert_eq!(shown(r#""scenes":[{"nodes":[0]},{"nodes":[1]}],"#), [0, 2]);
        assert!(hierarchy(r#"{"scene":3,"scenes":[{}]}"#).is_err());
        assert!(hierarchy(r#"{"scenes":[{"nodes":[7]}]}"#).is_err());
    }

    #[test]
    fn malformed_nodes_are_shown_with_a_warning_and_invisible_ones_hidden() {
        let json = r#"{"nodes":[{"rotation":[0,0,0,0]},{"children":[3]},{"children":[3,3]},{}]}"#;
        let (hierarchy, warnings) = hierarchy(json).unwrap();
        assert_eq!(hierarchy.shown, [0, 1, 3, 2]);
        assert_eq!(warnings.lines().len(), 2);
        let json =
            r#"{"nodes":[{"extensions":{"KHR_node_visibility":{"visible":false}},"children":[1]},{}]}"#;
        assert!(super::tests::hierarchy(json).unwrap().0.shown.is_empty());
    }
}
