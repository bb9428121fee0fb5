//! Comparison of the segments and triangles of one tile.

use super::segment_comparison::TriangleChoice;
use crate::visibility::occlusion::interval_sweep::{HiddenInterval, sweep};
use crate::visibility::occlusion::occlusion_input::{OcclusionInput, TileSegment};
use crate::visibility::occlusion::tiled_triangles::OccluderBounds;
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::tolerances;

/// Lists up to this length are not sorted.
const MAX_UNSORTED_TRIANGLES: usize = 32;

/// Results of a run of tiles.
#[derive(Debug, Default)]
pub(crate) struct TileResult {
    /// Segment parts that are hidden from end to end.
    pub(crate) fully_hidden: Vec<TileSegment>,
    /// Hidden pieces of the other segment parts.
    pub(crate) hidden: Vec<(u32, HiddenInterval)>,
    /// Where a segment that may bound a surface has no background next to it.
    pub(crate) non_silhouette: Vec<(u32, Interval)>,
    /// Number of comparisons between a segment and a triangle.
    pub(crate) tests: u64,
}

impl TileResult {
    /// Frees unused capacity.
    pub(crate) fn tidy(&mut self) {
        self.fully_hidden.shrink_to_fit();
        self.hidden.shrink_to_fit();
        self.non_silhouette.shrink_to_fit();
    }
}

/// Intervals found for one segment part, before they are merged. The buffers are reused.
#[derive(Debug, Default)]
pub(crate) struct SegmentScratch {
    hidden: Vec<Interval>,
    layers: Vec<HiddenInterval>,
}

impl OcclusionInput<'_> {
    /// Compares the segment parts of a tile with its triangles.
    pub(crate) fn decide_tile(
        &self,
        items: &[TileSegment],
        triangles: &mut [OccluderBounds],
        scratch: &mut SegmentScratch,
        result: &mut TileResult,
    ) {
        let OcclusionInput { segments, limits, counting, .. } = *self;
        // Sorting pays with many lines and many triangles, because a hidden line then meets its occluder
        // first.
        let ordered =
            !counting && triangles.len() > MAX_UNSORTED_TRIANGLES && items.len() > MAX_UNSORTED_TRIANGLES / 4;
        if ordered {
            triangles.sort_by(|a, b| b.nearest.total_cmp(&a.nearest));
        }
        let entries = TriangleChoice { chosen: triangles, ordered };
        let SegmentScratch { hidden, layers } = scratch;
        for item in items.iter().filter(|item| item.end > item.start) {
            let segment = &segments[item.segment as usize];
            let is_whole = |l: &HiddenInterval| l.interval.start <= item.start && l.interval.end >= item.end;
            hidden.clear();
            if self.gather_hidden(segment, item, entries, hidden, &mut result.tests) {
                result.fully_hidden.push(*item);
                continue;
            }
            layers.clear();
            let shortest = limits.piece / segment.length().max(limits.piece);
            sweep(hidden, shortest * tolerances::TILE_SPAN_OF_SHORTEST, counting, layers);
            result.hidden.extend(layers.iter().map(|l| (item.segment, *l)));
            if segment.bounds && !layers.iter().any(is_whole) {
                self.gather_backed(segment, item, entries, &mut result.non_silhouette);
            }
        }
    }
}
