//! Comparison of the segments and triangles of one tile.

use glam::DVec3;

use super::segment_comparison::TriangleChoice;
use crate::geometry::lists::csr_lists::csr_lists;
use crate::visibility::culling::nearness_bound::{UNCOVERED, step};
use crate::visibility::culling::occlusion_buffer;
use crate::visibility::occlusion::interval_sweep::{HiddenInterval, sweep};
use crate::visibility::occlusion::occlusion_input::{OcclusionInput, TileSegment};
use crate::visibility::occlusion::tiled_triangles::OccluderBounds;
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::tiles::tile_grid::TileGrid;
use crate::visibility::tiles::triangle_columns::TriangleHalfPlanes;
use crate::visibility::tolerances;

/// Lists up to this length are neither sorted nor subdivided.
const MAX_UNSORTED_TRIANGLES: usize = 32;
/// Largest number of pairs per segment and triangle of a tile before it is subdivided.
const MAX_PAIRS_PER_ENTRY: usize = 64;
/// Finer tiles along each side of a subdivided tile.
const SUBDIVISIONS_PER_SIDE: u32 = 8;
/// Largest growth factor of the number of pairs for keeping a subdivision.
const MAX_PAIR_GROWTH: usize = 2;

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
    /// Compares the segment parts of a tile of a grid with its triangles.
    pub(crate) fn decide_tile(
        &self,
        items: &[TileSegment],
        entries: TriangleChoice,
        (grid, tile): (&TileGrid, usize),
        scratch: &mut SegmentScratch,
        result: &mut TileResult,
    ) {
        let OcclusionInput { segments, limits, counting, .. } = *self;
        let count = entries.chosen.len();
        if count > MAX_UNSORTED_TRIANGLES
            && items.len() * count > MAX_PAIRS_PER_ENTRY * (items.len() + count)
            && grid.cell > limits.side_offset * 64.0
            && self.decide_subdivided(
                items,
                entries,
                &grid.of_tile(tile, SUBDIVISIONS_PER_SIDE),
                scratch,
                result,
            )
        {
            return;
        }
        let sorted: Vec<OccluderBounds>;
        let mut entries = entries;
        // Sorting pays with many lines and many triangles, because a hidden line then meets its occluder
        // first.
        if !counting && count > MAX_UNSORTED_TRIANGLES && items.len() > MAX_UNSORTED_TRIANGLES / 4 {
            sorted = nearest_first(entries.chosen);
            entries = TriangleChoice { chosen: &sorted, ordered: true };
        }
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

    /// Subdivides a crowded tile: where a dense model is small on the page, the grid over the page does not
    /// separate its lines.
    ///
    /// Returns false and decides nothing where lines and triangles lie along each other, because they would
    /// only meet more often.
    fn decide_subdivided(
        &self,
        items: &[TileSegment],
        entries: TriangleChoice,
        grid: &TileGrid,
        scratch: &mut SegmentScratch,
        result: &mut TileResult,
    ) -> bool {
        let OcclusionInput { triangles, segments, limits, counting } = *self;
        let before = result.fully_hidden.len();
        let mut cover = vec![UNCOVERED; grid.len()];
        if !counting {
            for entry in entries.chosen {
                let whole = triangles.occluder(entry.id);
                let frame = &triangles.view.frame;
                let step = step(&whole.corners, limits, &whole.slack, frame);
                occlusion_buffer::add(&whole.corners, grid, step, limits, &mut cover);
            }
        }
        let mut fine: Vec<(u32, TileSegment)> = Vec::with_capacity(items.len() * 2);
        for item in items.iter().filter(|item| item.end > item.start) {
            let segment = &segments[item.segment as usize];
            let (a, b) = (segment.at(item.start), segment.at(item.end));
            let span = item.end - item.start;
            let (first_fine, first_whole) = (fine.len(), result.fully_hidden.len());
            grid.walk(a, b, |tile, t0, t1| {
                let at = |t: f64| if t >= 1.0 { item.end } else { item.start + span * t };
                let part = TileSegment { start: at(t0), end: at(t1), ..*item };
                if (a.z + (b.z - a.z) * t0).max(a.z + (b.z - a.z) * t1) < f64::from(cover[tile]) {
                    result.fully_hidden.push(part);
                } else {
                    fine.push((tile as u32, part));
                }
            });
            if fine.len() == first_fine {
                result.fully_hidden.truncate(first_whole);
                result.fully_hidden.push(*item);
            }
        }
        let fine_items = csr_lists(grid.len(), |put| {
            for (tile, item) in &fine {
                put(*tile as usize, *item);
            }
        });
        let fine_pairs = self.subdivided_pairs(entries, grid, |tile, nearest| {
            nearest >= f64::from(cover[tile]) && !fine_items.of(tile).is_empty()
        });
        let fine_entries = csr_lists(grid.len(), |put| {
            for (tile, entry) in &fine_pairs {
                put(*tile as usize, *entry);
            }
        });
        let pairs = |tile: usize| fine_items.of(tile).len() * fine_entries.of(tile).len();
        if (0..grid.len()).map(pairs).sum::<usize>() > MAX_PAIR_GROWTH * items.len() * entries.chosen.len() {
            result.fully_hidden.truncate(before);
            return false;
        }
        for tile in 0..grid.len() {
            let (items, chosen) = (fine_items.of(tile), fine_entries.of(tile));
            if !items.is_empty() {
                let entries = TriangleChoice { chosen, ordered: false };
                self.decide_tile(items, entries, (grid, tile), scratch, result);
            }
        }
        true
    }

    /// Pairs of finer tile and triangle that may overlap, where `is_wanted(tile, nearness)`.
    fn subdivided_pairs(
        &self,
        entries: TriangleChoice,
        grid: &TileGrid,
        is_wanted: impl Fn(usize, f64) -> bool,
    ) -> Vec<(u32, OccluderBounds)> {
        let OcclusionInput { triangles, limits, .. } = *self;
        let slack = 2.0 * limits.side_offset;
        let reach = grid.cell / 2.0 * (1.0 + tolerances::TILE_MARGIN_OF_TILE) + slack;
        let mut pairs = Vec::with_capacity(entries.chosen.len() * 2);
        for entry in entries.chosen {
            let OccluderBounds { bounds, nearest, id } = *entry;
            let [left, right, top, bottom] = bounds.map(f64::from);
            let (low, high) = (DVec3::new(left, top, 0.0), DVec3::new(right, bottom, 0.0));
            let tiles = grid.tile_box(low - slack, high + slack);
            // The bounding box of a needle-shaped triangle contains many tiles that the triangle misses.
            let sides = (tiles.area() > 4).then(|| TriangleHalfPlanes::new(&triangles.occluder(id).corners));
            for row in tiles.top..=tiles.bottom {
                let whole = u32::from(tiles.left)..u32::from(tiles.right) + 1;
                let columns = sides.as_ref().map_or(whole, |sides| sides.columns(grid, tiles, row, reach));
                let of_row = columns.map(|column| grid.tile(column, u32::from(row)));
                let wanted = of_row.filter(|tile| is_wanted(*tile, f64::from(nearest)));
                pairs.extend(wanted.map(|tile| (tile as u32, *entry)));
            }
        }
        pairs
    }
}

/// Triangles, nearest first; equally near ones in their order.
fn nearest_first(chosen: &[OccluderBounds]) -> Vec<OccluderBounds> {
    let mut sorted = chosen.to_vec();
    sorted.sort_by(|a, b| b.nearest.total_cmp(&a.nearest));
    sorted
}
