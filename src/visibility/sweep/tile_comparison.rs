//! Comparison of the segments and triangles of one tile.

use glam::DVec3;

use super::segment_comparison::{TileContext, TriangleChoice};
use crate::geometry::lists::csr_lists::csr_lists;
use crate::visibility::culling::nearness_bound::{UNCOVERED, step};
use crate::visibility::culling::occlusion_buffer;
use crate::visibility::culling::tile_occluders::TileOccluders;
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

/// Buffers that a worker reuses from tile to tile.
#[derive(Debug, Default)]
pub(crate) struct TileScratch {
    /// The triangles of the tile.
    pub(crate) triangles: TileOccluders,
    /// 0, 1, 2 and so on.
    numbers: Vec<u32>,
    /// Buffers for the comparison of one segment part.
    found: SegmentScratch,
}

/// Intervals found for one segment part, before they are merged.
#[derive(Debug, Default)]
struct SegmentScratch {
    hidden: Vec<Interval>,
    /// Layers known to hide it before the comparison.
    known_layers: Vec<HiddenInterval>,
    layers: Vec<HiddenInterval>,
}

impl TileContext<'_> {
    /// Compares the segment parts of a tile of a grid with its triangles.
    pub(crate) fn decide_tile(
        &self,
        items: &[TileSegment],
        memory: &mut TileScratch,
        grid: &TileGrid,
        tile: usize,
        result: &mut TileResult,
    ) {
        let count = memory.triangles.reaches.len();
        let mut numbers = std::mem::take(&mut memory.numbers);
        numbers.extend(numbers.len() as u32..count as u32);
        let entries = TriangleChoice { chosen: &numbers[..count], ordered: false };
        self.decide(items, memory, entries, (grid, tile), result);
        memory.numbers = numbers;
    }

    fn decide(
        &self,
        items: &[TileSegment],
        memory: &mut TileScratch,
        entries: TriangleChoice,
        (grid, tile): (&TileGrid, usize),
        result: &mut TileResult,
    ) {
        let OcclusionInput { segments, limits, counting, .. } = self.compared;
        let count = entries.chosen.len();
        if count > MAX_UNSORTED_TRIANGLES
            && items.len() * count > MAX_PAIRS_PER_ENTRY * (items.len() + count)
            && grid.cell > limits.side_offset * 64.0
            && self.decide_subdivided(
                items,
                memory,
                entries,
                &grid.of_tile(tile, SUBDIVISIONS_PER_SIDE),
                result,
            )
        {
            return;
        }
        let sorted: Vec<u32>;
        let mut entries = entries;
        // Sorting pays with many lines and many triangles, because a hidden line then meets its occluder
        // first.
        if !counting && count > MAX_UNSORTED_TRIANGLES && items.len() > MAX_UNSORTED_TRIANGLES / 4 {
            sorted = nearest_first(&memory.triangles.reaches, entries.chosen);
            entries = TriangleChoice { chosen: &sorted, ordered: true };
        }
        let SegmentScratch { mut hidden, known_layers: mut known, mut layers } =
            std::mem::take(&mut memory.found);
        for item in items.iter().filter(|item| item.end > item.start) {
            let segment = &segments[item.segment as usize];
            let is_whole = |l: &HiddenInterval| l.interval.start <= item.start && l.interval.end >= item.end;
            known.clear();
            known.extend(self.long.iter().flat_map(|long| long.hidden(item)));
            if !counting && known.iter().any(is_whole) {
                result.fully_hidden.push(*item);
                continue;
            }
            hidden.clear();
            if self.gather_hidden(
                segment,
                item,
                &mut memory.triangles,
                entries,
                &mut hidden,
                &mut result.tests,
            ) {
                result.fully_hidden.push(*item);
                continue;
            }
            layers.clear();
            let shortest = limits.piece / segment.length().max(limits.piece);
            sweep(&mut hidden, &known, shortest * tolerances::TILE_SPAN_OF_SHORTEST, counting, &mut layers);
            result.hidden.extend(layers.iter().map(|l| (item.segment, *l)));
            if segment.bounds && !layers.iter().any(is_whole) {
                self.gather_backed(segment, item, &mut memory.triangles, entries, &mut result.non_silhouette);
            }
        }
        memory.found = SegmentScratch { hidden, known_layers: known, layers };
    }

    /// Subdivides a crowded tile: where a dense model is small on the page, the grid over the page does not
    /// separate its lines.
    ///
    /// Returns false and decides nothing where lines and triangles lie along each other, because they would
    /// only meet more often.
    fn decide_subdivided(
        &self,
        items: &[TileSegment],
        memory: &mut TileScratch,
        entries: TriangleChoice,
        grid: &TileGrid,
        result: &mut TileResult,
    ) -> bool {
        let OcclusionInput { triangles, segments, limits, counting } = self.compared;
        let before = result.fully_hidden.len();
        let mut cover = vec![UNCOVERED; grid.len()];
        if !counting {
            for entry in entries.chosen {
                let whole = &memory.triangles.load_triangle(*entry, triangles).whole;
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
        let fine_pairs = self.subdivided_pairs(&mut memory.triangles, entries, grid, |tile, nearest| {
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
                self.decide(items, memory, TriangleChoice { chosen, ordered: false }, (grid, tile), result);
            }
        }
        true
    }

    /// Pairs of finer tile and triangle that may overlap, where `is_wanted(tile, nearness)`.
    fn subdivided_pairs(
        &self,
        all: &mut TileOccluders,
        entries: TriangleChoice,
        grid: &TileGrid,
        is_wanted: impl Fn(usize, f64) -> bool,
    ) -> Vec<(u32, u32)> {
        let OcclusionInput { triangles, limits, .. } = self.compared;
        let slack = 2.0 * limits.side_offset;
        let reach = grid.cell / 2.0 * (1.0 + tolerances::TILE_MARGIN_OF_TILE) + slack;
        let mut pairs = Vec::with_capacity(entries.chosen.len() * 2);
        for entry in entries.chosen {
            let OccluderBounds { bounds, nearest, .. } = all.reaches[*entry as usize];
            let [left, right, top, bottom] = bounds.map(f64::from);
            let (low, high) = (DVec3::new(left, top, 0.0), DVec3::new(right, bottom, 0.0));
            let tiles = grid.tile_box(low - slack, high + slack);
            // The bounding box of a needle-shaped triangle contains many tiles that the triangle misses.
            let sides = (tiles.area() > 4)
                .then(|| TriangleHalfPlanes::new(&all.load_triangle(*entry, triangles).whole.corners));
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

/// Some of the triangles, nearest first; equally near ones in their order.
fn nearest_first(reaches: &[OccluderBounds], chosen: &[u32]) -> Vec<u32> {
    // Bits that sort by falling nearness, above the index in the tile.
    let key = |entry: &u32| {
        let bits = reaches[*entry as usize].nearest.to_bits();
        let falling = if bits >> 31 == 0 { !bits & (u32::MAX >> 1) } else { bits };
        u64::from(falling) << 32 | u64::from(*entry)
    };
    let mut keys: Vec<u64> = chosen.iter().map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|key| key as u32).collect()
}
