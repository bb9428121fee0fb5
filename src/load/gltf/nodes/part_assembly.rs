//! Makes the parts of a scene: one for each visible node with a mesh, and for each instance of it.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use glam::{DAffine3, DVec3};

use super::hierarchy::{self, Hierarchy};
use super::instances;
use crate::animation::rig::{GeometryRig, Skin};
use crate::animation::{NodeProperty, Rig};
use crate::error::{Error, ErrorKind};
use crate::load::gltf::json::lenient_index::DisplayIndex;
use crate::load::gltf::meshes::{mesh_geometry, skin_and_morphs};
use crate::load::gltf::missing_references::MissingReferences;
use crate::load::gltf::storage::buffers::Buffers;
use crate::scene::{Geometry, Material, Part, Scene, Warnings, nothing_to_draw};

/// Maximum number of parts, as instances take almost no space in a file.
const MAX_PARTS: usize = 10_000_000;

/// Maximum world coordinate; products of larger ones overflow.
const MAX_WORLD_COORDINATE: f64 = 1e50;

/// Identity of a geometry: mesh, skin, bits of the weights; and the node, if its weights are animated.
type GeometryKey = (usize, Option<usize>, Vec<u64>, Option<usize>);

/// Adds geometries and parts to the scene; each mesh is stored once for each pose. With clips, the rig is
/// filled as well.
pub(crate) fn add(
    scene: &mut Scene,
    rig: &mut Rig,
    buffers: &Buffers,
    nodes: &Hierarchy,
) -> Result<(), Error> {
    let rigged = !rig.clips.is_empty();
    let mut morphing = vec![false; nodes.rest.len()];
    for channel in rig.clips.iter().flat_map(|clip| &clip.channels) {
        let Some((node, NodeProperty::Weights)) = channel.target.of_node() else { continue };
        if let Some(is_morphing) = morphing.get_mut(node) {
            *is_morphing = true;
        }
    }
    let mut skins: BTreeMap<usize, Skin> = BTreeMap::new();
    let mut geometry_of_key: BTreeMap<GeometryKey, usize> = BTreeMap::new();
    let mut reach: Vec<DVec3> = Vec::new();
    let mut missing = MissingReferences::default();
    let no_weights: Vec<f64> = Vec::new();
    for &index in &nodes.shown {
        let (Some(node), Some(&world)) = (buffers.root.nodes.get(index), nodes.world.get(index)) else {
            continue;
        };
        let Some(number) = node.mesh else { continue };
        let in_node = |error: Error| error.within(format!("node {index}"));
        let weights = match (&node.weights, buffers.root.meshes.get(number)) {
            (Some(weights), _) => weights,
            (None, Some(mesh)) => &mesh.weights,
            (None, None) => &no_weights,
        };
        if number >= buffers.root.meshes.len() {
            missing.meshes.add(|| {
                let (name, number, count) =
                    (hierarchy::name(buffers.root, index), DisplayIndex(number), buffers.root.meshes.len());
                format!("node {index}: has mesh {number}, but the file has {count}; `{name}` is left out")
            });
            continue;
        }
        let skin = node.skin.filter(|skin| *skin < buffers.root.skins.len());
        if let (Some(number), None) = (node.skin, skin) {
            missing.skins.add(|| {
                let (number, count) = (DisplayIndex(number), buffers.root.skins.len());
                format!(
                    "node {index}: has skin {number}, but the file has {count}; it is drawn as if it had none"
                )
            });
        }
        let morphing_node = Some(index).filter(|_| morphing.get(index).copied().unwrap_or(false));
        let key: GeometryKey =
            (number, skin, weights.iter().map(|weight| weight.to_bits()).collect(), morphing_node);
        let geometry = match geometry_of_key.get(&key) {
            Some(geometry) => *geometry,
            None => {
                let joints = match skin {
                    Some(skin) => {
                        let loaded_skin = match skins.entry(skin) {
                            Entry::Occupied(known) => known.into_mut(),
                            Entry::Vacant(new) => new.insert(skin_and_morphs::skin(buffers, skin)?),
                        };
                        Some(loaded_skin.transforms(&nodes.world))
                    }
                    None => None,
                };
                let deformation = (weights.as_slice(), joints.as_deref(), rigged);
                let (new_geometry, bodies) =
                    mesh_geometry::geometry(buffers, number, deformation, &mut scene.warnings, &mut missing)?;
                if rigged {
                    rig.forms.push(GeometryRig { node: index, skin, bodies });
                }
                reach.push(
                    new_geometry
                        .positions
                        .iter()
                        .fold(DVec3::ZERO, |max_corner, position| max_corner.max(position.abs())),
                );
                scene.geometries.push(new_geometry);
                geometry_of_key.insert(key, scene.geometries.len() - 1);
                scene.geometries.len() - 1
            }
        };
        // The joints already transform a skinned mesh to world space.
        let world = if skin.is_some() { DAffine3::IDENTITY } else { world };
        let instance_transforms = match &node.extensions.instancing {
            Some(instancing) => instances::places(buffers, instancing).map_err(in_node)?,
            None => vec![DAffine3::IDENTITY],
        };
        if scene.parts.len().saturating_add(instance_transforms.len()) > MAX_PARTS {
            return Err(in_node(Error::new(format!("the scene has more than {MAX_PARTS} instances"))));
        }
        let reach = reach.get(geometry).copied().unwrap_or_default();
        for instance_transform in instance_transforms {
            let world_from_part = world * instance_transform;
            check_size(world_from_part, reach).map_err(in_node)?;
            scene.parts.push(Part { name: hierarchy::name(buffers.root, index), geometry, world_from_part });
            if rigged {
                rig.parts.push((index, instance_transform));
            }
        }
    }
    drop_empty(scene, rig);
    let mut lost = Warnings::default();
    missing.warn(&mut lost);
    scene.warnings.extend(&lost);
    if rigged {
        let skin_count = skins.keys().last().map_or(0, |skin| skin + 1);
        let none = Skin { joints: Vec::new(), binds: Vec::new() };
        rig.skins = (0..skin_count).map(|skin| skins.remove(&skin).unwrap_or_else(|| none.clone())).collect();
    }
    if scene.parts.is_empty() {
        if let [first, ..] = lost.lines().as_slice() {
            return Err(Error::new(format!("{first}; nothing to draw")).of_kind(ErrorKind::Empty));
        }
        let meshes = || nodes.shown.iter().filter_map(|node| buffers.root.nodes.get(*node)?.mesh);
        if meshes().next().is_some() {
            let shown = meshes().filter_map(|mesh| buffers.root.meshes.get(mesh));
            let has_points =
                shown.flat_map(|mesh| &mesh.primitives).any(|primitive| primitive.mode == Some(0));
            return Err(nothing_to_draw(&scene.warnings, has_points));
        }
        let nodes = nodes.shown.len();
        let message = format!("nothing to draw: no mesh in the {nodes} nodes of the scene");
        return Err(Error::new(message).of_kind(ErrorKind::Empty));
    }
    if scene
        .geometries
        .iter()
        .any(|geometry| geometry.triangle_material.contains(&(scene.materials.len() as u32)))
    {
        scene.materials.push(Material::default());
    }
    Ok(())
}

