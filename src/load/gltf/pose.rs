//! The stored pose: morph targets at their weights, then vertices carried by the joints of a skin.

use glam::{DAffine3, DMat3, DVec3};

use super::buffers::Buffers;
use super::json::Primitive;
use super::nodes::Hierarchy;
use super::streams::Streams;
use crate::error::Error;

/// Most sets of four joints a vertex is looked for.
const SETS: usize = 16;

/// World transform of each joint times its inverse bind matrix.
pub fn joints(buffers: &Buffers, nodes: &Hierarchy, skin: usize) -> Result<Vec<DAffine3>, Error> {
    let place = |error: Error| error.at(format!("skin {skin}"));
    let Some(stored) = buffers.root.skins.get(skin) else {
        let message = format!("is pointed to, but the file has {}", buffers.root.skins.len());
        return Err(place(Error::new(message)));
    };
    let binds = match stored.inverse_bind_matrices {
        Some(accessor) => buffers.read(accessor, bind_matrix)?,
        None => vec![DAffine3::IDENTITY; stored.joints.len()],
    };
    if binds.len() < stored.joints.len() {
        let message = format!("{} joints, but {} inverse bind matrices", stored.joints.len(), binds.len());
        return Err(place(Error::new(message)));
    }
    let joint = |(&node, &bind): (&usize, &DAffine3)| match nodes.world.get(node) {
        Some(world) => Ok(*world * bind),
        None => Err(place(Error::new(format!("joint {node} is no node of the file")))),
    };
    stored.joints.iter().zip(&binds).map(joint).collect()
}

fn bind_matrix([a, b, c, _, d, e, f, _, g, h, i, _, x, y, z, _]: [f64; 16]) -> DAffine3 {
    DAffine3::from_mat3_translation(DMat3::from_cols_array(&[a, b, c, d, e, f, g, h, i]), DVec3::new(x, y, z))
}

/// Adds the morph targets of a primitive, each times its weight.
pub fn morph(
    streams: &mut Streams,
    buffers: &Buffers,
    primitive: &Primitive,
    weights: &[f64],
) -> Result<(), Error> {
    for (target, &weight) in primitive.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
        if let Some(&accessor) = target.get("POSITION") {
            let moves = buffers.read(accessor, DVec3::from_array)?;
            same_length(accessor, moves.len(), streams.positions.len())?;
            streams.positions.iter_mut().zip(moves).for_each(|(position, by)| *position += weight * by);
        }
        if let Some(&accessor) = target.get("NORMAL").filter(|_| !streams.normals.is_empty()) {
            let turns = buffers.read(accessor, |n: [f64; 3]| n.map(|v| v as f32))?;
            same_length(accessor, turns.len(), streams.normals.len())?;
            for (normal, by) in streams.normals.iter_mut().zip(turns) {
                *normal = [0, 1, 2].map(|i| normal[i] + weight as f32 * by[i]);
            }
        }
    }
    Ok(())
}

/// Carries the vertices of a primitive along with the joints; they are in world space then.
pub fn skin(
    streams: &mut Streams,
    buffers: &Buffers,
    primitive: &Primitive,
    joints: &[DAffine3],
) -> Result<(), Error> {
    let count = streams.positions.len();
    let mut sets = Vec::new();
    for set in 0..SETS {
        let attribute = |name: &str| primitive.attributes.get(&format!("{name}_{set}")).copied();
        let Some((bones, weights)) = attribute("JOINTS").zip(attribute("WEIGHTS")) else { break };
        let indices = buffers.read(bones, |four: [f64; 4]| four.map(|v| v as u32))?;
        same_length(bones, indices.len(), count)?;
        let shares = buffers.read(weights, |four: [f64; 4]| four)?;
        same_length(weights, shares.len(), count)?;
        sets.push((bones, indices, shares));
    }
    if sets.is_empty() {
        return Err(Error::new("its node has a skin, but it has no JOINTS_0 and WEIGHTS_0"));
    }
    for vertex in 0..count {
        let mut blend = DAffine3::ZERO;
        let mut total = 0.0;
        for (accessor, indices, shares) in &sets {
            let (Some(four), Some(share)) = (indices.get(vertex), shares.get(vertex)) else { continue };
            for (joint, weight) in four.iter().zip(share).filter(|(_, weight)| **weight != 0.0) {
                let Some(matrix) = joints.get(*joint as usize) else {
                    let message = format!("joint {joint} of vertex {vertex}, the skin has {}", joints.len());
                    return Err(Error::new(message).at(format!("accessor {accessor}")));
                };
                blend.matrix3 += *weight * matrix.matrix3;
                blend.translation += *weight * matrix.translation;
                total += weight;
            }
        }
        if total > 0.0 {
            blend.matrix3 *= 1.0 / total;
            blend.translation /= total;
        } else if let Some(first) = joints.first() {
            // Without any weight a vertex would fall to the origin.
            blend = *first;
        }
        if let Some(position) = streams.positions.get_mut(vertex) {
            *position = blend.transform_point3(*position);
        }
        if let Some(normal) = streams.normals.get_mut(vertex) {
            let turned = cofactors(blend.matrix3) * DVec3::from_array(normal.map(f64::from));
            *normal = turned.normalize_or_zero().as_vec3().to_array();
        }
    }
    Ok(())
}

/// The transform of normals that belongs to `m`: its inverse transposed times its determinant, so
/// that flattening matrices do not divide by nothing; turned round where `m` mirrors.
fn cofactors(m: DMat3) -> DMat3 {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let turned = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if m.determinant() < 0.0 { turned * -1.0 } else { turned }
}

fn same_length(accessor: usize, found: usize, wanted: usize) -> Result<(), Error> {
    if found == wanted {
        return Ok(());
    }
    let message = format!("{found} elements, but the primitive has {wanted} vertices");
    Err(Error::new(message).at(format!("accessor {accessor}")))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn normals_stand_upright_after_any_transform() {
        let m = DMat3::from_cols(
            DVec3::new(2.0, 0.0, 0.0),
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(0.0, 0.0, -3.0),
        );
        let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.5, -1.0, 2.0));
        let normal = cofactors(m) * a.cross(b);
        assert!(normal.dot(m * a).abs() < 1e-12 && normal.dot(m * b).abs() < 1e-12);
        assert_eq!(cofactors(DMat3::IDENTITY), DMat3::IDENTITY);
    }
}
