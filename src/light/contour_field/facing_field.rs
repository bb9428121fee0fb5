//! n·v: the cosine between the normal of a rounded surface and the direction to the eye. Its zero set is the
//! contour.
//!
//! Source: Aaron Hertzmann and Denis Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, section 4.1.

use crate::parallel::prelude::*;

use crate::mesh::Mesh;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;
use crate::view::Frame;

/// Cosine between the normal and the direction to the eye, −1 to 1, one per smooth vertex. Positive where the
/// surface turns its outside to the eye.
#[must_use]
pub(crate) fn facing(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame) -> Vec<f64> {
    let at =
        |(normal, vertex): (&glam::DVec3, &u32)| normal.dot(frame.to_eye(mesh.positions[*vertex as usize]));
    smooth.normals.par_iter().zip(&smooth.vertices).with_min_len(MIN_TASK_ITEMS).map(at).collect()
}
