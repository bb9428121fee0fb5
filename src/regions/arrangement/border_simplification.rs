//! Border simplification: chains of short border segments are reduced to few points by Douglas-Peucker.
//!
//! Segments of one kind are linked into lines, which end at junctions and free ends. Each line is
//! simplified within the tolerance of its kind; junctions and ends stay. Fewer segments make the snap
//! rounding and triangulation that follow much faster.

use crate::geometry::lists::linked_lines::linked_lines;
use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use super::grid_tiles::GridPoint;
use super::snap_rounding::Border;
use crate::geometry::plane::douglas_peucker::{douglas_peucker, farthest_point};

/// Segments between points of the integer grid, with the kind of border.
pub(crate) type Segments = Vec<([GridPoint; 2], Border)>;

const NO_SEGMENT: u32 = u32::MAX;

/// Simplifies lines of segments. Points where lines meet or end stay.
///
/// `tolerance` returns the maximum deviation for a kind of border, grid steps.
pub(crate) fn simplify_borders(segments: &Segments, tolerance: impl Fn(Border) -> f64) -> Segments {
    let lines = SegmentGraph::new(segments);
    let mut out = Segments::new();
    let mut points = Vec::new();
    linked_lines(
        segments.len(),
        |segment, end| lines.next(segment, end),
        |line| {
            let (first, from) = line[0];
            points.clear();
            points.push(segments[first].0[from]);
            points.extend(line.iter().map(|(segment, from)| segments[*segment].0[1 - from]));
            make_canonical(&mut points);
            let border = segments[first].1;
            simplify(&points, tolerance(border), border, &mut out);
        },
    );
    // A canonical order, so that the result does not depend on the direction or order of the lines.
    out.iter_mut().for_each(|(ends, _)| ends.sort_unstable());
    out.par_sort_unstable();
    out
}

/// Gives a line a direction that depends on its points only. A line starts at its smaller end. A ring starts
/// at its smallest point and continues to the smaller neighbour.
fn make_canonical(points: &mut Vec<GridPoint>) {
    let last = points.len() - 1;
    if points[0] != points[last] {
        if points[last] < points[0] {
            points.reverse();
        }
        return;
    }
    points.pop();
    let least = (0..last).min_by_key(|k| points[*k]).unwrap_or(0);
    points.rotate_left(least);
    if points.last() < points.get(1) {
        points[1..].reverse();
    }
    points.push(points[0]);
}

/// Segments, indexed by their end points.
struct SegmentGraph<'a> {
    segments: &'a Segments,
    /// Point ids of the ends of each segment.
    ends: Vec<[u32; 2]>,
    /// First two segments at each point.
    at: Vec<[u32; 2]>,
    /// Number of segment ends at each point.
    count: Vec<u32>,
}

impl<'a> SegmentGraph<'a> {
    fn new(segments: &'a Segments) -> Self {
        let mut number: FxHashMap<GridPoint, u32> = FxHashMap::default();
        number.reserve(segments.len());
        let mut lines =
            Self { segments, ends: Vec::with_capacity(segments.len()), at: Vec::new(), count: Vec::new() };
        for (k, (points, _)) in segments.iter().enumerate() {
            let ends = points.map(|p| {
                let next = lines.at.len() as u32;
                let own = *number.entry(p).or_insert(next);
                if own == next {
                    lines.at.push([NO_SEGMENT; 2]);
                    lines.count.push(0);
                }
                own
            });
            for end in ends {
                let count = &mut lines.count[end as usize];
                if let Some(slot) = lines.at[end as usize].get_mut(*count as usize) {
                    *slot = k as u32;
                }
                *count += 1;
            }
            lines.ends.push(ends);
        }
        lines
    }

    /// Whether a line continues at a point: exactly two segments meet there, of the same kind.
    fn continues_at(&self, point: u32) -> bool {
        let [a, b] = self.at[point as usize];
        self.count[point as usize] == 2
            && a != b
            && self.segments[a as usize].1 == self.segments[b as usize].1
    }

    /// Segment that continues past the end of a segment, and its end there.
    fn next(&self, segment: usize, end: usize) -> Option<(usize, usize)> {
        let point = self.ends[segment][end];
        let [a, b] = self.at[point as usize];
        let next = if a as usize == segment { b } else { a } as usize;
        self.continues_at(point).then(|| (next, usize::from(self.ends[next][0] != point)))
    }
}

/// Adds the segments of a simplified line.
fn simplify(points: &[GridPoint], tolerance: f64, border: Border, out: &mut Segments) {
    let last = points.len() - 1;
    let mut stops = vec![0, last];
    if points[0] == points[last] {
        // A ring is split at the point farthest from its start.
        let away = |k: usize| square(points[k], points[0]) as f64;
        stops.insert(1, farthest_point(1..last, away, f64::NEG_INFINITY).unwrap_or(0));
    }
    let kept = douglas_peucker(points.len(), &stops, |from, to| {
        let off = |k: usize| distance2(points[k], points[from], points[to]);
        farthest_point(from + 1..to, off, tolerance * tolerance)
    });
    let mut before = points[0];
    for k in (1..points.len()).filter(|k| kept[*k]) {
        out.push(([before, points[k]], border));
        before = points[k];
    }
}

fn square(a: GridPoint, b: GridPoint) -> i64 {
    (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
}

/// Squared distance from a point to a segment.
fn distance2(p: GridPoint, a: GridPoint, b: GridPoint) -> f64 {
    let [way, to] = [b, p].map(|q| [(q[0] - a[0]) as f64, (q[1] - a[1]) as f64]);
    let length2 = way[0] * way[0] + way[1] * way[1];
    let along = to[0] * way[0] + to[1] * way[1];
    let t = if length2 > 0.0 { (along / length2).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (to[0] - way[0] * t, to[1] - way[1] * t);
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simplify_borders_keeps_ends_and_junctions() {
        // A line of ten segments, and another that meets its middle.
        let mut segments: Segments =
            (0..10).map(|k| ([[10 * k, 0], [10 * k + 10, 0]], Border::Soft)).collect();
        segments.push(([[50, 0], [50, 40]], Border::Soft));
        let mut thin = simplify_borders(&segments, |_| 0.5);
        thin.sort_unstable();
        assert_eq!(
            thin,
            [
                ([[0, 0], [50, 0]], Border::Soft),
                ([[50, 0], [50, 40]], Border::Soft),
                ([[50, 0], [100, 0]], Border::Soft)
            ]
            .map(|(ends, border)| {
                (if thin.contains(&(ends, border)) { ends } else { [ends[1], ends[0]] }, border)
            })
        );
    }

    #[test]
    fn simplify_borders_keeps_rings_closed_within_tolerance() {
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / 200.0;
            [
                (1000.0 * crate::geometry::numbers::portable_math::cos(angle)) as i64,
                (1000.0 * crate::geometry::numbers::portable_math::sin(angle)) as i64,
            ]
        };
        let segments: Segments = (0..200).map(|k| ([at(k), at((k + 1) % 200)], Border::Soft)).collect();
        let thin = simplify_borders(&segments, |_| 10.0);
        assert!((12..60).contains(&thin.len()), "{}", thin.len());
        let mut ends: Vec<GridPoint> = thin.iter().flat_map(|(ends, _)| *ends).collect();
        ends.sort_unstable();
        assert!(ends.chunks_exact(2).all(|pair| pair[0] == pair[1]), "every point has two segments");
        for k in 0..200 {
            let off = thin.iter().map(|([a, b], _)| distance2(at(k), *a, *b)).fold(f64::INFINITY, f64::min);
            assert!(off <= 100.0);
        }
    }
}
