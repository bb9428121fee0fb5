//! Makes the parts of a scene: each node that is shown, and each instance of it.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};

use super::buffers::Buffers;
use super::nodes::{self, Hierarchy};
use super::{instancing, mesh, pose};
use crate::error::Error;
use crate::scene::{Geometry, Material, Part, Scene};

/// Most parts a scene may have: instances cost a file almost nothing.
const MOST_PARTS: usize = 10_000_000;

/// Coordinates beyond this would overflow where they are multiplied with one another.
const LARGEST_COORDINATE: f64 = 1e50;

/// A mesh as a node shows it: with its weights, and with its skin.
type Shown = (usize, Option<usize>, Vec<u64>);

/// Adds geometries and parts to the scene; each mesh is stored once for each pose it is shown in.
pub fn add(scene: &mut Scene, buffers: &Buffers, nodes: &Hierarchy) -> Result<(), Error> {
    let mut known: BTreeMap<Shown, usize> = BTreeMap::new();
    let mut reach: Vec<DVec3> = Vec::new();
    for &index in &nodes.shown {
        let (Some(node), Some(&world)) = (buffers.root.nodes.get(index), nodes.world.get(index)) else {
            continue;
        };
        let Some(number) = node.mesh else { continue };
        let here = |error: Error| match error.place {
            Some(_) => error,
            None => error.at(format!("node {index}")),
        };
        let weights = match (&node.weights, buffers.root.meshes.get(number)) {
            (Some(weights), _) => weights,
            (None, Some(mesh)) => &mesh.weights,
            (None, None) => {
                let message = format!("has mesh {number}, but the file has {}", buffers.root.meshes.len());
                return Err(here(Error::new(message)));
            }
        };
        let key: Shown = (number, node.skin, weights.iter().map(|weight| weight.to_bits()).collect());
        let geometry = match known.get(&key) {
            Some(geometry) => *geometry,
            None => {
                let joints = node.skin.map(|skin| pose::joints(buffers, nodes, skin)).transpose()?;
                let made = mesh::geometry(buffers, number, weights, joints.as_deref(), &mut scene.warnings)?;
                reach
                    .push(made.positions.iter().fold(DVec3::ZERO, |most, position| most.max(position.abs())));
                scene.geometries.push(made);
                known.insert(key, scene.geometries.len() - 1);
                scene.geometries.len() - 1
            }
        };
        // The joints have carried a skinned mesh into the world already.
        let world = if node.skin.is_some() { DAffine3::IDENTITY } else { world };
        let places = match &node.extensions.instancing {
            Some(instancing) => instancing::places(buffers, instancing).map_err(here)?,
            None => vec![DAffine3::IDENTITY],
        };
        if scene.parts.len().saturating_add(places.len()) > MOST_PARTS {
            return Err(here(Error::new(format!("the scene has more than {MOST_PARTS} instances"))));
        }
        let reach = reach.get(geometry).copied().unwrap_or_default();
        for place in places {
            let world_from_part = world * place;
            check_size(world_from_part, reach).map_err(here)?;
            scene.parts.push(Part { name: nodes::name(buffers.root, index), geometry, world_from_part });
        }
    }
    drop_empty(scene);
    if scene.parts.is_empty() {
        let nodes = nodes.shown.len();
        return Err(Error::new(format!(
            "nothing to draw: no triangle and no line in the {nodes} nodes of the scene"
        )));
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
    if farthest <= LARGEST_COORDINATE {
        return Ok(());
    }
    Err(Error::new(format!("its coordinates reach {farthest:e}, beyond {LARGEST_COORDINATE:e}"))
        .remedy("scale the model down"))
}

/// Drops parts that show neither triangles nor lines.
fn drop_empty(scene: &mut Scene) {
    let empty = |geometry: &Geometry| geometry.triangles.is_empty() && geometry.wires.is_empty();
    let mut new_index = Vec::with_capacity(scene.geometries.len());
    let mut next = 0;
    for geometry in &scene.geometries {
        new_index.push((!empty(geometry)).then_some(next));
        next += usize::from(!empty(geometry));
    }
    scene.parts.retain_mut(|part| match new_index.get(part.geometry).copied().flatten() {
        Some(index) => {
            part.geometry = index;
            true
        }
        None => false,
    });
    scene.geometries.retain(|geometry| !empty(geometry));
}
