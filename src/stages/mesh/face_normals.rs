//! The normals of triangles, and which have none.

use glam::DVec3;
use rayon::prelude::*;

use super::area::area_vector;
use crate::math::grain::GRAIN;

/// Unit normals; zero where the triangle has no area, by the scale of its part.
pub(crate) fn face_normals(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    scale: impl Fn(usize) -> f64 + Sync,
) -> Vec<[f32; 3]> {
    let normal = |(face, t): (usize, &[u32; 3])| {
        let area = area_vector(t.map(|v| positions[v as usize]), scale(face));
        area.map_or([0.0; 3], |cross| (cross / cross.length()).as_vec3().to_array())
    };
    triangles.par_iter().enumerate().with_min_len(GRAIN).map(normal).collect()
}
