//! The normals of triangles, and which have none.

use glam::DVec3;
use rayon::prelude::*;

use crate::math::grain::GRAIN;
use crate::math::tolerance;

/// Unit normals; zero where the triangle is lower than rounding, by the scale of its part.
pub(crate) fn face_normals(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    scale: impl Fn(usize) -> f64 + Sync,
) -> Vec<[f32; 3]> {
    let normal = |(face, t): (usize, &[u32; 3])| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        let (u, v, w) = (b - a, c - a, c - b);
        let cross = u.cross(v);
        let longest = u.length_squared().max(v.length_squared()).max(w.length_squared()).sqrt();
        let area = cross.length();
        if area <= tolerance::DEGENERATE_HEIGHT_OF_PART * scale(face) * longest {
            [0.0; 3]
        } else {
            (cross / area).as_vec3().to_array()
        }
    };
    triangles.par_iter().enumerate().with_min_len(GRAIN).map(normal).collect()
}
