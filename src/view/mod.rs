//! [`View`]: a mesh projected by a camera, the only place where 3-D becomes 2-D.
//!
//! Image space has x to the right and y down, in user units, and a *nearness* q that grows towards the eye:
//! 1/depth in perspective, −depth in a parallel view. Straight lines stay straight and planes stay planes in
//! (x, y, q), so all later interpolation is linear.
//!
//! 1. Every vertex is projected.
//! 2. Faces are classified as facing or averted; faces seen edge-on are decided once per plane.
//! 3. Faces that cross the near plane are clipped.
//!
//! Files, in reading order: [`frame`] the camera's axes and projection; [`edge_on_faces`] step 2;
//! [`clipping`] step 3; [`raster`] pixel buffers of a view.

pub(crate) mod clipping;
mod edge_on_faces;
pub(crate) mod frame;
pub(crate) mod raster;
pub(crate) mod tolerances;

use crate::parallel::prelude::*;
use glam::DVec3;

pub(crate) use clipping::ClippedFace;
pub use frame::Frame;

use crate::mesh::Mesh;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::Camera;

/// Mesh seen by a camera.
#[derive(Debug, Clone)]
pub struct View {
    /// Camera frame, relative to the mesh's origin.
    pub(crate) frame: Frame,
    /// Image-space point (x, y, q) of each vertex; q is NaN where the vertex is nearer than the near plane or
    /// behind the eye.
    pub(crate) points: Vec<DVec3>,
    /// Whether each face turns its outside to the eye; false for faces seen edge-on.
    pub(crate) facing: Vec<bool>,
    /// Faces, ascending, that follow other faces of their plane, because their own angle to the line of sight
    /// is unknown.
    pub(crate) unsure: Vec<u32>,
    /// Remaining parts of the faces that the near plane cuts.
    pub(crate) clipped: Vec<ClippedFace>,
}

impl View {
    /// Projects a mesh.
    #[must_use]
    pub fn new(mesh: &Mesh, camera: &Camera) -> Self {
        let mut frame = Frame::new(camera, mesh.origin);
        if frame.near.is_none() && frame.perspective {
            frame.near = Some(frame.focus.max(f64::MIN_POSITIVE) * tolerances::CLIP_PLANE_OF_TARGET);
        }
        let points = || {
            mesh.positions
                .par_iter()
                .with_min_len(MIN_TASK_ITEMS)
                .map(|p| frame.image_from_local(*p))
                .collect()
        };
        let (points, (facing, unsure)): (Vec<DVec3>, _) =
            crate::parallel::join(points, || edge_on_faces::facing(mesh, &frame));
        let clipped = clipping::clip_faces(mesh, &frame, &points);
        Self { frame, points, facing, unsure, clipped }
    }
}
