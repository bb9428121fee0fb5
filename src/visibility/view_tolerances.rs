//! [`Limits`]: how near is as good as touching, in a view.

use crate::geometry::numbers::tolerance;
use crate::mesh::Extent;
use crate::view::Frame;

/// The tolerances of one view, in its units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Distance from a triangle's border that counts as inside, user units.
    pub cover: f64,
    /// Triangles lower than this in the image cover nothing, user units.
    pub height: f64,
    /// Depth difference that counts as touching, as it would look across the line of sight, user units.
    pub contact: f64,
    /// Depth difference that counts as touching for triangles that share a vertex with the segment, user units.
    pub neighbour: f64,
    /// Pieces shorter than this are rounding, user units.
    pub piece: f64,
    /// How far beside a contour background is sought, user units.
    pub beside: f64,
    /// Lines nearer to each other than this are one, user units.
    pub double: f64,
    /// What counts as a px: a thousandth of the longer side of the frame, user units.
    pub px: f64,
}

impl Limits {
    /// The tolerances in a frame. A px is a thousandth of the longer side of the frame here, whatever the
    /// user unit.
    #[must_use]
    pub fn new(frame: &Frame) -> Self {
        let px = frame.px();
        Self {
            cover: tolerance::COVER_PX * px,
            height: tolerance::IMAGE_HEIGHT_PX * px,
            contact: tolerance::CONTACT_PX * px,
            neighbour: tolerance::NEIGHBOUR_PX * px,
            piece: tolerance::PIECE_PX * px,
            beside: tolerance::BESIDE_PX * px,
            double: tolerance::DOUBLE_PX * px,
            px,
        }
    }

    /// By how much nearer than a line at nearness `q` a triangle must be to hide it.
    #[inline]
    #[must_use]
    pub fn step(&self, q: f64, own: &Slack, shares_vertex: bool, frame: &Frame) -> f64 {
        let (in_image, in_space) =
            if shares_vertex { (self.neighbour, own.neighbour) } else { (self.contact, own.contact) };
        frame.nearness_across(q, in_image).max(frame.nearness_step(q, in_space))
    }
}

/// Depth differences within the reach of rounding for a triangle, whatever the view, world units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// What counts as touching.
    pub contact: f64,
    /// What counts as touching for lines that share a vertex with the triangle.
    pub neighbour: f64,
    /// Distance within which a line lies in the plane of the triangle, within the rounding of both.
    pub in_plane: f64,
}

impl Slack {
    /// Of the triangles of a part.
    #[inline]
    #[must_use]
    pub fn of(extent: &Extent) -> Self {
        Self {
            contact: extent.contact,
            neighbour: tolerance::NEIGHBOUR_OF_PART * extent.scale,
            in_plane: (2.0 * extent.rounding).max(tolerance::NEIGHBOUR_OF_PART * extent.scale),
        }
    }
}
