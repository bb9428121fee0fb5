//! [`LongPairs`]: long lines compared with long triangles, once per pair instead of once per tile.
//!
//! The interval that a triangle hides is computed for the whole line. Where both cross many tiles, the pair
//! would be compared in each of them. Fans of needle-shaped triangles have thousands of both in the same
//! tiles. Programs create such fans from flat faces with thousands of corners.

use crate::parallel::prelude::*;

use super::longest_interval::{NO_INTERVAL, longer};
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
    known: Vec<KnownOcclusion>,
    /// Number of comparisons between a segment and a triangle.
    pub tests: u64,
}

/// Results of one segment, ascending and without overlap.
#[derive(Debug, Default)]
struct KnownOcclusion {
    hidden: Vec<HiddenInterval>,
    /// Where a long triangle lies next to the segment, for each of its [`OuterSides`].
    backed: [Vec<HiddenInterval>; 2],
    tests: u64,
}

impl LongPairs {
    /// Compares all long pairs; `None` if there are too few of them.
    pub fn find(
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
        let known: Vec<KnownOcclusion> = (0..segments.list.len())
            .into_par_iter()
            .map_init(
                || TestMarks { marks: vec![0; long.triangles.len()], last: 0 },
                |seen, k| {
                    let segment = &compared.segments[segments.list[k] as usize];
                    long.compare(segment, stays.of(k), seen)
                },
            )
            .collect();
        let tests = known.iter().map(|known| known.tests).sum();
        Some(Self { numbers: segments.numbers, is_long, known, tests })
    }

    /// Whether a segment is one of the long ones.
    pub fn has(&self, segment: u32) -> bool {
        self.numbers[segment as usize] != NO_NUMBER
    }

    /// Whether a triangle is one of the long ones.
    pub fn has_triangle(&self, id: u32) -> bool {
        self.is_long[id as usize]
    }

    /// Hidden parts of an item.
    pub fn hidden(&self, item: &TileSegment) -> impl Iterator<Item = HiddenInterval> {
        self.known(item.segment).into_iter().flat_map(|known| within(&known.hidden, *item))
    }

    /// Parts of an item that a long triangle lies next to, on one of its outer sides.
    pub fn backed(&self, item: &TileSegment, side: usize) -> impl Iterator<Item = Interval> {
        let known = self.known(item.segment).into_iter();
        known.flat_map(move |known| within(&known.backed[side], *item)).map(|layer| layer.interval)
    }

