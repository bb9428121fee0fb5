//! [`Compared`]: the segments and triangles of a view, each of which may hide a piece of each.

use super::tiled_triangles::Triangles;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::view_tolerances::Limits;

/// What is compared in all tiles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Compared<'a> {
    pub(crate) triangles: &'a Triangles<'a>,
    pub(crate) segments: &'a [ImageSegment],
    pub(crate) limits: &'a Limits,
    /// Whether it matters how many triangles hide a piece.
    pub(crate) counting: bool,
}

/// The part of a segment in one tile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Item {
    pub(crate) segment: u32,
    pub(crate) start: f64,
    pub(crate) end: f64,
}
