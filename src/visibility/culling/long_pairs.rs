//! [`LongPairs`]: long lines compared with long triangles, once per pair instead of once per tile.
//!
//! The interval that a triangle hides is computed for the whole line. Where both cross many tiles, the pair
//! would be compared in each of them. Fans of needle-shaped triangles have thousands of both in the same
//! tiles. Programs create such fans from flat faces with thousands of corners.

use crate::parallel::prelude::*;

use super::longest_interval::{NO_INTERVAL, join_or_longer};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::visibility::graph::ViewVertexKind;
use crate::visibility::occlusion::interval_sweep::{HiddenInterval, sweep};
use crate::visibility::occlusion::occlusion_input::{OcclusionInput, TileSegment};
use crate::visibility::occlusion::outer_sides::{OuterSide, OuterSides, backdrop};
use crate::visibility::occlusion::tiled_triangles::{Occluder, OccluderBounds};
use crate::visibility::occlusion::triangle_occlusion::{Interval, hidden_interval};
use crate::visibility::projection::image_segments::ImageSegment;

/// Smallest number of tiles over a long line or triangle.
const MIN_LONG_TILES: u16 = 16;
/// Lowest number of pairs over all tiles that justifies the separate comparison.
const MIN_PAIRS: u64 = 1 << 22;
/// Marks the absence of a number.
const NO_NUMBER: u32 = u32::MAX;

/// Intervals that long triangles hide of long lines.
#[derive(Debug)]
pub(crate) struct LongPairs {
    /// Number of each segment among the long ones; [`NO_NUMBER`] for the others.
    numbers: Vec<u32>,
    is_long: Vec<bool>,
    occlusions: Vec<KnownOcclusion>,
    /// Number of comparisons between a segment and a triangle.
    pub tests: u64,
}

/// Results of one segment, ascending and without overlap.
#[derive(Debug, Default)]
struct KnownOcclusion {
    hidden: Vec<HiddenInterval>,
    /// Where a long triangle lies next to the segment, for each of its [`OuterSides`].
    side_cover: [Vec<HiddenInterval>; 2],
    tests: u64,
}

impl LongPairs {
    /// Compares all long pairs; `None` if there are too few of them.
    pub(crate) fn find(
        compared: &OcclusionInput,
        items: &CsrLists<TileSegment>,
        occluders: &CsrLists<u32>,
    ) -> Option<Self> {
        let tiles = 0..occluders.count();
        let pairs = |tile: usize| items.of(tile).len() as u64 * occluders.of(tile).len() as u64;
        if tiles.clone().map(pairs).sum::<u64>() < MIN_PAIRS {
            return None;
        }
        let open = |tile: usize| items.of(tile).iter().filter(|item| item.end > item.start);
        let segment_spans = spans(compared.segments.len(), tiles.clone().flat_map(open).map(|i| i.segment));
        let triangle_spans =
            spans(compared.triangles.count(), tiles.clone().flat_map(|tile| occluders.of(tile)).copied());
        let is_long: Vec<bool> = triangle_spans.iter().map(|span| *span >= MIN_LONG_TILES).collect();
        let long_items =
            |tile: usize| open(tile).filter(|item| segment_spans[item.segment as usize] >= MIN_LONG_TILES);
        let long_ids = |tile: usize| occluders.of(tile).iter().filter(|id| is_long[**id as usize]);
        let pairs = |tile: usize| long_items(tile).count() as u64 * long_ids(tile).count() as u64;
        if tiles.clone().map(pairs).sum::<u64>() < MIN_PAIRS {
            return None;
        }
        let segments = numbered(segment_spans.iter().map(|span| *span >= MIN_LONG_TILES));
        let long = LongTriangles::new(compared, &is_long, tiles.clone().map(long_ids));
        let stays = csr_lists(segments.list.len(), |put| {
            for tile in tiles.clone() {
                for &TileSegment { segment, start, end } in long_items(tile) {
                    put(
                        segments.numbers[segment as usize] as usize,
                        TileSpan { tile: tile as u32, start, end },
                    );
                }
            }
        });
        let found_occlusions: Vec<KnownOcclusion> = (0..segments.list.len())
            .into_par_iter()
            .map_init(
                || TestMarks { marks: vec![0; long.triangles.len()], last: 0 },
                |test_marks, k| {
                    let segment = &compared.segments[segments.list[k] as usize];
                    long.compare(segment, stays.of(k), test_marks)
                },
            )
            .collect();
        let tests = found_occlusions.iter().map(|known| known.tests).sum();
        Some(Self { numbers: segments.numbers, is_long, occlusions: found_occlusions, tests })
    }

