//! [`Reach`]: how near two places are one where a shape is cut.

use glam::{DAffine3, DVec3};

use crate::geometry::numbers::tolerance;
use crate::scene::Geometry;

/// How near two places of a shape are one, world.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Reach {
    /// Points of an outline: what the mesh joins anyway.
    pub points: f64,
    /// A vertex and the plane: nothing is drawn between surfaces that are nearer.
    pub plane: f64,
    /// The ends of an outline that does not close, which may be the two sides of a seam.
    pub gap: f64,
}

impl Reach {
    /// That of a shape, by its size and the precision of its coordinates.
    pub fn of(geometry: &Geometry, place: &DAffine3) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in geometry.triangles.as_flattened() {
            let Some(p) = geometry.positions.get(*corner as usize) else { continue };
            let p = place.transform_point3(*p);
            if p.is_finite() {
                (low, high) = (low.min(p), high.max(p));
            }
        }
        if low.x > high.x {
            return Self::default();
        }
        let (size, largest) = (low.distance(high), low.abs().max(high.abs()).max_element());
        let of_coordinate =
            if geometry.single_precision { tolerance::WELD_OF_F32_COORDINATE } else { tolerance::ROUNDING };
        let points = (size * tolerance::WELD_OF_PART).max(largest * of_coordinate);
        Self {
            points,
            plane: points.max(size * tolerance::CONTACT_OF_PART),
            gap: points.max(size * tolerance::SEAM_OF_PART),
        }
    }
}
