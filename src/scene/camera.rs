//! [`Camera`]: the camera record of the contract, and named views.

use glam::DVec3;

/// Perspective or parallel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Lines of sight meet in the eye.
    Perspective {
        /// Vertical field of view, degrees, between 0 and 180.
        fov_y_deg: f64,
    },
    /// Lines of sight are parallel.
    Orthographic {
        /// World units that the picture's height spans.
        height: f64,
    },
}

/// Where the eye is, where it looks, and the frame it looks through.
///
/// The optical axis meets the frame's centre; x right, y down, square pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Eye point, world.
    pub eye: DVec3,
    /// A point on the optical axis, world.
    pub target: DVec3,
    /// Roughly up; need not be at a right angle to the axis.
    pub up: DVec3,
    /// Perspective or parallel.
    pub projection: Projection,
    /// Width of the frame in user units (px, or mm on a page).
    pub width: f64,
    /// Height of the frame in user units.
    pub height: f64,
    /// Nearest depth drawn; without it, everything in front of a perspective eye and everything
    /// at all in a parallel view.
    pub near: Option<f64>,
}
