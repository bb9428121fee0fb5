//! Face normals, and detection of faces without area and of narrow faces.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::triangle_area::area_vector;
use crate::geometry::space::triangles::height;
use crate::mesh::tolerances;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Unit normals; zero where a triangle has no area at the scale of its part.
pub(crate) fn face_normals(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    scale: impl Fn(usize) -> f64 + Sync,
) -> Vec<[f32; 3]> {
    normals_and_narrow(positions, triangles, |face| (scale(face), 0.0)).0
}

/// Same, with the narrow faces, ascending: they have an area, but rounding may turn their normals. `measure`
/// returns the scale of the part of a face, and the rounding of its corners.
pub(crate) fn normals_and_narrow(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    measure: impl Fn(usize) -> (f64, f64) + Sync,
) -> (Vec<[f32; 3]>, Vec<u32>) {
    let mut normals = vec![[0.0; 3]; triangles.len()];
    let of_chunk = |(chunk, normals): (usize, &mut [[f32; 3]])| {
        let mut narrow = Vec::new();
        for (face, normal) in (chunk * MIN_TASK_ITEMS..).zip(normals) {
            let corners = triangles[face].map(|v| positions[v as usize]);
            let (scale, rounding) = measure(face);
            let Some(cross) = area_vector(corners, scale) else { continue };
            *normal = (cross / cross.length()).as_vec3().to_array();
            let is_narrow = rounding > 0.0 && is_narrow(height(&corners), rounding);
            narrow.extend(is_narrow.then_some(face as u32));
        }
        narrow
    };
    let narrow: Vec<Vec<u32>> = normals.par_chunks_mut(MIN_TASK_ITEMS).enumerate().map(of_chunk).collect();
    let narrow = narrow.concat();
    (normals, narrow)
}

/// Whether rounding may turn the normal of a face with this height by more than
/// [`MAX_NORMAL_ERROR_SINE`](tolerances::MAX_NORMAL_ERROR_SINE).
#[inline]
pub(crate) fn is_narrow(height: f64, rounding: f64) -> bool {
    height * tolerances::MAX_NORMAL_ERROR_SINE < 2.0 * rounding
}
