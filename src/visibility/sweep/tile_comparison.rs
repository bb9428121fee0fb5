//! Comparison of the segments and triangles of one tile.

use glam::DVec3;

use crate::geometry::lists::csr_lists::csr_lists;
use crate::visibility::culling::long_pairs::LongPairs;
use crate::visibility::culling::longest_interval::{NO_INTERVAL, longer};
use crate::visibility::culling::nearness_bound::{UNCOVERED, step};
use crate::visibility::culling::occlusion_buffer;
use crate::visibility::culling::tile_occluders::{LoadedTriangle, TileOccluders};
use crate::visibility::occlusion::interval_sweep::{HiddenInterval, sweep};
use crate::visibility::occlusion::occlusion_input::{OcclusionInput, TileSegment};
use crate::visibility::occlusion::outer_sides::{OuterSide, OuterSides, backdrop, common};
use crate::visibility::occlusion::tiled_triangles::OccluderBounds;
use crate::visibility::occlusion::triangle_occlusion::{Interval, hidden_interval};
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::tile_grid::TileGrid;
use crate::visibility::tiles::triangle_columns::TriangleHalfPlanes;

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
    pub(crate) whole: Vec<TileSegment>,
    /// Hidden pieces of the other segment parts.
    pub(crate) hidden: Vec<(u32, HiddenInterval)>,
    /// Where a segment that may bound a surface has no background next to it.
    pub(crate) backed: Vec<(u32, Interval)>,
    /// Number of comparisons between a segment and a triangle.
    pub(crate) tests: u64,
}

impl TileResult {
    /// Frees unused capacity.
    pub(crate) fn tidy(&mut self) {
        self.whole.shrink_to_fit();
        self.hidden.shrink_to_fit();
        self.backed.shrink_to_fit();
    }
}

/// Input shared by all tiles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TileContext<'a> {
    pub(crate) compared: OcclusionInput<'a>,
    /// Results known for long lines; their parts are only compared with the other triangles.
    pub(crate) long: Option<&'a LongPairs>,
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
    known: Vec<HiddenInterval>,
    layers: Vec<HiddenInterval>,
}

