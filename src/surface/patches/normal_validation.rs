//! Detection of file normals that do not fit the surface, because the surface was turned or replaced after
//! the normals were computed.
//!
//! A correct corner normal is a mean over the faces around the corner. It deviates from none of them by
//! more than they deviate from each other. If all three normals of a face deviate by far more, they are
//! unusable: contours would lie on a surface that does not exist.

use glam::Vec3;

use crate::geometry::numbers::portable_math::acos;
use crate::mesh::{DihedralCosines, Mesh, VertexEdges};

/// Cosine of the deviation (10 degrees) that rounding, or a finer original model, can cause. A normal leans
/// if its cosine is smaller.
const MAX_LEANING_COSINE: f32 = 0.985;
/// The angle of [`MAX_LEANING_COSINE`], radians.
const MIN_LEANING_RAD: f64 = 0.175;

/// Cosine of the smallest angle between a face normal (`own`) and its corner normals, if all of them
/// deviate. `None` if one does not, if a corner has no normal, or if the face has no area.
#[inline]
pub(crate) fn leaning(own: Vec3, normals: [Option<&[f32; 3]>; 3]) -> Option<f32> {
    let mut most = 0.0f32;
    for normal in normals {
        // Normals may belong to either side of the face.
        most = most.max(Vec3::from_array(*normal?).dot(own).abs());
    }
    (most < MAX_LEANING_COSINE && own != Vec3::ZERO).then_some(most)
}

/// Whether normals that deviate by at least the angle of `cosine` deviate by more than the surface turns at
/// the sides of the face.
pub(crate) fn leans(
    mesh: &Mesh,
    (turns, edges): (&DihedralCosines, &VertexEdges),
    face: u32,
    cosine: f32,
) -> bool {
    let [a, b, c] = mesh.triangles[face as usize];
    let turn = |[a, b]: [u32; 2]| {
        let cosine = edges.between(a, b).map_or(f32::NAN, |edge| turns.of_two(edge));
        // The turn is unknown at a border.
        if cosine.is_nan() { 0.0 } else { acos(f64::from(cosine)) }
    };
    let most = [[a, b], [b, c], [c, a]].map(turn).into_iter().fold(0.0, f64::max);
    acos(f64::from(cosine)) > MIN_LEANING_RAD + most
}

#[cfg(test)]
mod tests {
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::{Mesh, Soup};
    use crate::surface::Patches;
    use glam::{DMat3, DVec3};

    /// Ball without caps. Its normals are those before it was turned by an angle, degrees.
    fn ball_with_rotated_normals(rings: u32, turned: f64) -> Mesh {
        let around = 2 * rings;
        let before = DMat3::from_rotation_x(turned.to_radians());
        let mut soup = Soup::default();
        for ring in 1..rings {
            for k in 0..around {
                let [polar, turn] = [ring, k].map(|k| std::f64::consts::PI * f64::from(k) / f64::from(rings));
                let out = DVec3::new(sin(polar) * cos(turn), sin(polar) * sin(turn), cos(polar));
                soup.positions.push(out);
                soup.normals.push((before * out).as_vec3().to_array());
            }
        }
        for ring in 0..rings - 2 {
            for k in 0..around {
                let at = |ring: u32, k: u32| ring * around + k % around;
                let [a, b] = [at(ring, k), at(ring, k + 1)];
                let [c, d] = [at(ring + 1, k), at(ring + 1, k + 1)];
                soup.triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
        soup.corner_normals = soup.triangles.clone();
        Mesh::build(soup)
    }

    #[test]
    fn file_normals_of_another_orientation_are_not_trusted() {
        let believed = |rings: u32, turned: f64| {
            Patches::new(&ball_with_rotated_normals(rings, turned), 40.0, false).trusts_file_normals
        };
        for rings in [8, 12, 32, 64] {
            assert!(believed(rings, 0.0).iter().all(|believed| *believed), "{rings} rings");
        }
        // As by rounding, or from a finer model.
        assert!(believed(64, 6.0).iter().all(|believed| *believed));
        for turned in [25.0, 90.0, 155.0] {
            assert!(!believed(64, turned).contains(&true), "{turned} degrees");
        }
    }
}
