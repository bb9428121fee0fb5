//! Circular arcs in polylines: finds stretches whose corners lie on one circle, within the file's rounding.
//!
//! A tessellated circle has all its corners on the circle, except for the rounding of the file. Five or more
//! corners that pass this test form an arc if no chord turns by more than 22.5 degrees (16 corners a full
//! turn).
//!
//! 1. From each corner the longest stretch is found: its length doubles while it fits, then a binary search
//!    follows. Each attempt fits a circle to all corners by least squares (Kåsa). Every part of a stretch
//!    that fits also fits, so the search finds the longest one.
//! 2. A closed line is either one circle, or restarts at the end of a stretch, so that no arc is cut.
//! 3. An arc that turns too little has an uncertain radius and may be part of an ellipse. It is left as it
//!    is.
//! 4. An open line may end inside a chord of an arc because something hides the rest. The arc then extends to
//!    that end.
//! 5. An arc passes exactly through its first and last corner. It is written as cubics of at most 45 degrees.

use std::f64::consts::{FRAC_PI_4, TAU};

use kurbo::{BezPath, Point, Vec2};

use crate::chains::tolerances;
use crate::geometry::numbers::portable_math::{atan2, cos, sin, tan};
use crate::geometry::plane::planar_distance::{fit_circle_centre, length};

/// Minimum number of corners of an arc, and of a whole circle.
const MIN_ARC_CORNERS: usize = 5;
const MIN_CIRCLE_CORNERS: usize = 16;

/// Largest turn from chord to chord, radians: that of a polygon with 16 sides, and how much rounding may add.
/// A polygon with 15 sides turns by 0.026 more.
const MAX_STEP_RAD: f64 = TAU / 16.0;
const MAX_ROUNDING_RAD: f64 = 0.02;

/// Factor in the error of an arc's radius: factor × rounding ÷ angle². An arc's height over its chord is
/// radius × angle² ÷ 8.
const RADIUS_ERROR_FACTOR: f64 = 8.0;

/// Minimum turn of a stretch that is an arc for any rounding, radians.
///
/// Over an eighth of a turn, an ellipse that is a tenth longer than wide deviates from every circle by a
/// thousandth of its length. The factor 0.999 allows for rounding.
const MIN_CERTAIN_TURN_RAD: f64 = FRAC_PI_4 * 0.999;

/// Tolerances of the circle test, user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CircleTolerance {
    /// How far the rounding of the file may move a corner.
    pub rounding: f64,
    /// Largest error of an arc's radius.
    pub radius: f64,
}

/// A stretch of a polyline on one circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CircularArc {
    /// First and last corner. In a closed line the indices continue past its end.
    pub first: usize,
    pub last: usize,
    pub centre: Point,
    pub radius: f64,
    /// Turning angle in radians, positive from x to y; a full turn for a whole circle.
    pub turn: f64,
}

impl CircularArc {
    /// Whether the arc is a whole circle.
    pub(crate) fn is_circle(&self) -> bool {
        self.turn.abs() >= TAU
    }

    /// Appends the arc to a path that ends at its first corner; `end` is its last corner.
    pub(crate) fn add(&self, start: Point, end: Point, path: &mut BezPath) {
        let count = (self.turn.abs() / FRAC_PI_4 - tolerances::ARC_COUNT_ROUNDING).ceil().max(1.0);
        let step = self.turn / count;
        // Handle length for a circle of radius 1.
        let handle = 4.0 / 3.0 * tan(step / 4.0);
        let out = start - self.centre;
        let at = |k: f64| {
            let (s, c) = (sin(step * k), cos(step * k));
            Vec2::new(out.x * c - out.y * s, out.x * s + out.y * c)
        };
        let across = |v: Vec2| Vec2::new(-v.y, v.x) * handle;
        for k in 0..count as u32 {
            let (from, to) = (at(f64::from(k)), at(f64::from(k + 1)));
            let last = if f64::from(k + 1) >= count { end } else { self.centre + to };
            path.curve_to(self.centre + from + across(from), self.centre + to - across(to), last);
        }
    }
}

