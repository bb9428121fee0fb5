//! Path of a finished line: straight pieces become segments, and curved pieces fitted Béziers.
//!
//! A stretch of a polyline counts as a tessellated curve under two conditions. It turns only a little at
//! every vertex, and each side deviates from the circle of those turns by no more than the tolerance.
//! Everything else keeps its corners.

use kurbo::{BezPath, Point, Vec2};

use super::bezier_fit::{end_tangent, fit, tangent_of};
use crate::chains::sampled_line::SampledLine;
use crate::geometry::plane::planar_distance::{length, segment_distance_squared, unit};
use crate::geometry::plane::polyline_path;

/// Cosine of the largest turn (20 degrees) within a tessellated curve.
const MIN_STEP_COSINE: f64 = 0.9397;

/// Minimum number of sides of a tessellated curve.
const MIN_CURVE_SIDES: usize = 4;

/// Path of straight segments through all points.
pub(crate) fn polyline(line: &SampledLine) -> BezPath {
    let points = &line.points;
    if line.closed { polyline_path::polygon(points.iter().copied()) } else { polyline_path::polyline(points) }
}

/// Appends an open stretch of dense, smooth points to a path that ends at the first of them.
pub(crate) fn add_smooth(points: &[Point], tolerance: f64, path: &mut BezPath) {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
    let n = points.len();
    if is_straight(points, 0.3 * tolerance) {
        path.line_to(*last);
        return;
    }
    debug_assert!(n > 2 && first.is_finite());
    let start = end_tangent(|i| points[i], n);
    let end = -end_tangent(|i| points[n - 1 - i], n);
    fit(points, start, end, tolerance, path);
}

/// Path of a closed line of dense, smooth points without corners.
pub(crate) fn closed_smooth(points: &[Point], tolerance: f64) -> BezPath {
    let mut path = BezPath::new();
    let n = points.len();
    if n < 4 {
        return path;
    }
    let ring: Vec<Point> = points.iter().copied().chain([points[0]]).collect();
    let seam = unit(points[1] - points[n - 1]);
    path.move_to(points[0]);
    fit(&ring, seam, seam, tolerance, &mut path);
    path.close_path();
    path
}

/// Whether all points lie within `tolerance` of the segment from first to last.
fn is_straight(points: &[Point], tolerance: f64) -> bool {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return true };
    points.iter().all(|p| segment_distance_squared(*p, *first, *last) <= tolerance * tolerance)
}

/// Appends an open exact polyline, with curves in place of its tessellated stretches.
pub(crate) fn add_exact(points: &[Point], tolerance: f64, path: &mut BezPath) {
    let sides = points.len().saturating_sub(1);
    if sides < MIN_CURVE_SIDES {
        points.iter().skip(1).for_each(|p| path.line_to(*p));
        return;
    }
    let curved = curved_sides(points, false, tolerance);
    let mut i = 0;
    while i < sides {
        let run = curved[i..].iter().take_while(|c| **c).count();
        let run = run.min(run_to_corner(points, i, run));
        if run < MIN_CURVE_SIDES {
            for p in &points[i + 1..=i + run.max(1)] {
                path.line_to(*p);
            }
            i += run.max(1);
            continue;
        }
        let stretch = &points[i..=i + run];
        // A straight neighbour without a corner in between gives the curve its tangent.
        let before = (i > 0).then(|| points[i] - points[i - 1]);
        let after = (i + run < sides).then(|| points[i + run + 1] - points[i + run]);
        let n = stretch.len();
        let start = tangent_or_neighbour(before, end_direction(stretch[0], stretch[1], stretch[2]));
        let end = tangent_or_neighbour(after, -end_direction(stretch[n - 1], stretch[n - 2], stretch[n - 3]));
        fit(&subdivided(stretch), start, end, tolerance, path);
        i += run;
    }
}

