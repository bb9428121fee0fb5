//! [`View`]: the one door from 3-D to 2-D.
//!
//! A view maps the mesh into *image space*: x to the right and y down in user units, and a
//! *nearness* q that grows towards the eye (1/depth in perspective, −depth in a parallel view).
//! Straight lines stay straight and planes stay planes in (x, y, q), so that all later
//! interpolation is linear.

pub mod clip;
mod edge_on;
pub mod frame;

use crate::parallel::prelude::*;
use glam::DVec3;

pub use clip::ClippedFace;
pub use frame::Frame;

use crate::math::grain::GRAIN;
use crate::math::tolerance;
use crate::mesh::Mesh;
use crate::scene::Camera;

/// A mesh seen by a camera.
#[derive(Debug, Clone)]
pub struct View {
    /// The camera, relative to the mesh's origin.
    pub frame: Frame,
    /// Image-space point (x, y, q) of each vertex; q is NaN where the vertex is nearer than the
    /// near plane or behind the eye.
    pub points: Vec<DVec3>,
    /// Whether each face turns its outside to the eye; faces seen edge-on do not.
    pub facing: Vec<bool>,
    /// Faces, ascending, that turn to the eye as other faces of their plane do: their own angle to the line of sight is unknown.
    pub unsure: Vec<u32>,
    /// What is left of faces that the near plane cuts.
    pub clipped: Vec<ClippedFace>,
}

impl View {
    /// Projects a mesh.
    #[must_use]
    pub fn new(mesh: &Mesh, camera: &Camera) -> Self {
        let mut frame = Frame::new(camera, mesh.origin);
        if frame.near.is_none() && frame.perspective {
            frame.near = Some(frame.focus.max(f64::MIN_POSITIVE) * tolerance::NEAR_OF_TARGET);
        }
        let points =
            || mesh.positions.par_iter().with_min_len(GRAIN).map(|p| frame.image_from_local(*p)).collect();
        let (points, (facing, unsure)): (Vec<DVec3>, _) =
            crate::parallel::join(points, || edge_on::facing(mesh, &frame));
        let clipped = clip::clip_faces(mesh, &frame, &points);
        Self { frame, points, facing, unsure, clipped }
    }
}
