//! [`Rig`]: everything that animates a scene: nodes, skins, bodies and clips.

use glam::{DAffine3, DQuat, DVec3};

use super::clip::{Clip, NodeProperty, Playing};
use super::deformable_mesh::DeformableMesh;
use super::material_factors::MaterialFactors;

/// Everything that animates a scene.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rig {
    /// Nodes, by their index in the file.
    pub nodes: Vec<Node>,
    /// Indices of all nodes, parents before children.
    pub order: Vec<usize>,
    /// Skins.
    pub skins: Vec<Skin>,
    /// For each geometry of the scene, its deformable vertices.
    pub forms: Vec<GeometryRig>,
    /// For each part of the scene, its node and its transform relative to the node.
    pub parts: Vec<(usize, DAffine3)>,
    /// For each camera of the scene, its number in the file and its node.
    pub cameras: Vec<NodeAttachment>,
    /// The same for each light.
    pub lights: Vec<NodeAttachment>,
    /// Values of the materials of the file.
    pub materials: Vec<MaterialFactors>,
    /// Animations of the file.
    pub clips: Vec<Clip>,
}

/// A camera or a light that a node holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NodeAttachment {
    /// Number of the camera or light in the file; several nodes may hold the same one.
    pub number: usize,
    /// The node that holds it.
    pub node: usize,
}

/// A node of the hierarchy.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    /// Its name.
    pub name: String,
    /// Whether the file requests motion lines for it and its descendants.
    pub leaves_lines: bool,
    /// Index of the parent.
    pub parent: Option<usize>,
    /// Rest transform relative to the parent.
    pub rest: Placement,
    /// Rest weights of the morph targets of its mesh.
    pub weights: Vec<f64>,
    /// Whether it is visible at rest.
    pub visible: bool,
}

/// Transform relative to a parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Placement {
    /// A matrix; clips cannot animate it.
    Matrix(DAffine3),
    /// Scale, then rotation, then translation.
    Parts {
        /// Translation.
        translation: DVec3,
        /// Rotation, a unit quaternion.
        rotation: DQuat,
        /// Scale along the axes.
        scale: DVec3,
    },
}

impl Placement {
    /// The transform as a matrix.
    #[must_use]
    pub(crate) fn transform(&self) -> DAffine3 {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }

    /// Translation, rotation and scale. Shear of a matrix is lost.
    fn parts(&self) -> (DVec3, DQuat, DVec3) {
        match *self {
            Self::Matrix(matrix) => {
                let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
                (translation, rotation, scale)
            }
            Self::Parts { translation, rotation, scale } => (translation, rotation, scale),
        }
    }
}

/// Joints of a skinned mesh.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Skin {
    /// Node indices of the joints.
    pub joints: Vec<usize>,
    /// Inverse bind matrix of each joint.
    pub binds: Vec<DAffine3>,
}

impl Skin {
    /// Transform from rest position to world space for each joint, given the world transforms of all nodes.
    #[must_use]
    pub(crate) fn transforms(&self, world: &[DAffine3]) -> Vec<DAffine3> {
        let own = |joint: &usize| world.get(*joint).copied().unwrap_or(DAffine3::IDENTITY);
        self.joints.iter().zip(&self.binds).map(|(joint, bind)| own(joint) * *bind).collect()
    }
}

/// Deformable vertices of a geometry.
#[derive(Debug, Clone, Default)]
pub(crate) struct GeometryRig {
    /// Node that holds its weights and skin.
    pub node: usize,
    /// Number of its skin.
    pub skin: Option<usize>,
    /// Its vertices; empty if they do not deform.
    pub bodies: Vec<DeformableMesh>,
}

/// World transforms, morph weights and visibility of all nodes at a moment.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodePoses {
    pub world: Vec<DAffine3>,
    pub weights: Vec<Vec<f64>>,
    pub visible: Vec<bool>,
}