/// Arcs of a polyline, in its order. A closed line has to start at the first corner of the first arc.
pub(crate) fn arcs(points: &[Point], closed: bool, tolerance: CircleTolerance) -> Vec<CircularArc> {
    let n = points.len();
    if n < MIN_ARC_CORNERS || !points.iter().all(|p| p.is_finite()) {
        return Vec::new();
    }
    if !closed {
        return stretches(points, tolerance);
    }
    if let Some(circle) = fit_whole_circle(points, tolerance) {
        return vec![circle];
    }
    // The points twice: the first stretch that ends before the last point ends where a stretch of the closed
    // line does.
    let twice: Vec<Point> = points.iter().chain(points).copied().collect();
    let Some(begin) = longest_arcs(&twice, tolerance).map(|arc| arc.last).find(|last| last + 1 < twice.len())
    else {
        return Vec::new();
    };
    let begin = begin % n;
    let opened: Vec<Point> = (0..=n).map(|k| points[(begin + k) % n]).collect();
    let open_arcs = stretches(&opened, tolerance);
    open_arcs
        .into_iter()
        .map(|arc| CircularArc { first: arc.first + begin, last: arc.last + begin, ..arc })
        .collect()
}

/// Extends the first and last arc of an open line to its ends, if these lie inside a chord. Such an end moves
/// onto the arc.
pub(crate) fn extend_to_ends(points: &mut [Point], arcs: &mut [CircularArc], tolerance: CircleTolerance) {
    let n = points.len();
    if let Some(arc) = arcs.last_mut().filter(|arc| arc.last + 2 == n)
        && let Some((end, step)) = onto_arc(arc, [points[n - 2], points[n - 1]], arc.turn, tolerance)
    {
        points[n - 1] = end;
        (arc.last, arc.turn) = (n - 1, arc.turn + step);
    }
    if let Some(arc) = arcs.first_mut().filter(|arc| arc.first == 1)
        && let Some((end, step)) = onto_arc(arc, [points[1], points[0]], -arc.turn, tolerance)
    {
        points[0] = end;
        (arc.first, arc.turn) = (0, arc.turn - step);
    }
}

/// Position of a line's end on the arc that continues past `corner`, and the angle from that corner.
fn onto_arc(
    arc: &CircularArc,
    [corner, end]: [Point; 2],
    turn: f64,
    tolerance: CircleTolerance,
) -> Option<(Point, f64)> {
    let (a, b) = (corner - arc.centre, end - arc.centre);
    let step = atan2(a.cross(b), a.dot(b));
    let inside = arc.radius - length(b);
    let is_on = step * turn > 0.0
        && step.abs() <= MAX_STEP_RAD
        && (turn + step).abs() < TAU
        && inside >= -tolerance.rounding
        && inside <= tolerance.radius;
    is_on.then(|| (arc.centre + b * (arc.radius / length(b)), step))
}

/// The circle through all corners of a closed line, if they lie on one.
fn fit_whole_circle(points: &[Point], tolerance: CircleTolerance) -> Option<CircularArc> {
    if points.len() < MIN_CIRCLE_CORNERS {
        return None;
    }
    let mut ring: Vec<Point> = points.to_vec();
    ring.push(*points.first()?);
    let (centre, radius, turn) = circle(&ring, tolerance.rounding)?;
    let is_round = (turn.abs() - TAU).abs() < tolerances::TURN_ROUNDING_RAD;
    is_round.then(|| CircularArc { first: 0, last: points.len(), centre, radius, turn: TAU.copysign(turn) })
}

/// Certain arcs among the longest stretches of an open line, in order.
fn stretches(points: &[Point], tolerance: CircleTolerance) -> Vec<CircularArc> {
    let is_certain = |arc: &CircularArc| {
        let turn = arc.turn.abs();
        turn >= MIN_CERTAIN_TURN_RAD
            || RADIUS_ERROR_FACTOR * tolerance.rounding <= tolerance.radius * turn * turn
    };
    longest_arcs(points, tolerance).filter(is_certain).map(|arc| through_ends(arc, points)).collect()
}

