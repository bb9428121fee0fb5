//! Distance of two polylines: the Hausdorff distance and its 95th percentile.

use kurbo::Point;

use super::chain::OutlineChain;
use super::segment::nearest_on;
use super::segment_grid::SegmentGrid;
use crate::diff::tolerances::{DISTANCE_RESOLUTION_PX, MAX_DISTANCE_ERROR_SHARE};

/// Polylines with more points are searched with a grid.
const MAX_UNINDEXED_POINTS: usize = 48;
/// Sample points per vertex for percentiles, within bounds.
const SAMPLES_PER_POINT: usize = 8;
/// Fewest sample points for percentiles.
const MIN_SAMPLES: usize = 20;
/// Most sample points for percentiles.
const MAX_SAMPLES: usize = 128;

/// Distance of two chains in px.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ChainDistance {
    /// Hausdorff distance, at most the share [`MAX_DISTANCE_ERROR_SHARE`] of itself too small.
    pub largest: f64,
    /// 95th percentile of the distance, over both lines.
    pub p95: f64,
}

/// Distances between two chains.
pub(crate) fn chain_distance(a: &OutlineChain, b: &OutlineChain) -> ChainDistance {
    let (near_a, near_b) = (NearestPointQuery::new(a), NearestPointQuery::new(b));
    let largest = near_b.farthest(a, near_a.farthest(b, 0.0));
    let count =
        |chain: &OutlineChain| (chain.points.len() * SAMPLES_PER_POINT).clamp(MIN_SAMPLES, MAX_SAMPLES);
    let mut all: Vec<f64> = evenly_spaced_points(a, count(a)).map(|p| near_b.nearest(p).1).collect();
    all.extend(evenly_spaced_points(b, count(b)).map(|p| near_a.nearest(p).1));
    all.sort_by(f64::total_cmp);
    let p95 = all.get((all.len() * 95).div_ceil(100).saturating_sub(1)).copied().unwrap_or(0.0);
    ChainDistance { largest: largest.max(p95), p95 }
}

/// Evenly spaced points along a chain, from its start to its end.
pub(crate) fn evenly_spaced_points(chain: &OutlineChain, count: usize) -> impl Iterator<Item = Point> {
    let step = chain.length() / (count.max(2) - 1) as f64;
    let mut segments = chain.segments();
    let mut current = segments.next();
    let mut before = 0.0;
    (0..count).map(move |index| {
        let wanted = step * index as f64;
        while let Some((p, q)) = current {
            let length = p.distance(q);
            if wanted <= before + length || length.is_nan() {
                let share = if length > 0.0 { ((wanted - before) / length).clamp(0.0, 1.0) } else { 0.0 };
                return p.lerp(q, share);
            }
            match segments.next() {
                Some(next) => {
                    before += length;
                    current = Some(next);
                }
                // Rounding at the very end.
                None => return q,
            }
        }
        Point::ZERO
    })
}

/// Nearest-point queries on a chain.
pub(crate) struct NearestPointQuery<'a> {
    chain: &'a OutlineChain,
    grid: Option<SegmentGrid>,
}

impl<'a> NearestPointQuery<'a> {
    pub(crate) fn new(chain: &'a OutlineChain) -> Self {
        let grid = (chain.points.len() > MAX_UNINDEXED_POINTS)
            .then(|| SegmentGrid::new(std::slice::from_ref(chain)));
        Self { chain, grid }
    }

    /// The nearest segment and its distance.
    pub(crate) fn nearest(&self, p: Point) -> (usize, f64) {
        let best = std::cell::Cell::new((0, f64::INFINITY));
        let see = |index: usize| {
            let found = self.to_segment(p, index);
            let (at, least) = best.get();
            if found < least || (found == least && index < at) {
                best.set((index, found));
            }
        };
        match &self.grid {
            None => (0..self.chain.points.len() - 1).for_each(see),
            Some(grid) => {
                let enough = |seen: f64| best.get().1 <= seen * seen;
                grid.visit_rings(p, (f64::MAX.sqrt(), usize::MAX), |item| see(item as usize), enough);
            }
        }
        let (index, squared) = best.get();
        (index, squared.sqrt())
    }

    /// Squared distance of a point to a segment.
    fn to_segment(&self, p: Point, index: usize) -> f64 {
        match self.chain.points.get(index..index + 2) {
            Some(&[from, to]) => p.distance_squared(nearest_on(from, to, p)),
            _ => f64::INFINITY,
        }
    }

    /// Largest distance of a point of `other` if it exceeds `known`, by branch and bound.
    ///
    /// Between two points, the distance to one segment is convex, and the distance to the whole chain is no
    /// larger. So the larger end distance to the segment nearest to either end bounds all points between.
    pub(crate) fn farthest(&self, other: &OutlineChain, known: f64) -> f64 {
        let mut most = known;
        let mut open: Vec<(Point, usize, Point, usize)> = Vec::new();
        let mut before: Option<(Point, usize)> = None;
        for p in &other.points {
            let (segment, distance) = self.nearest(*p);
            most = most.max(distance);
            if let Some((q, near_q)) = before {
                open.push((q, near_q, *p, segment));
            }
            before = Some((*p, segment));
        }
        while let Some((p, near_p, q, near_q)) = open.pop() {
            let bound = |segment| self.to_segment(p, segment).max(self.to_segment(q, segment)).sqrt();
            let limit = most * (1.0 + MAX_DISTANCE_ERROR_SHARE) + DISTANCE_RESOLUTION_PX;
            if bound(near_p).min(bound(near_q)) <= limit || p.distance(q) <= DISTANCE_RESOLUTION_PX {
                continue;
            }
            let middle = p.midpoint(q);
            let (segment, distance) = self.nearest(middle);
            most = most.max(distance);
            open.push((p, near_p, middle, segment));
            open.push((middle, segment, q, near_q));
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(points: &[(f64, f64)]) -> OutlineChain {
        OutlineChain {
            group: 0,
            points: points.iter().map(|p| Point::from(*p)).collect(),
            closed: false,
            shapes: Vec::new(),
        }
    }

    #[test]
    fn closed_forms() {
        let line = chain(&[(0.0, 0.0), (100.0, 0.0)]);
        let beside = chain(&[(0.0, 3.0), (100.0, 3.0)]);
        assert_eq!(chain_distance(&line, &beside), ChainDistance { largest: 3.0, p95: 3.0 });
        let along = chain(&[(5.0, 0.0), (105.0, 0.0)]);
        assert!((chain_distance(&line, &along).largest - 5.0).abs() < 1e-9);
        let roof = chain(&[(0.0, 0.0), (50.0, 40.0), (100.0, 0.0)]);
        assert!((chain_distance(&line, &roof).largest - 40.0).abs() < 1e-9);
        // The farthest point of the line is in its middle, between two sides of the comb.
        let comb = chain(&[(0.0, 0.0), (0.0, 300.0), (100.0, 300.0), (100.0, 0.0)]);
        let wide = chain(&[(0.0, 0.0), (100.0, 0.0)]);
        let directed = NearestPointQuery::new(&comb).farthest(&wide, 0.0);
        assert!((directed - 50.0).abs() < 0.2, "{directed}");
    }

    #[test]
    fn evenly_spaced_points_divide_a_chain_into_equal_lengths() {
        let bent = chain(&[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0)]);
        let found: Vec<Point> = evenly_spaced_points(&bent, 5).collect();
        assert_eq!(found, [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (3.0, 1.0)].map(Point::from));
    }
}
