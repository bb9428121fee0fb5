//! Normals of a file that lean from the surface: they were made for it before it was turned, or for another.
//!
//! A normal at a corner is a mean of what lies around it, so that it leans from none of the faces there by more than they lean
//! from each other. Where all three of a face do, by far, they say nothing of its shape: contours would be sought where a
//! surface is that is not there.

use glam::Vec3;

use crate::geometry::numbers::portable_math::acos;
use crate::mesh::{FirstEdges, Mesh, Turns};

/// The cosine of the angle (10 degrees) by which normals lean that were rounded, or taken from a finer model.
const LEANING_COSINE: f32 = 0.985;
/// That angle, radians.
const LEANING: f64 = 0.175;

/// The cosine of the least angle between a face and the normals that a file gives its corners, if all of them lean; none where a
/// corner has no normal.
#[inline]
pub(crate) fn leaning(own: Vec3, normals: [Option<&[f32; 3]>; 3]) -> Option<f32> {
    let mut most = 0.0f32;
    for normal in normals {
        // Whichever side of the face the file takes for its front.
        most = most.max(Vec3::from_array(*normal?).dot(own).abs());
    }
    (most < LEANING_COSINE && own != Vec3::ZERO).then_some(most)
}

/// Whether normals that lean from a face, the least by the angle of this cosine, lean by more than the surface turns at its sides.
pub(crate) fn leans(mesh: &Mesh, (turns, edges): (&Turns, &FirstEdges), face: u32, cosine: f32) -> bool {
    let [a, b, c] = mesh.triangles[face as usize];
    let turn = |[a, b]: [u32; 2]| {
        let cosine = edges.between(a, b).map_or(f32::NAN, |edge| turns.of_two(edge));
        // Nobody knows how the surface would go on where it ends.
        if cosine.is_nan() { 0.0 } else { acos(f64::from(cosine)) }
    };
    let most = [[a, b], [b, c], [c, a]].map(turn).into_iter().fold(0.0, f64::max);
    acos(f64::from(cosine)) > LEANING + most
}

#[cfg(test)]
mod tests {
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::{Mesh, Soup};
    use crate::surface::Patches;
    use glam::{DMat3, DVec3};

    /// A ball without its caps, of so many rings, with its normals as they were before it was turned by an angle, degrees.
    fn ball(rings: u32, turned: f64) -> Mesh {
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
    fn normals_of_another_place_are_not_believed() {
        let believed = |rings: u32, turned: f64| Patches::new(&ball(rings, turned), 40.0, false).believed;
        for rings in [8, 12, 32, 64] {
            assert!(believed(rings, 0.0).iter().all(|believed| *believed), "{rings} rings");
        }
        // Rounded, or of a finer model.
        assert!(believed(64, 6.0).iter().all(|believed| *believed));
        for turned in [25.0, 90.0, 155.0] {
            assert!(!believed(64, turned).contains(&true), "{turned} degrees");
        }
    }
}
