//! Reads deformations: the morph targets of a primitive, and the joints of a skin.

use glam::{DAffine3, DVec3};

use super::vertex_streams::VertexStreams;
use crate::animation::DeformableMesh;
use crate::animation::deformable_mesh::{Influences, MorphTarget};
use crate::animation::rig::Skin;
use crate::error::Error;
use crate::load::gltf::json::Primitive;
use crate::load::gltf::nodes::hierarchy::affine;
use crate::load::gltf::storage::buffers::Buffers;

/// Maximum number of sets of four joints per vertex.
const MAX_JOINT_SETS: usize = 16;

/// Joints of a skin, and their inverse bind matrices.
pub(crate) fn skin(buffers: &Buffers, number: usize) -> Result<Skin, Error> {
    let place = |error: Error| error.within(format!("skin {number}"));
    let Some(stored) = buffers.root.skins.get(number) else {
        let message = format!("is pointed to, but the file has {}", buffers.root.skins.len());
        return Err(place(Error::new(message)));
    };
    let mut binds = match stored.inverse_bind_matrices {
        Some(accessor) => buffers.read(accessor, affine).map_err(place)?,
        None => vec![DAffine3::IDENTITY; stored.joints.len()],
    };
    if binds.len() < stored.joints.len() {
        let message = format!("{} joints, but {} inverse bind matrices", stored.joints.len(), binds.len());
        return Err(place(Error::new(message)));
    }
    binds.truncate(stored.joints.len());
    if let Some(node) = stored.joints.iter().find(|joint| **joint >= buffers.root.nodes.len()) {
        return Err(place(Error::new(format!("joint {node} is not a node of the file"))));
    }
    Ok(Skin { joints: stored.joints.clone(), binds })
}

/// Deformations of a primitive: its morph targets (all, or those with a weight), and its joint weights if it
/// has a skin.
pub(crate) fn body(
    streams: &VertexStreams,
    buffers: &Buffers,
    primitive: &Primitive,
    (weights, all): (&[f64], bool),
    joints: Option<usize>,
) -> Result<DeformableMesh, Error> {
    let mut body = DeformableMesh::default();
    for (number, target) in primitive.targets.iter().enumerate() {
        let weight = weights.get(number).copied().unwrap_or(0.0);
        body.targets.push(if all || weight != 0.0 {
            read_target(streams, buffers, target)?
        } else {
            MorphTarget::default()
        });
    }
    if let Some(joints) = joints {
        body.sets = influences(streams.positions.len(), buffers, primitive, joints)?;
    }
    Ok(body)
}

fn read_target(
    streams: &VertexStreams,
    buffers: &Buffers,
    target: &std::collections::BTreeMap<String, usize>,
) -> Result<MorphTarget, Error> {
    let mut read = MorphTarget::default();
    if let Some(&accessor) = target.get("POSITION") {
        read.positions = buffers.read(accessor, DVec3::from_array)?;
        same_length(accessor, read.positions.len(), streams.positions.len())?;
    }
    if let Some(&accessor) = target.get("NORMAL").filter(|_| !streams.normals.is_empty()) {
        read.normals = buffers.read(accessor, |n: [f64; 3]| n.map(|v| v as f32))?;
        same_length(accessor, read.normals.len(), streams.normals.len())?;
    }
    Ok(read)
}

fn influences(
    count: usize,
    buffers: &Buffers,
    primitive: &Primitive,
    joints: usize,
) -> Result<Vec<Influences>, Error> {
    let mut sets = Vec::new();
    for set in 0..MAX_JOINT_SETS {
        let attribute = |name: &str| primitive.attributes.get(&format!("{name}_{set}")).copied();
        let Some((bones, shares)) = attribute("JOINTS").zip(attribute("WEIGHTS")) else { break };
        let indices = buffers.read(bones, |four: [f64; 4]| four.map(|v| v as u32))?;
        same_length(bones, indices.len(), count)?;
        let weights = buffers.read(shares, |four: [f64; 4]| four)?;
        same_length(shares, weights.len(), count)?;
        for (vertex, (four, share)) in indices.iter().zip(&weights).enumerate() {
            let wrong =
                four.iter().zip(share).find(|(joint, weight)| **weight != 0.0 && **joint as usize >= joints);
            if let Some((joint, _)) = wrong {
                let message = format!("joint {joint} of vertex {vertex}, the skin has {joints}");
                return Err(Error::new(message).at(format!("accessor {bones}")));
            }
        }
        sets.push(Influences { joints: indices, weights });
    }
    if sets.is_empty() {
        return Err(Error::new("its node has a skin, but it has no JOINTS_0 and WEIGHTS_0"));
    }
    Ok(sets)
}

fn same_length(accessor: usize, found: usize, wanted: usize) -> Result<(), Error> {
    if found == wanted {
        return Ok(());
    }
    let message = format!("{found} elements, but the primitive has {wanted} vertices");
    Err(Error::new(message).at(format!("accessor {accessor}")))
}
