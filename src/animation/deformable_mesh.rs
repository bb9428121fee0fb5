//! [`Body`]: the vertices of a mesh before they are posed, and what moves them.

use glam::{DAffine3, DMat3, DVec3};

/// Vertices of a geometry that belong together, and what moves them: morph targets, then the joints of a skin.
///
/// Source: Khronos Group, glTF 2.0 specification, sections 3.7.2.2 (morph targets) and 3.7.3 (skins).
#[derive(Debug, Clone, Default)]
pub struct Body {
    /// The first of its vertices in the geometry.
    pub start: usize,
    /// Where they rest.
    pub positions: Vec<DVec3>,
    /// Their normals, or none.
    pub normals: Vec<[f32; 3]>,
    /// What each morph target adds.
    pub targets: Vec<Target>,
    /// Sets of four joints and their weights, each with one entry a vertex.
    pub sets: Vec<Influences>,
}

/// What a morph target adds at full weight; arrays are as long as there are vertices, or empty.
#[derive(Debug, Clone, Default)]
pub struct Target {
    /// To positions.
    pub positions: Vec<DVec3>,
    /// To normals.
    pub normals: Vec<[f32; 3]>,
}

/// Four joints of each vertex and how much each moves it.
#[derive(Debug, Clone, Default)]
pub struct Influences {
    /// By their numbers in the skin.
    pub joints: Vec<[u32; 4]>,
    /// Not necessarily 1 in all.
    pub weights: Vec<[f64; 4]>,
}

impl Body {
    /// Moves vertices that rest by morph targets at their weights, and then by the joints of a skin, if it has one.
    pub fn pose(
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

    /// Where one vertex is, moved as [`Body::pose`] moves all.
    #[must_use]
    pub fn place(&self, vertex: usize, weights: &[f64], joints: Option<&[DAffine3]>) -> Option<DVec3> {
        let mut position = *self.positions.get(vertex)?;
        for (target, &weight) in self.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            position += weight * target.positions.get(vertex).copied().unwrap_or_default();
        }
        Some(joints.map_or(position, |joints| self.blend(vertex, joints).transform_point3(position)))
    }

    /// The joint that moves a vertex most, the first of several; none if none does.
    #[must_use]
    pub fn first_joint(&self, vertex: usize) -> Option<usize> {
        let mut most: Option<(u32, f64)> = None;
        for set in &self.sets {
            let (Some(four), Some(share)) = (set.joints.get(vertex), set.weights.get(vertex)) else {
                continue;
            };
            for (joint, weight) in four.iter().zip(share) {
                if *weight > most.map_or(0.0, |(_, most)| most) {
                    most = Some((*joint, *weight));
                }
            }
        }
        most.map(|(joint, _)| joint as usize)
    }

    /// How the joints together move a vertex.
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
            // Without any weight a vertex would fall to the origin.
            blend = *first;
        }
        blend
    }
}

/// The transform of normals that belongs to `m`: its inverse transposed times its determinant, so
/// that flattening matrices do not divide by nothing; turned round where `m` mirrors.
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