/// Longest stretches of an open line, in order.
fn longest_arcs(points: &[Point], tolerance: CircleTolerance) -> impl Iterator<Item = CircularArc> {
    let mut from = 0;
    std::iter::from_fn(move || {
        while from + MIN_ARC_CORNERS <= points.len() {
            if let Some(arc) = longest_arc(points, from, tolerance) {
                // Starting one point later may reach farther: a line's end inside a chord is nearly on the
                // arc, but not part of it.
                let next = longest_arc(points, from + 1, tolerance).filter(|next| next.last > arc.last);
                let arc = next.unwrap_or(arc);
                from = arc.last;
                return Some(arc);
            }
            from += 1;
        }
        None
    })
}

/// Longest stretch that starts at a corner.
fn longest_arc(points: &[Point], first: usize, tolerance: CircleTolerance) -> Option<CircularArc> {
    let attempt = |last: usize| {
        let (centre, radius, turn) = circle(points.get(first..=last)?, tolerance.rounding)?;
        (turn.abs() < TAU).then_some(CircularArc { first, last, centre, radius, turn })
    };
    let end = points.len().checked_sub(1)?;
    let mut best = attempt(first + MIN_ARC_CORNERS - 1)?;
    let mut failed_last = end + 1;
    while failed_last > end && best.last < end {
        let next = (first + 2 * (best.last - first)).min(end);
        match attempt(next) {
            Some(arc) => best = arc,
            None => failed_last = next,
        }
    }
    while best.last + 1 < failed_last {
        let middle = best.last.midpoint(failed_last);
        match attempt(middle) {
            Some(arc) => best = arc,
            None => failed_last = middle,
        }
    }
    Some(best)
}

/// Centre, radius and turning angle of the circle that holds all points within `rounding`. Each point must
/// lie farther round than the one before.
fn circle(points: &[Point], rounding: f64) -> Option<(Point, f64, f64)> {
    let centre = fit_circle_centre(points)?;
    let radius = points.iter().map(|p| length(*p - centre)).sum::<f64>() / points.len() as f64;
    if points.iter().any(|p| (length(*p - centre) - radius).abs() > rounding) {
        return None;
    }
    let max_step =
        MAX_STEP_RAD + tolerances::TURN_ROUNDING_RAD + (2.0 * rounding / radius).min(MAX_ROUNDING_RAD);
    let mut turn = 0.0;
    for pair in points.windows(2) {
        let (a, b) = (pair[0] - centre, pair[1] - centre);
        let step = atan2(a.cross(b), a.dot(b));
        if step == 0.0 || step.abs() > max_step || step * turn < 0.0 {
            return None;
        }
        turn += step;
    }
    Some((centre, radius, turn))
}

/// Moves the centre of an arc so that the circle passes through both end corners.
fn through_ends(arc: CircularArc, points: &[Point]) -> CircularArc {
    let (start, end) = (points[arc.first], points[arc.last]);
    let (middle, chord) = (start.midpoint(end), end - start);
    let chord_length = length(chord);
    if chord_length <= 0.0 {
        return arc;
    }
    let across = Vec2::new(-chord.y, chord.x) / chord_length;
    let centre = middle + across * (arc.centre - middle).dot(across);
    let (a, b) = (start - centre, end - centre);
    let turn = atan2(a.cross(b), a.dot(b));
    // Of the three possible angles, the one nearest to that of the corners.
    let turns = [turn, turn + TAU, turn - TAU];
    let nearest = turns.into_iter().min_by(|a, b| (a - arc.turn).abs().total_cmp(&(b - arc.turn).abs()));
    CircularArc { centre, radius: length(a), turn: nearest.unwrap_or(turn), ..arc }
}

/// Path of a whole circle that starts at a corner.
pub(crate) fn circle_path(arc: &CircularArc, corner: Point) -> BezPath {
    let out = corner - arc.centre;
    let start = arc.centre + out * (arc.radius / length(out).max(f64::MIN_POSITIVE));
    let mut path = BezPath::new();
    path.move_to(start);
    arc.add(start, start, &mut path);
    path.close_path();
    path
}
