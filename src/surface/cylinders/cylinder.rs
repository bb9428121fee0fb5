//! [`Cylinder`]: position and extent of a circular cylinder.

use glam::DVec3;

use crate::mesh::PartId;

/// Circular cylinder that a mesh approximates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cylinder {
    /// The part it belongs to.
    pub part: PartId,
    /// A point of its axis, world.
    pub point: DVec3,
    /// Unit direction of its axis.
    pub axis: DVec3,
    /// Radius, world units.
    pub radius: f64,
    /// Maximum distance between the corners of its facets and the cylinder, world units.
    pub spread: f64,
    /// Start and end along the axis, measured from the point.
    pub ends: [f64; 2],
    /// Angle that its facets cover, radians.
    pub arc: f64,
    /// Whether it is a hole: material is outside.
    pub is_hole: bool,
}