/// Triangles of a tile to compare.
#[derive(Clone, Copy)]
struct TriangleChoice<'a> {
    chosen: &'a [u32],
    /// Whether they are sorted, nearest first.
    ordered: bool,
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
            && grid.cell > limits.beside * 64.0
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
        let SegmentScratch { mut hidden, mut known, mut layers } = std::mem::take(&mut memory.found);
        for item in items.iter().filter(|item| item.end > item.start) {
            let segment = &segments[item.segment as usize];
            let is_whole = |l: &HiddenInterval| l.interval.start <= item.start && l.interval.end >= item.end;
            known.clear();
            known.extend(self.long.iter().flat_map(|long| long.hidden(item)));
            if !counting && known.iter().any(is_whole) {
                result.whole.push(*item);
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
                result.whole.push(*item);
                continue;
            }
            layers.clear();
            let shortest = limits.piece / segment.length().max(limits.piece);
            sweep(&mut hidden, &known, shortest * 1e-3, counting, &mut layers);
            result.hidden.extend(layers.iter().map(|l| (item.segment, *l)));
            if segment.bounds && !layers.iter().any(is_whole) {
                self.gather_backed(segment, item, &mut memory.triangles, entries, result);
            }
        }
        memory.found = SegmentScratch { hidden, known, layers };
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
        let before = result.whole.len();
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
            let (first_fine, first_whole) = (fine.len(), result.whole.len());
            grid.walk(a, b, |tile, t0, t1| {
                let at = |t: f64| if t >= 1.0 { item.end } else { item.start + span * t };
                let part = TileSegment { start: at(t0), end: at(t1), ..*item };
                if (a.z + (b.z - a.z) * t0).max(a.z + (b.z - a.z) * t1) < f64::from(cover[tile]) {
                    result.whole.push(part);
                } else {
                    fine.push((tile as u32, part));
                }
            });
            if fine.len() == first_fine {
                result.whole.truncate(first_whole);
                result.whole.push(*item);
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
            result.whole.truncate(before);
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
        let slack = 2.0 * limits.beside;
        let reach = grid.cell / 2.0 * (1.0 + 1e-5) + slack;
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

    /// Collects the intervals of a segment part that triangles hide.
    ///
    /// Returns true if one triangle, or several that join, hide all of it and counts are not needed.
    #[inline(never)]
    fn gather_hidden(
        &self,
        segment: &ImageSegment,
        item: &TileSegment,
        all: &mut TileOccluders,
        entries: TriangleChoice,
        hidden: &mut Vec<Interval>,
        tests: &mut u64,
    ) -> bool {
        let OcclusionInput { triangles, limits, counting, .. } = self.compared;
        let (p, q) = (segment.at(item.start), segment.at(item.end));
        let (low, high) = (p.min(q), p.max(q));
        let bounds = [
            (low.x as f32).next_down(),
            (high.x as f32).next_up(),
            (low.y as f32).next_down(),
            (high.y as f32).next_up(),
        ];
        let farthest = (low.z as f32).next_down();
        let ends = all.window.both([p, q].map(DVec3::truncate));
        let mut run = NO_INTERVAL;
        for entry in entries.chosen {
            let reach = &all.reaches[*entry as usize];
            if reach.nearest < farthest {
                if entries.ordered {
                    break;
                }
                continue;
            }
            let b = &reach.bounds;
            if b[0] > bounds[1] || b[1] < bounds[0] || b[2] > bounds[3] || b[3] < bounds[2] {
                continue;
            }
            if triangles.mesh.touches(segment.hosts, triangles.face(reach.id)) {
                continue;
            }
            *tests += 1;
            let LoadedTriangle { sides, whole } = all.load_triangle(*entry, triangles);
            if ends.is_some_and(|[p, q]| sides.are_outside_a_side(p, q)) {
                continue;
            }
            let range = (item.start, item.end);
            let found = hidden_interval(segment, range, whole, &triangles.view.frame, limits);
            let Some(found) = found else {
                continue;
            };
            hidden.push(found);
            if !counting {
                run = longer(run, (found.start, found.end));
                if run.0 <= item.start && run.1 >= item.end {
                    return true;
                }
            }
        }
        false
    }

    /// Collects the parts of a segment without background next to them: a surface lies next to each of its
    /// open sides.
    #[inline(never)]
    fn gather_backed(
        &self,
        segment: &ImageSegment,
        item: &TileSegment,
        all: &mut TileOccluders,
        entries: TriangleChoice,
        result: &mut TileResult,
    ) {
        let sides = OuterSides::of(segment, self.compared.triangles);
        let mut open = sides.open();
        match (open.next(), open.next()) {
            (None, _) => result.backed.push((item.segment, backdrop(item.start, item.end))),
            (Some(side), None) => self.gather_backdrop(side, item, all, entries, &mut result.backed),
            (Some(first), Some(second)) => {
                let [first, second] = [first, second].map(|side| {
                    let mut found = Vec::new();
                    self.gather_backdrop(side, item, all, entries, &mut found);
                    found.into_iter().map(|(_, interval)| interval).collect()
                });
                result
                    .backed
                    .extend(common(first, second).map(|(start, end)| (item.segment, backdrop(start, end))));
            }
        }
    }

    /// Collects the ranges where a surface lies next to a segment on one side.
    fn gather_backdrop(
        &self,
        (number, side): (usize, &OuterSide),
        item: &TileSegment,
        all: &mut TileOccluders,
        entries: TriangleChoice,
        backed: &mut Vec<(u32, Interval)>,
    ) {
        let OcclusionInput { triangles, segments, limits, .. } = self.compared;
        let segment = &segments[item.segment as usize];
        let beside = side.beside(segment.at(item.start), segment.at(item.end));
        let (low, high) = (beside[0].min(beside[1]), beside[0].max(beside[1]));
        let ends = all.window.both(beside);
        let mut run = NO_INTERVAL;
        for interval in self.long.iter().flat_map(|long| long.backed(item, number)) {
            backed.push((item.segment, interval));
            run = longer(run, (interval.start, interval.end));
        }
        for entry in entries.chosen {
            // The range is already complete.
            if run.0 <= item.start && run.1 >= item.end {
                return;
            }
            let b = all.reaches[*entry as usize].bounds.map(f64::from);
            if b[0] > high.x || b[1] < low.x || b[2] > high.y || b[3] < low.y {
                continue;
            }
            let LoadedTriangle { sides, whole } = all.load_triangle(*entry, triangles);
            if ends.is_some_and(|[p, q]| sides.are_outside_a_side(p, q)) {
                continue;
            }
            let Some((start, end)) = side.range(whole, limits) else { continue };
            let (start, end) = (start.max(item.start), end.min(item.end));
            if start < end {
                backed.push((item.segment, backdrop(start, end)));
                run = longer(run, (start, end));
            }
        }
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