impl Rig {
    /// Pose of the nodes while clips play.
    pub(crate) fn stance(&self, playing: &[Playing]) -> NodePoses {
        let mut weights: Vec<Vec<f64>> = self.nodes.iter().map(|node| node.weights.clone()).collect();
        let mut visible: Vec<bool> = self.nodes.iter().map(|node| node.visible).collect();
        let mut local: Vec<DAffine3> = self.nodes.iter().map(|node| node.rest.transform()).collect();
        for (number, moved) in self.moved(playing) {
            let node = &self.nodes[number];
            let of = |property: NodeProperty| {
                moved.iter().filter(move |(moved_property, ..)| *moved_property == property)
            };
            let (translation, rotation, scale) = node.rest.parts();
            let vector = |property, rest: DVec3| {
                let values = of(property).filter_map(|(_, track, time, weight)| {
                    Some((DVec3::from_array(track.at(*time).try_into().ok()?), *weight))
                });
                blend_values(rest, values)
            };
            let moves = |property| of(property).next().is_some();
            if [NodeProperty::Translation, NodeProperty::Rotation, NodeProperty::Scale].into_iter().any(moves)
            {
                let rotations = of(NodeProperty::Rotation)
                    .filter_map(|(_, track, time, weight)| Some((track.rotation_at(*time)?, *weight)));
                local[number] = DAffine3::from_scale_rotation_translation(
                    vector(NodeProperty::Scale, scale),
                    blend_rotations(rotation, rotations),
                    vector(NodeProperty::Translation, translation),
                );
            }
            if moves(NodeProperty::Weights) {
                for (target, target_weight) in weights[number].iter_mut().enumerate() {
                    let values = of(NodeProperty::Weights).filter_map(|(_, track, time, weight)| {
                        Some((*track.at(*time).get(target)?, *weight))
                    });
                    *target_weight = blend_values(*target_weight, values);
                }
            }
            if let Some((_, track, time, _)) = of(NodeProperty::Visible).max_by(|a, b| a.3.total_cmp(&b.3)) {
                visible[number] = track.at(*time).first().is_none_or(|value| *value != 0.0);
            }
        }
        let mut world = vec![DAffine3::IDENTITY; self.nodes.len()];
        for &number in &self.order {
            let parent = self.nodes[number].parent;
            world[number] = parent.map_or(DAffine3::IDENTITY, |parent| world[parent]) * local[number];
            visible[number] &= parent.is_none_or(|parent| visible[parent]);
        }
        NodePoses { world, weights, visible }
    }

    /// Nodes that clips animate, with their tracks, times and weights.
    fn moved(&self, playing: &[Playing]) -> std::collections::BTreeMap<usize, Vec<Moved<'_>>> {
        let mut moved: std::collections::BTreeMap<usize, Vec<Moved<'_>>> = std::collections::BTreeMap::new();
        for Playing { clip, time, weight } in playing.iter().filter(|playing| playing.weight > 0.0) {
            for channel in self.clips.get(*clip).into_iter().flat_map(|clip| &clip.channels) {
                let Some((node, property)) = channel.target.of_node() else { continue };
                moved.entry(node).or_default().push((property, &channel.track, *time, *weight));
            }
        }
        moved
    }
}

/// Property, track, time and weight.
type Moved<'a> = (NodeProperty, &'a super::track::Track, f64, f64);

/// Weighted mean of values. If the weights add up to less than 1, the rest value has the remainder.
pub(crate) fn blend_values<T>(rest: T, values: impl Iterator<Item = (T, f64)>) -> T
where
    T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T> + Copy,
{
    let mut sum: Option<(T, f64)> = None;
    let mut alone = None;
    for (value, weight) in values {
        alone = if sum.is_none() { Some(value) } else { None };
        sum =
            Some(sum.map_or((value * weight, weight), |(so_far, total)| {
                (so_far + value * weight, total + weight)
            }));
    }
    match (sum, alone) {
        (None, _) => rest,
        // A single value at full weight stays bit-identical.
        (Some((_, total)), Some(value)) if total >= 1.0 => value,
        (Some((sum, total)), _) if total >= 1.0 => sum * (1.0 / total),
        (Some((sum, total)), _) => sum + rest * (1.0 - total),
    }
}

/// Weighted mean of rotations: normalised, each on the same hemisphere as the first.
fn blend_rotations(rest: DQuat, turns: impl Iterator<Item = (DQuat, f64)>) -> DQuat {
    let mut first = None;
    let near = turns.map(|(turn, weight)| {
        let to = *first.get_or_insert(turn);
        (if to.dot(turn) < 0.0 { -turn } else { turn }, weight)
    });
    let all: Vec<(DQuat, f64)> = near.collect();
    let Some(first) = first else { return rest };
    let rest = if first.dot(rest) < 0.0 { -rest } else { rest };
    let mean = blend_values(rest, all.into_iter());
    if mean.length_squared() > 0.0 { mean.normalize() } else { first }
}
