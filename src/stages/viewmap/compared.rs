//! [`Compared`]: the segments and triangles of a view, each of which may hide a piece of each.

use super::limits::Limits;
use super::occluders::Triangles;
use super::project::ImageSegment;

/// What is compared in all tiles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compared<'a> {
    pub(super) triangles: &'a Triangles<'a>,
    pub(super) segments: &'a [ImageSegment],
    pub(super) limits: &'a Limits,
    /// Whether it matters how many triangles hide a piece.
    pub(super) counting: bool,
}

/// The part of a segment in one tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) segment: u32,
    pub(super) start: f64,
    pub(super) end: f64,
}
