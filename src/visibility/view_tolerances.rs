//! [`ViewTolerances`]: the tolerances of one view, in its units.

use super::tolerances;
use crate::mesh::PartMetrics;
use crate::view::Frame;

/// Tolerances of one view, in user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ViewTolerances {
    /// Distance outside a triangle's border that still counts as inside, user units.
    pub cover: f64,
    /// Height in the image below which a triangle covers nothing, user units.
    pub height: f64,
    /// Depth difference that counts as touching, given as a length across the line of sight, user units.
    pub contact: f64,
    /// Depth difference that counts as touching for triangles that share a vertex with the segment, user
    /// units.
    pub neighbour: f64,
    /// Length below which pieces are rounding, user units.
    pub piece: f64,
    /// Distance from a contour where background is tested, user units.
    pub side_offset: f64,
    /// Distance within which two lines coincide, user units.
    pub double: f64,
    /// One px: a thousandth of the longer side of the frame, user units.
    pub px: f64,
}

impl ViewTolerances {
    /// Tolerances for a frame. A px here is a thousandth of the frame's longer side, for any user unit.
    #[must_use]
    pub(crate) fn new(frame: &Frame) -> Self {
        let px = frame.px();
        Self {
            cover: crate::geometry::tolerances::TRIANGLE_BORDER_PX * px,
            height: tolerances::MIN_IMAGE_HEIGHT_PX * px,
            contact: tolerances::CONTACT_PX * px,
            neighbour: tolerances::NEIGHBOUR_PX * px,
            piece: tolerances::MIN_VISIBILITY_SPAN_PX * px,
            side_offset: tolerances::BACKGROUND_PROBE_PX * px,
            double: tolerances::DUPLICATE_LINE_PX * px,
            px,
        }
    }

    /// Difference in nearness required for a triangle to hide a line at nearness `q`.
    #[inline]
    #[must_use]
    pub(crate) fn step(&self, q: f64, own: &FaceTolerances, shares_vertex: bool, frame: &Frame) -> f64 {
        let (in_image, in_space) =
            if shares_vertex { (self.neighbour, own.neighbour) } else { (self.contact, own.contact) };
        frame.nearness_across(q, in_image).max(frame.nearness_step(q, in_space))
    }
}

/// Tolerances of a triangle that do not depend on the view: depth differences within rounding, world units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FaceTolerances {
    /// Distance that counts as touching.
    pub contact: f64,
    /// Distance that counts as touching for lines that share a vertex with the triangle.
    pub neighbour: f64,
    /// Distance within which a line lies in the plane of the triangle, given the rounding of both.
    pub in_plane: f64,
}

impl FaceTolerances {
    /// Tolerances for the triangles of a part.
    #[inline]
    #[must_use]
    pub(crate) fn of(extent: &PartMetrics) -> Self {
        Self {
            contact: extent.contact,
            neighbour: tolerances::NEIGHBOUR_OF_PART * extent.scale,
            in_plane: (2.0 * extent.rounding).max(tolerances::NEIGHBOUR_OF_PART * extent.scale),
        }
    }
}
