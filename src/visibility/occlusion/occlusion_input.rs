//! [`OcclusionInput`]: the segments and triangles of a view that are compared with each other.

use super::tiled_triangles::TiledTriangles;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::view_tolerances::ViewTolerances;

/// Input shared by the comparisons of all tiles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OcclusionInput<'a> {
    pub(crate) triangles: &'a TiledTriangles<'a>,
    pub(crate) segments: &'a [ImageSegment],
    pub(crate) limits: &'a ViewTolerances,
    /// Whether the triangles in front of a piece are counted.
    pub(crate) counting: bool,
}

/// Part of a segment inside one tile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TileSegment {
    pub(crate) segment: u32,
    pub(crate) start: f64,
    pub(crate) end: f64,
}