    /// Whether a segment is one of the long ones.
    pub(crate) fn has(&self, segment: u32) -> bool {
        self.numbers[segment as usize] != NO_NUMBER
    }

    /// Whether a triangle is one of the long ones.
    pub(crate) fn has_triangle(&self, id: u32) -> bool {
        self.is_long[id as usize]
    }

    /// Hidden parts of an item.
    pub(crate) fn hidden(&self, item: &TileSegment) -> impl Iterator<Item = HiddenInterval> {
        self.occlusion_of(item.segment).into_iter().flat_map(|occlusion| within(&occlusion.hidden, *item))
    }

    /// Parts of an item that a long triangle lies next to, on one of its outer sides.
    pub(crate) fn backed(&self, item: &TileSegment, side: usize) -> impl Iterator<Item = Interval> {
        let segment_occlusion = self.occlusion_of(item.segment).into_iter();
        segment_occlusion
            .flat_map(move |known| within(&known.side_cover[side], *item))
            .map(|layer| layer.interval)
    }

    fn occlusion_of(&self, segment: u32) -> Option<&KnownOcclusion> {
        self.occlusions.get(self.numbers[segment as usize] as usize)
    }
}

/// Ascending layers, clipped to an item.
fn within(layers: &[HiddenInterval], item: TileSegment) -> impl Iterator<Item = HiddenInterval> {
    let first = layers.partition_point(|layer| layer.interval.end <= item.start);
    let of_item = layers[first..].iter().take_while(move |layer| layer.interval.start < item.end);
    of_item.map(move |layer| {
        let mut layer = *layer;
        let Interval { start, end, start_kind, end_kind } = &mut layer.interval;
        if *start < item.start {
            (*start, *start_kind) = (item.start, ViewVertexKind::TJunction);
        }
        if *end > item.end {
            (*end, *end_kind) = (item.end, ViewVertexKind::TJunction);
        }
        layer
    })
}

/// Number of occurrences of each of the numbers below `count`.
fn spans(count: usize, numbers: impl Iterator<Item = u32>) -> Vec<u16> {
    let mut spans = vec![0u16; count];
    for number in numbers {
        let span = &mut spans[number as usize];
        *span = span.saturating_add(1);
    }
    spans
}

/// Subset of a list, and the number of each list entry in the subset.
struct IndexedSubset {
    list: Vec<u32>,
    numbers: Vec<u32>,
}

fn numbered(chosen: impl Iterator<Item = bool>) -> IndexedSubset {
    let mut list = Vec::new();
    let numbers = chosen.zip(0u32..).map(|(is_chosen, id)| {
        list.extend(is_chosen.then_some(id));
        if is_chosen { list.len() as u32 - 1 } else { NO_NUMBER }
    });
    let numbers = numbers.collect();
    IndexedSubset { list, numbers }
}

/// Part of a segment, with the tile that contains it.
#[derive(Debug, Clone, Copy)]
struct TileSpan {
    tile: u32,
    start: f64,
    end: f64,
}

/// Long triangles, nearest first.
struct LongTriangles<'a> {
    compared: &'a OcclusionInput<'a>,
    triangles: Vec<(OccluderBounds, Occluder)>,
    /// Numbers of the triangles in each tile, ascending.
    of_tile: Vec<Vec<u32>>,
}

/// For each triangle, the last segment it was compared with.
struct TestMarks {
    marks: Vec<u32>,
    last: u32,
}

