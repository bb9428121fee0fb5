//! A set of image segments with fast queries for the distance to the nearest one.

use kurbo::{BezPath, PathEl, Point};
use ligne::chains::Chain;
use rustc_hash::FxHashMap;

/// Segments in a uniform grid of square tiles.
pub(crate) struct SegmentGrid {
    segments: Vec<[Point; 2]>,
    tiles: FxHashMap<(i64, i64), Vec<u32>>,
    /// Maximum distance that is measured, px; also the side of a tile.
    reach: f64,
}

impl SegmentGrid {
    pub(crate) fn new(segments: Vec<[Point; 2]>, reach: f64) -> Self {
        let mut tiles: FxHashMap<(i64, i64), Vec<u32>> = FxHashMap::default();
        for (i, [a, b]) in segments.iter().enumerate() {
            // Long segments are inserted piece by piece, to limit the tiles per segment.
            let pieces = ((*b - *a).hypot() / reach).ceil().max(1.0) as usize;
            for k in 0..pieces {
                let [p, q] = [k, k + 1].map(|k| tile(a.lerp(*b, k as f64 / pieces as f64), reach));
                for x in p.0.min(q.0)..=p.0.max(q.0) {
                    for y in p.1.min(q.1)..=p.1.max(q.1) {
                        let own = tiles.entry((x, y)).or_default();
                        if own.last() != Some(&(i as u32)) {
                            own.push(i as u32);
                        }
                    }
                }
            }
        }
        Self { segments, tiles, reach }
    }

    /// Segments that may be within reach of a point, with their numbers; some occur more than once.
    pub(crate) fn segments_near(&self, p: Point) -> impl Iterator<Item = (usize, [Point; 2])> + '_ {
        let (x, y) = tile(p, self.reach);
        let around = (x - 1..=x + 1).flat_map(move |x| (y - 1..=y + 1).map(move |y| (x, y)));
        let ids = around.filter_map(|at| self.tiles.get(&at)).flatten();
        ids.map(|i| (*i as usize, self.segments[*i as usize]))
    }

    /// The distance to the nearest segment; infinite if above the reach.
    pub(crate) fn distance(&self, p: Point) -> f64 {
        let nearest =
            self.segments_near(p).map(|(_, s)| segment_distance(p, s)).fold(f64::INFINITY, f64::min);
        if nearest <= self.reach { nearest } else { f64::INFINITY }
    }
}

fn tile(p: Point, side: f64) -> (i64, i64) {
    ((p.x / side).floor() as i64, (p.y / side).floor() as i64)
}

/// The distance from a point to a segment.
pub(crate) fn segment_distance(p: Point, [a, b]: [Point; 2]) -> f64 {
    (p - a.lerp(b, nearest_parameter(p, [a, b]))).hypot()
}

/// Parameter of the point of a segment nearest to `p`, 0 to 1.
pub(crate) fn nearest_parameter(p: Point, [a, b]: [Point; 2]) -> f64 {
    let way = b - a;
    if way.hypot2() > 0.0 { ((p - a).dot(way) / way.hypot2()).clamp(0.0, 1.0) } else { 0.0 }
}

/// Samples along segments, at most `step` apart, each with the length it represents.
pub(crate) fn sample_segments(segments: &[[Point; 2]], step: f64) -> Vec<(Point, f64)> {
    let mut found = Vec::new();
    for [a, b] in segments {
        let length = (*b - *a).hypot();
        let count = (length / step).ceil().max(1.0);
        for k in 0..count as usize {
            found.push((a.lerp(*b, (k as f64 + 0.5) / count), length / count));
        }
    }
    found
}

/// A path as short segments within `tolerance` of it.
pub(crate) fn flatten_path(path: &BezPath, tolerance: f64) -> Vec<[Point; 2]> {
    let (mut segments, mut at, mut start) = (Vec::new(), Point::ZERO, Point::ZERO);
    kurbo::flatten(path, tolerance, |element| match element {
        PathEl::MoveTo(p) => (at, start) = (p, p),
        PathEl::LineTo(p) => {
            segments.push([at, p]);
            at = p;
        }
        _ => segments.push([at, start]),
    });
    segments
}

/// Length of one set of segments that is farther than `within` from another set, px.
pub(crate) fn length_farther_than(of: &[[Point; 2]], from: &[[Point; 2]], within: f64) -> f64 {
    let ink = SegmentGrid::new(from.to_vec(), within + 1.0);
    sample_segments(of, 0.25).iter().filter(|(p, _)| ink.distance(*p) > within).map(|(_, l)| l).sum()
}

/// The drawn curves of visible chains, as segments within a thousandth of a px of them.
pub(crate) fn drawn_segments(chains: &[Chain]) -> Vec<[Point; 2]> {
    let visible = chains.iter().filter(|c| c.invisibility == 0);
    visible.flat_map(|chain| flatten_path(&chain.path, 1e-3)).collect()
}

/// The quantile of sorted values: the given share of them is at most this.
pub(crate) fn quantile(values: &[f64], share: f64) -> f64 {
    let last = values.len().saturating_sub(1) as f64;
    values.get((share * last).round() as usize).copied().unwrap_or(0.0)
}
