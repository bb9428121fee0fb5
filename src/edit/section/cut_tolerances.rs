//! [`CutTolerances`]: distances within which points coincide when a shape is cut.

use glam::DAffine3;

use crate::edit::tolerances;
use crate::geometry::space::bounds::Bounds;
use crate::scene::Geometry;

/// Distances within which points of a shape coincide, world units.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CutTolerances {
    /// Points of an outline: the distance that the mesh welds.
    pub points: f64,
    /// A vertex and the plane: surfaces closer than this have no space between them in the drawing.
    pub plane: f64,
    /// Ends of an open outline, which may be the two sides of a seam.
    pub gap: f64,
}

impl CutTolerances {
    /// Distances for a shape, from its size and the precision of its coordinates.
    pub(crate) fn of(geometry: &Geometry, place: &DAffine3) -> Self {
        let corners = geometry.triangles.as_flattened().iter();
        let points = corners.filter_map(|corner| geometry.positions.get(*corner as usize));
        let placed = points.map(|p| place.transform_point3(*p));
        let around = Bounds::of(placed.filter(|p| p.is_finite()));
        if around.is_empty() {
            return Self::default();
        }
        let (size, largest) = (around.diagonal(), around.largest_coordinate());
        let of_coordinate = if geometry.single_precision {
            crate::mesh::tolerances::WELD_OF_F32_COORDINATE
        } else {
            tolerances::F64_ROUNDING_OF_COORDINATE
        };
        let points = (size * crate::mesh::tolerances::WELD_OF_PART).max(largest * of_coordinate);
        Self {
            points,
            plane: points.max(size * crate::mesh::tolerances::CONTACT_OF_PART),
            gap: points.max(size * crate::mesh::tolerances::MAX_SEAM_GAP_OF_PART),
        }
    }
}