/// Path of a closed exact polyline, with curves in place of its tessellated stretches.
pub(crate) fn closed_exact(line: &SampledLine, tolerance: f64) -> BezPath {
    let points = &line.points;
    let n = points.len();
    let curved = curved_sides(points, true, tolerance);
    let mut path = BezPath::new();
    if n >= 2 * MIN_CURVE_SIDES && curved.iter().all(|c| *c) {
        let ring = subdivided(&line.opened_at(0).points);
        let seam = unit(points[1] - points[n - 1]);
        path.move_to(points[0]);
        fit(&ring, seam, seam, tolerance, &mut path);
    } else {
        // Start at a corner or on a straight side, so that no curve is cut.
        let start = curved.iter().position(|c| !*c).map_or(0, |side| (side + 1) % n.max(1));
        let open = line.opened_at(start);
        let Some(first) = open.points.first() else { return path };
        path.move_to(*first);
        add_exact(&open.points, tolerance, &mut path);
        // The last side is drawn by closing.
        if matches!(path.elements().last(), Some(kurbo::PathEl::LineTo(_))) && path.elements().len() > 3 {
            path.pop();
        }
    }
    path.close_path();
    path
}

/// Number of sides from `i` on, at most `run`, without a corner between them.
fn run_to_corner(points: &[Point], i: usize, run: usize) -> usize {
    (1..run).find(|k| turn(points, i + k) < MIN_STEP_COSINE).unwrap_or(run)
}

fn turn(points: &[Point], i: usize) -> f64 {
    let n = points.len();
    unit(points[i % n] - points[(i + n - 1) % n]).dot(unit(points[(i + 1) % n] - points[i % n]))
}

/// One flag for each side: whether it is a chord of a tessellated curve.
fn curved_sides(points: &[Point], closed: bool, tolerance: f64) -> Vec<bool> {
    let n = points.len();
    let sides = if closed { n } else { n.saturating_sub(1) };
    // Turn at a vertex in radians, approximated by its chord; none at a corner.
    let bend = |i: usize| -> Option<f64> {
        if !closed && (i == 0 || i + 1 == n) {
            return None;
        }
        let cosine = turn(points, i);
        (cosine >= MIN_STEP_COSINE).then(|| (2.0 - 2.0 * cosine.min(1.0)).max(0.0).sqrt())
    };
    (0..sides)
        .map(|i| {
            let (a, b) = (bend(i), bend((i + 1) % n));
            let turn = match (a, b) {
                (Some(a), Some(b)) => a.max(b),
                (Some(a), None) | (None, Some(a)) => a,
                (None, None) => return false,
            };
            // A chord of length L that turns by θ deviates from its circle by Lθ/8.
            length(points[(i + 1) % n] - points[i]) * turn / 8.0 <= tolerance
        })
        .collect()
}

/// Tangent at the end `a` of a curve through `a`, `b`, `c`: the chord, rotated by half a step.
fn end_direction(a: Point, b: Point, c: Point) -> Vec2 {
    let (chord, next) = (unit(b - a), unit(c - b));
    let (la, lb) = (length(b - a), length(c - b));
    unit(chord - (next - chord) * (la / (la + lb).max(f64::MIN_POSITIVE)))
}

/// Direction of a straight neighbour if the curve meets it without a corner, otherwise the curve's own
/// direction.
fn tangent_or_neighbour(neighbour: Option<Vec2>, own: Vec2) -> Vec2 {
    match neighbour.map(unit) {
        Some(straight) if straight.dot(own) > MIN_STEP_COSINE => straight,
        _ => own,
    }
}

/// Adds points along the sides, so that the fit follows the sides and not only the vertices.
fn subdivided(points: &[Point]) -> Vec<Point> {
    let mut dense = Vec::with_capacity(4 * points.len());
    for pair in points.windows(2) {
        if let [a, b] = pair {
            dense.extend((0..4).map(|k| a.lerp(*b, f64::from(k) / 4.0)));
        }
    }
    dense.extend(points.last());
    debug_assert!(dense.len() > 1 && tangent_of(&dense, 1).is_finite());
    dense
}
