//! [`DeformableMesh`]: vertices in their rest position, with their morph targets and joint weights.

use glam::{DAffine3, DMat3, DVec3};

/// Vertices of a geometry that deform together: first by morph targets, then by the joints of a skin.
///
/// Source: Khronos Group, glTF 2.0 specification, sections 3.7.2.2 (morph targets) and 3.7.3 (skins).
#[derive(Debug, Clone, Default)]
pub(crate) struct DeformableMesh {
    /// Index of the first vertex in the geometry.
    pub start: usize,
    /// Rest positions.
    pub positions: Vec<DVec3>,
    /// Rest normals; empty if there are none.
    pub normals: Vec<[f32; 3]>,
    /// Morph targets.
    pub targets: Vec<MorphTarget>,
    /// Sets of four joints and weights, each with one entry per vertex.
    pub sets: Vec<Influences>,
}

/// Offsets of a morph target at full weight; one entry per vertex, or empty.
#[derive(Debug, Clone, Default)]
pub(crate) struct MorphTarget {
    /// Offsets of positions.
    pub positions: Vec<DVec3>,
    /// Offsets of normals.
    pub normals: Vec<[f32; 3]>,
}

/// Four joints of each vertex and their weights.
#[derive(Debug, Clone, Default)]
pub(crate) struct Influences {
    /// Joint numbers within the skin.
    pub joints: Vec<[u32; 4]>,
    /// Weights; they need not add up to 1.
    pub weights: Vec<[f64; 4]>,
}

impl DeformableMesh {
    /// Moves rest positions and normals by morph targets, and then by the joints of a skin, if there is one.
    pub(crate) fn pose(
        &self,
        (positions, normals): (&mut [DVec3], &mut [[f32; 3]]),
        weights: &[f64],
        joints: Option<&[DAffine3]>,
    ) {
        for (target, &weight) in self.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            positions.iter_mut().zip(&target.positions).for_each(|(position, by)| *position += weight * by);
            for (normal, by) in normals.iter_mut().zip(&target.normals) {
                *normal = [0, 1, 2].map(|i| normal[i] + weight as f32 * by[i]);
            }
        }
        let Some(joints) = joints else { return };
        for (vertex, position) in positions.iter_mut().enumerate() {
            let blend = self.blend(vertex, joints);
            *position = blend.transform_point3(*position);
            if let Some(normal) = normals.get_mut(vertex) {
                let turned = cofactors(blend.matrix3) * DVec3::from_array(normal.map(f64::from));
                *normal = turned.normalize_or_zero().as_vec3().to_array();
            }
        }
    }

    /// Position of one vertex, deformed as by [`DeformableMesh::pose`].
    #[must_use]
    pub(crate) fn place(&self, vertex: usize, weights: &[f64], joints: Option<&[DAffine3]>) -> Option<DVec3> {
        let mut position = *self.positions.get(vertex)?;
        for (target, &weight) in self.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            position += weight * target.positions.get(vertex).copied().unwrap_or_default();
        }
        Some(joints.map_or(position, |joints| self.blend(vertex, joints).transform_point3(position)))
    }

    /// Joint with the greatest weight for a vertex, the first of equal ones; `None` if no joint moves it.
    #[must_use]
    pub(crate) fn first_joint(&self, vertex: usize) -> Option<usize> {
        let mut heaviest: Option<(u32, f64)> = None;
        for set in &self.sets {
            let (Some(four), Some(joint_weights)) = (set.joints.get(vertex), set.weights.get(vertex)) else {
                continue;
            };
            for (joint, weight) in four.iter().zip(joint_weights) {
                if *weight > heaviest.map_or(0.0, |(_, most)| most) {
                    heaviest = Some((*joint, *weight));
                }
            }
        }
        heaviest.map(|(joint, _)| joint as usize)
    }

    /// Blended transform of the joints of a vertex.
    fn blend(&self, vertex: usize, joints: &[DAffine3]) -> DAffine3 {
        let mut blend = DAffine3::ZERO;
        let mut total = 0.0;
        for set in &self.sets {
            let (Some(four), Some(share)) = (set.joints.get(vertex), set.weights.get(vertex)) else {
                continue;
            };
            for (joint, weight) in four.iter().zip(share).filter(|(_, weight)| **weight != 0.0) {
                let Some(matrix) = joints.get(*joint as usize) else { continue };
                blend.matrix3 += *weight * matrix.matrix3;
                blend.translation += *weight * matrix.translation;
                total += weight;
            }
        }
        if total > 0.0 {
            blend.matrix3 *= 1.0 / total;
            blend.translation /= total;
        } else if let Some(first) = joints.first() {
            // Without any weight a vertex would move to the origin.
            blend = *first;
        }
        blend
    }
}

/// Transform of normals that belongs to `m`: the cofactor matrix (inverse transpose times determinant), which
/// needs no division for singular matrices. Negated if `m` mirrors.
fn cofactors(m: DMat3) -> DMat3 {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let turned = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if m.determinant() < 0.0 { turned * -1.0 } else { turned }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn cofactors_keep_normals_perpendicular_under_shear_and_mirroring() {
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