fn check_size(world_from_part: DAffine3, reach: DVec3) -> Result<(), Error> {
    let m = world_from_part.matrix3;
    let farthest = m.x_axis.abs() * reach.x + m.y_axis.abs() * reach.y + m.z_axis.abs() * reach.z;
    let farthest = (farthest + world_from_part.translation.abs()).max_element();
    if farthest <= MAX_WORLD_COORDINATE {
        return Ok(());
    }
    Err(Error::new(format!(
        "its coordinates reach {farthest:e}; at most {MAX_WORLD_COORDINATE:e} is possible"
    ))
    .remedy("scale the model down"))
}

/// Drops parts without triangles and lines, and their entries in the rig.
fn drop_empty(scene: &mut Scene, rig: &mut Rig) {
    let is_empty = |geometry: &Geometry| geometry.triangles.is_empty() && geometry.wires.is_empty();
    let empty: Vec<bool> = scene.geometries.iter().map(is_empty).collect();
    if !empty.contains(&true) {
        return;
    }
    let mut new_index = Vec::with_capacity(empty.len());
    let mut next = 0;
    for is_empty in &empty {
        new_index.push((!is_empty).then_some(next));
        next += usize::from(!is_empty);
    }
    let left = |geometry: usize| new_index.get(geometry).copied().flatten();
    let kept: Vec<bool> = scene.parts.iter().map(|part| left(part.geometry).is_some()).collect();
    mesh_geometry::retain(&mut rig.parts, &kept);
    mesh_geometry::retain(&mut scene.parts, &kept);
    for part in &mut scene.parts {
        part.geometry = left(part.geometry).unwrap_or_default();
    }
    let full: Vec<bool> = empty.iter().map(|is_empty| !is_empty).collect();
    mesh_geometry::retain(&mut rig.forms, &full);
    mesh_geometry::retain(&mut scene.geometries, &full);
}
