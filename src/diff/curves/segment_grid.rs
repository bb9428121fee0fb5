//! Uniform grid of the segments of chains, for queries of what is near.

use std::sync::OnceLock;

use kurbo::Point;

use super::chain::OutlineChain;
use super::segment::Segment;
use super::segment_clusters::SegmentClusters;
use crate::diff::tolerances;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};

/// Most cells along the longer side.
const MAX_CELLS_PER_SIDE: f64 = 2048.0;

/// Mean segment length in cells, at most. It limits the number of cells per segment.
const MEAN_CELLS_PER_SEGMENT: f64 = 16.0;

/// Above this number of candidate segments, the cluster tree is used instead.
const MAX_NEAR_SEGMENTS: usize = 4096;

/// Segments sorted into square cells.
#[derive(Debug)]
pub(crate) struct SegmentGrid {
    pub segments: Vec<Segment>,
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Numbers of the segments that cross each cell.
    items: CsrLists<u32>,
    clusters: OnceLock<SegmentClusters>,
}

impl SegmentGrid {
    /// Builds the grid from the segments of chains.
    pub(crate) fn new(chains: &[OutlineChain]) -> Self {
        Self::of(chains.iter().enumerate())
    }

    /// Builds the grid from the segments of chains with given numbers.
    pub(crate) fn of<'a>(chains: impl Iterator<Item = (usize, &'a OutlineChain)>) -> Self {
        let segments: Vec<Segment> = chains
            .flat_map(|(chain, c)| {
                c.segments().map(move |(from, to)| Segment { chain: chain as u32, from, to })
            })
            .collect();
        let mut low = Point::new(f64::INFINITY, f64::INFINITY);
        let mut high = Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
        for p in segments.iter().flat_map(|s| [s.from, s.to]) {
            low = Point::new(low.x.min(p.x), low.y.min(p.y));
            high = Point::new(high.x.max(p.x), high.y.max(p.y));
        }
        if segments.is_empty() {
            (low, high) = (Point::ZERO, Point::ZERO);
        }
        let side = (high.x - low.x).max(high.y - low.y).max(1.0);
        // About one segment per cell if spread evenly, and a bounded number of cells per segment.
        let count = segments.len().max(1) as f64;
        let mean = segments.iter().map(|s| s.from.distance(s.to)).sum::<f64>() / count;
        let cell =
            (side / count.sqrt().ceil().clamp(1.0, MAX_CELLS_PER_SIDE)).max(mean / MEAN_CELLS_PER_SEGMENT);
        let count = |length: f64| (length / cell) as usize + 1;
        let (columns, rows) = (count(high.x - low.x), count(high.y - low.y));
        let mut grid = Self {
            segments,
            origin: low,
            cell,
            columns,
            rows,
            items: CsrLists::default(),
            clusters: OnceLock::new(),
        };
        grid.items = csr_lists(columns * rows, |put| {
            for (index, segment) in grid.segments.iter().enumerate() {
                grid.cells(segment.from, segment.to, 0.0, |cell| put(cell, index as u32));
            }
        });
        grid
    }

    /// Visits each cell that may contain points within `reach` of a segment.
    fn cells(&self, from: Point, to: Point, reach: f64, mut call: impl FnMut(usize)) {
        let (low, high) = if from.y <= to.y { (from, to) } else { (to, from) };
        let row = |y: f64| ((y - self.origin.y) / self.cell).floor();
        let column = |x: f64| ((x - self.origin.x) / self.cell).floor();
        let first = row(low.y - reach).max(0.0);
        let last = row(high.y + reach).min(self.rows as f64 - 1.0);
        if first > last {
            return;
        }
        let slope = if high.y > low.y { (high.x - low.x) / (high.y - low.y) } else { 0.0 };
        let level = high.y - low.y <= self.cell * tolerances::MAX_LEVEL_RISE_OF_CELL;
        for y in first as usize..=last as usize {
            // Part of the segment within reach of the row.
            let bottom = self.origin.y + y as f64 * self.cell - reach;
            let top = bottom + self.cell + 2.0 * reach;
            let (x0, x1) = if level {
                (low.x, high.x)
            } else {
                let x = |y: f64| low.x + (y.clamp(low.y, high.y) - low.y) * slope;
                (x(bottom), x(top))
            };
            // A small margin for rounding.
            let slack = reach + self.cell * tolerances::COLUMN_MARGIN_OF_CELL;
            let left = column(x0.min(x1) - slack).max(0.0);
            let right = column(x0.max(x1) + slack).min(self.columns as f64 - 1.0);
            if left <= right {
                (left as usize..=right as usize).for_each(|x| call(y * self.columns + x));
            }
        }
    }

    /// Collects the segments that may lie within `reach` of a segment, each once, in order. Returns `false`
    /// if there are too many; then use [`Self::clusters`].
    pub(crate) fn near(&self, from: Point, to: Point, reach: f64, found: &mut Vec<u32>) -> bool {
        found.clear();
        let mut cells = 0;
        self.cells(from, to, reach, |cell| {
            if found.len() <= MAX_NEAR_SEGMENTS {
                found.extend_from_slice(self.items.of(cell));
            }
            cells += 1;
        });
        if found.len() > MAX_NEAR_SEGMENTS {
            return false;
        }
        // The segments of a single cell are already sorted.
        if cells > 1 {
            found.sort_unstable();
            found.dedup();
        }
        true
    }

    /// Cluster tree of all segments, built on first use.
    pub(crate) fn bundles(&self) -> &SegmentClusters {
        self.clusters.get_or_init(|| SegmentClusters::new(&self.segments))
    }

    /// Visits segments in rings of cells around a point, nearest ring first.
    ///
    /// After each ring, `enough` receives the distance within which all segments were visited, and returns
    /// whether to stop. The search also stops at distance `reach` or after `most_seen` segments.
    pub(crate) fn visit_rings(
        &self,
        p: Point,
        (reach, most_seen): (f64, usize),
        mut see: impl FnMut(u32),
        mut enough: impl FnMut(f64) -> bool,
    ) {
        let column = ((p.x - self.origin.x) / self.cell).floor();
        let row = ((p.y - self.origin.y) / self.cell).floor();
        let (columns, rows) = (self.columns as f64, self.rows as f64);
        let most = (reach / self.cell).ceil() + 1.0;
        let mut ring = 0.0;
        let mut left = most_seen;
        while ring <= most && left > 0 {
            let mut visit = |x: f64, y: f64, see: &mut dyn FnMut(u32)| {
                if (0.0..columns).contains(&x) && (0.0..rows).contains(&y) {
                    let items = self.items.of(y as usize * self.columns + x as usize);
                    items.iter().take(left).for_each(|item| see(*item));
                    left -= items.len().min(left);
                }
            };
            let mut y = (row - ring).max(0.0);
            while y <= (row + ring).min(rows - 1.0) {
                let whole = y == row - ring || y == row + ring;
                let mut x = if whole { (column - ring).max(0.0) } else { column - ring };
                while x <= (column + ring).min(columns - 1.0) {
                    visit(x, y, &mut see);
                    x += if whole || ring == 0.0 { 1.0 } else { 2.0 * ring };
                }
                y += 1.0;
            }
            if enough(ring * self.cell) {
                return;
            }
            ring += 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::segment::nearest_on;
    use super::*;

    fn random_chains(count: u32, seed: u64) -> Vec<OutlineChain> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1u32 << 24)
        };
        (0..count)
            .map(|_| {
                let start = Point::new(next() * 900.0, next() * 700.0);
                let reach = if next() < 0.1 { 800.0 } else { 20.0 };
                let end = Point::new(start.x + (next() - 0.5) * reach, start.y + (next() - 0.5) * reach);
                OutlineChain { group: 0, points: vec![start, end], closed: false, shapes: Vec::new() }
            })
            .collect()
    }

    #[test]
    fn near_finds_every_segment_within_reach() {
        let chains = random_chains(400, 7);
        let grid = SegmentGrid::new(&chains);
        let mut found = Vec::new();
        for chain in random_chains(60, 9) {
            let (from, to) = (chain.points[0], chain.points[1]);
            assert!(grid.near(from, to, 3.0, &mut found));
            for (index, segment) in grid.segments.iter().enumerate() {
                let near = (0..=200).any(|i| {
                    let p = from.lerp(to, f64::from(i) / 200.0);
                    p.distance(nearest_on(segment.from, segment.to, p)) <= 3.0
                });
                assert!(!near || found.contains(&(index as u32)), "segment {index}");
            }
        }
    }

    #[test]
    fn visit_rings_finds_the_nearest_segment() {
        let chains = random_chains(300, 11);
        let grid = SegmentGrid::new(&chains);
        for chain in random_chains(80, 13) {
            let p = chain.points[0];
            let distance = |s: &Segment| p.distance(nearest_on(s.from, s.to, p));
            let wanted = grid.segments.iter().map(distance).fold(f64::INFINITY, f64::min);
            let best = std::cell::Cell::new(f64::INFINITY);
            let see = |item: u32| best.set(best.get().min(distance(&grid.segments[item as usize])));
            grid.visit_rings(p, (5000.0, usize::MAX), see, |seen| best.get() <= seen);
            assert_eq!(best.get(), wanted);
        }
    }
}
