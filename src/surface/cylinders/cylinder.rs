//! [`Cylinder`]: where a round cylinder is, and how much there is of it.

use glam::DVec3;

use crate::mesh::PartId;

/// A cylinder that a mesh stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// The part it belongs to.
    pub part: PartId,
    /// A point of its axis, world.
    pub point: DVec3,
    /// The direction of its axis, of unit length.
    pub axis: DVec3,
    /// Its radius, world units.
    pub radius: f64,
    /// How far the corners of its facets are from it at most, world units.
    pub spread: f64,
    /// Where it begins and ends along the axis from the point.
    pub ends: [f64; 2],
    /// How much of a whole turn there is of it, radians.
    pub arc: f64,
    /// Whether its inside is outside the material: a hole.
    pub hollow: bool,
}