    fn known(&self, segment: u32) -> Option<&KnownOcclusion> {
        self.known.get(self.numbers[segment as usize] as usize)
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
            let mut own: Vec<u32> = ids.map(|id| numbers[*id as usize]).collect();
            own.sort_unstable();
            own
        });
        let of_tile = of_tile.collect();
        Self { compared, triangles, of_tile }
    }

    /// Compares a segment with the long triangles of its tiles.
    fn compare(&self, segment: &ImageSegment, stays: &[TileSpan], seen: &mut TestMarks) -> KnownOcclusion {
        let mut known = KnownOcclusion::default();
        let mut found = self.hidden(segment, stays, seen, &mut known.tests);
        sweep(&mut found, &[], 0.0, self.compared.counting, &mut known.hidden);
        let is_buried = |known: &KnownOcclusion| {
            known.hidden.iter().any(|l| l.interval.start <= 0.0 && l.interval.end >= 1.0)
        };
        if segment.bounds && !is_buried(&known) {
            for (number, side) in OuterSides::of(segment, self.compared.triangles).open() {
                let mut found = self.backed(side, stays, &known.hidden, seen);
                sweep(&mut found, &[], 0.0, false, &mut known.backed[number]);
            }
        }
        known
    }

    /// Intervals that triangles hide of a segment. Once all of a stay is hidden and counts are not needed,
    /// the rest of its triangles is skipped.
    fn hidden(
        &self,
        segment: &ImageSegment,
        stays: &[TileSpan],
        seen: &mut TestMarks,
        tests: &mut u64,
    ) -> Vec<Interval> {
        let OcclusionInput { triangles, limits, counting, .. } = *self.compared;
        let mut hidden = Vec::new();
        let mut run = NO_INTERVAL;
        seen.last += 1;
        for stay in stays {
            let is_hidden = |run: (f64, f64)| !counting && run.0 <= stay.start && run.1 >= stay.end;
            let farthest = (segment.at(stay.start).z.min(segment.at(stay.end).z) as f32).next_down();
            for number in &self.of_tile[stay.tile as usize] {
                let (reach, occluder) = &self.triangles[*number as usize];
                if reach.nearest < farthest || is_hidden(run) {
                    break;
                }
                let mark = &mut seen.marks[*number as usize];
                if std::mem::replace(mark, seen.last) == seen.last
                    || triangles.mesh.touches(segment.hosts, occluder.face)
                {
                    continue;
                }
                *tests += 1;
                let found = hidden_interval(segment, (0.0, 1.0), occluder, &triangles.view.frame, limits);
                if let Some(found) = found {
                    run = longer(run, (found.start, found.end));
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
        stays: &[TileSpan],
        hidden: &[HiddenInterval],
        seen: &mut TestMarks,
    ) -> Vec<Interval> {
        let limits = self.compared.limits;
        let mut backed = Vec::new();
        let mut run = NO_INTERVAL;
        seen.last += 1;
        for stay in stays {
            let has = |start: f64, end: f64| start <= stay.start && end >= stay.end;
            if hidden.iter().any(|layer| has(layer.interval.start, layer.interval.end)) {
                continue;
            }
            for number in &self.of_tile[stay.tile as usize] {
                // The range is already complete.
                if has(run.0, run.1) {
                    break;
                }
                if std::mem::replace(&mut seen.marks[*number as usize], seen.last) == seen.last {
                    continue;
                }
                if let Some((start, end)) = side.range(&self.triangles[*number as usize].1, limits) {
                    backed.push(backdrop(start, end));
                    run = longer(run, (start, end));
                }
            }
        }
        backed
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::lines::{NO_FACE, Role};
    use crate::mesh::{Mesh, Soup};
    use crate::scene::{Camera, UpAxis};
    use crate::view::View;
    use crate::visibility::occlusion::tiled_triangles::TiledTriangles;
    use crate::visibility::sweep::segment_visibility::decide;
    use crate::visibility::tiles::aligned_grid::grid_over;
    use crate::visibility::view_tolerances::ViewTolerances;

    /// Triangles of each fan.
    const TRIANGLES_PER_FAN: u32 = 400;

    /// Two fans of needle-shaped triangles that intersect and cross in the image.
    fn fans() -> Mesh {
        let mut soup = Soup::default();
        for [from, low, high] in [
            [DVec3::ZERO, DVec3::new(1000.0, 0.0, 0.0), DVec3::new(1000.0, 9.0, 4.0)],
            [DVec3::new(1000.0, 3.0, 5.0), DVec3::new(0.0, -4.0, -3.0), DVec3::new(0.0, 6.0, 2.0)],
        ] {
            let first = soup.positions.len() as u32;
            soup.positions.push(from);
            soup.positions.extend(
                (0..=TRIANGLES_PER_FAN).map(|k| low.lerp(high, f64::from(k) / f64::from(TRIANGLES_PER_FAN))),
            );
            soup.triangles.extend((1..=TRIANGLES_PER_FAN).map(|k| [first, first + k, first + k + 1]));
        }
        Mesh::build(soup)
    }

    #[test]
    fn needles_along_needles_are_compared_once() {
        let mesh = fans();
        let points: Vec<DVec3> = mesh.positions.iter().map(|p| *p + mesh.origin).collect();
        let camera = Camera::azimuth_elevation(0.0, 25.0, UpAxis::Z).fit_points(&points, 0.1);
        let view = View::new(&mesh, &camera);
        let limits = ViewTolerances::new(&view.frame);
        let segments: Vec<ImageSegment> = mesh
            .edges
            .vertices
            .iter()
            .enumerate()
            .map(|(edge, ends)| {
                let [a, b] = ends.map(|end| view.points[end as usize]);
                let faces = mesh.edges.faces(edge).list().to_vec();
                let host = |k: usize| faces.get(k).copied().unwrap_or(NO_FACE);
                ImageSegment {
                    a,
                    b,
                    ends: *ends,
                    cut: [false; 2],
                    hosts: [host(0), host(1)],
                    source: edge as u32,
                    bounds: false,
                    role: Role::Line,
                }
            })
            .collect();
        let grid = grid_over(segments.iter(), 1);
        let triangles = TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits };
        let all: Vec<Occluder> = (0..triangles.count() as u32).map(|id| triangles.occluder(id)).collect();
        let [plain, counted] =
            [false, true].map(|counting| decide(&mesh, &view, &segments, &limits, counting));
        // Each pair once, and not in each of about sixty tiles.
        for tests in [plain.tests, counted.tests] {
            assert!(tests <= (segments.len() * all.len()) as u64 * 3 / 2, "{tests}");
        }
        let mut counts = [0; 3];
        // The edges across the wide ends of the fans are hardly longer than rounding, so they are skipped.
        for (i, segment) in segments.iter().enumerate().filter(|(_, s)| s.length() > 100.0 * limits.px) {
            let hiders = all.iter().filter(|triangle| !segment.hosts.contains(&triangle.face));
            let intervals: Vec<Interval> = hiders
                .filter_map(|triangle| hidden_interval(segment, (0.0, 1.0), triangle, &view.frame, &limits))
                .collect();
            for k in 0..20 {
                let t = (f64::from(k) + 0.37) / 20.0;
                let is_near = |end: f64| (end - t).abs() < 1e-5;
                if intervals.iter().any(|i| is_near(i.start) || is_near(i.end)) {
                    continue;
                }
                let wanted = intervals.iter().filter(|i| i.start < t && i.end > t).count();
                let has = |layer: &&HiddenInterval| layer.interval.start < t && layer.interval.end > t;
                let found = counted.hidden(i).iter().find(has).map_or(0, |layer| usize::from(layer.count));
                assert_eq!(found, wanted, "{i} at {t}");
                assert_eq!(plain.hidden(i).iter().any(|layer| has(&layer)), wanted > 0, "{i} at {t}");
                counts[wanted.min(2)] += 1;
            }
        }
        assert!(counts[0] > 1000 && counts[1] > 1000, "{counts:?}");
    }
}