impl<'a> LongTriangles<'a> {
    fn new<'i>(
        compared: &'a OcclusionInput<'a>,
        is_long: &[bool],
        tiles: impl Iterator<Item = impl Iterator<Item = &'i u32>>,
    ) -> Self {
        let all = compared.triangles;
        let mut triangles: Vec<(OccluderBounds, Occluder)> = (0u32..)
            .zip(is_long)
            .filter(|(_, is_long)| **is_long)
            .map(|(id, _)| (all.reach(id), all.occluder(id)))
            .collect();
        triangles.sort_by(|(a, _), (b, _)| b.nearest.total_cmp(&a.nearest).then(a.id.cmp(&b.id)));
        let mut numbers = vec![NO_NUMBER; is_long.len()];
        for (number, (reach, _)) in (0u32..).zip(&triangles) {
            numbers[reach.id as usize] = number;
        }
        let of_tile = tiles.map(|ids| {
            let mut tile_numbers: Vec<u32> = ids.map(|id| numbers[*id as usize]).collect();
            tile_numbers.sort_unstable();
            tile_numbers
        });
        let of_tile = of_tile.collect();
        Self { compared, triangles, of_tile }
    }

    /// Compares a segment with the long triangles of its tiles.
    fn compare(
        &self,
        segment: &ImageSegment,
        tile_spans: &[TileSpan],
        test_marks: &mut TestMarks,
    ) -> KnownOcclusion {
        let mut occlusion = KnownOcclusion::default();
        let mut found = self.hidden(segment, tile_spans, test_marks, &mut occlusion.tests);
        sweep(&mut found, &[], 0.0, self.compared.counting, &mut occlusion.hidden);
        let is_buried = |known: &KnownOcclusion| {
            known.hidden.iter().any(|l| l.interval.start <= 0.0 && l.interval.end >= 1.0)
        };
        if segment.bounds && !is_buried(&occlusion) {
            for (number, side) in OuterSides::of(segment, self.compared.triangles).open() {
                let mut found = self.backed(side, tile_spans, &occlusion.hidden, test_marks);
                sweep(&mut found, &[], 0.0, false, &mut occlusion.side_cover[number]);
            }
        }
        occlusion
    }

    /// Intervals that triangles hide of a segment. Once all of a stay is hidden and counts are not needed,
    /// the rest of its triangles is skipped.
    fn hidden(
        &self,
        segment: &ImageSegment,
        tile_spans: &[TileSpan],
        test_marks: &mut TestMarks,
        tests: &mut u64,
    ) -> Vec<Interval> {
        let OcclusionInput { triangles, limits, counting, .. } = *self.compared;
        let mut hidden = Vec::new();
        let mut run = NO_INTERVAL;
        test_marks.last += 1;
        for tile_span in tile_spans {
            let is_hidden = |run: (f64, f64)| !counting && run.0 <= tile_span.start && run.1 >= tile_span.end;
            let farthest =
                (segment.at(tile_span.start).z.min(segment.at(tile_span.end).z) as f32).next_down();
            for number in &self.of_tile[tile_span.tile as usize] {
                let (reach, occluder) = &self.triangles[*number as usize];
                if reach.nearest < farthest || is_hidden(run) {
                    break;
                }
                let mark = &mut test_marks.marks[*number as usize];
                if std::mem::replace(mark, test_marks.last) == test_marks.last
                    || triangles.mesh.touches(segment.hosts, occluder.face)
                {
                    continue;
                }
                *tests += 1;
                let found = hidden_interval(segment, (0.0, 1.0), occluder, &triangles.view.frame, limits);
                if let Some(found) = found {
                    run = join_or_longer(run, (found.start, found.end));
                    hidden.push(found);
                }
            }
        }
        hidden
    }

    /// Ranges where triangles lie next to a segment on one side.
    fn backed(
        &self,
        side: &OuterSide,
        tile_spans: &[TileSpan],
        hidden: &[HiddenInterval],
        test_marks: &mut TestMarks,
    ) -> Vec<Interval> {
        let limits = self.compared.limits;
        let mut backed = Vec::new();
        let mut run = NO_INTERVAL;
        test_marks.last += 1;
        for tile_span in tile_spans {
            let has = |start: f64, end: f64| start <= tile_span.start && end >= tile_span.end;
            if hidden.iter().any(|layer| has(layer.interval.start, layer.interval.end)) {
                continue;
            }
            for number in &self.of_tile[tile_span.tile as usize] {
                // The range is already complete.
                if has(run.0, run.1) {
                    break;
                }
                if std::mem::replace(&mut test_marks.marks[*number as usize], test_marks.last)
                    == test_marks.last
                {
                    continue;
                }
                if let Some((start, end)) = side.range(&self.triangles[*number as usize].1, limits) {
                    backed.push(backdrop(start, end));
                    run = join_or_longer(run, (start, end));
                }
            }
        }
        backed
    }
}

#[cfg(test)]
mod tests;
