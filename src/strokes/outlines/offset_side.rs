//! The two sides of a line of varying width: its axis offset to the left and to the right.
//!
//! On the inside of a bend or corner, points inside the ink of neighbouring axis points are removed, so that
//! a side does not fold back. The rest meets where the side crosses itself. On the outside of a corner the
//! pen's join connects the side.

use kurbo::{BezPath, Point, Vec2};

use crate::chains::fit::bezier_fit::fit;
use crate::drawing::Join;
use crate::geometry::numbers::portable_math::{atan2, cos, sin};
use crate::geometry::plane::planar_distance::unit;
use crate::strokes::axes::stroke_axis::{StrokeAxis, add_stretch};

/// Number of points on either side for measuring directions and bends.
pub(crate) const DIRECTION_REACH_POINTS: isize = 2;

/// A side point is inside the ink if its distance to the axis is below this share of the point's offset.
const INK_REACH_SHARE: f64 = 0.985;

/// Length of axis around a point that is tested for ink, in half widths.
const INK_WINDOW_HALF_WIDTHS: f64 = 7.0;

/// Number of points before and after a removed run where a self-crossing is searched.
const CROSSING_SEARCH_POINTS: usize = 5;

/// Least distance of side points from a crossing, as a share of their spacing.
const MIN_CROSSING_GAP_OF_STEP: f64 = 0.6;

/// Greatest length of a run of points between removed ones that is removed as well.
const MAX_STRAY_POINTS: usize = 2;

/// Number of points removed on either side of a spike.
const SPIKE_POINTS: usize = 2;

/// Greatest length of a mitre in half widths, as in SVG. Longer ones are bevelled.
const MITER_LIMIT_HALF_WIDTHS: f64 = 4.0;

/// Angle between points of a round join, radians.
const ROUND_JOIN_STEP_RAD: f64 = 0.35;

/// Point of a side.
#[derive(Debug, Clone, Copy)]
struct SidePoint {
    at: Point,
    /// Index of its axis point.
    of: usize,
    /// Whether the side has a corner here.
    corner: bool,
    /// Whether it is always removed: the ends of both sides at the inside of a corner.
    dropped: bool,
}

/// One side of a line, without points inside the ink.
#[derive(Debug, Clone, Default)]
pub(crate) struct OffsetSide {
    pub points: Vec<Point>,
    corners: Vec<bool>,
}

impl OffsetSide {
    /// The left (`sign` 1) or right (-1) side of an axis, at distance `halves`.
    pub(crate) fn new(axis: &StrokeAxis, halves: &[f64], sign: f64, join: Join) -> Self {
        let raw = offset_points(axis, halves, sign, join);
        let bad: Vec<bool> = raw.iter().map(|p| p.dropped || in_ink(axis, halves, p)).collect();
        let near = MIN_CROSSING_GAP_OF_STEP * axis.length() / (axis.len().max(2) - 1) as f64;
        let side = without_folds(&raw, &bad, axis.closed, near);
        if side.points.len() > 1 {
            side
        } else {
            without_folds(&raw, &vec![false; raw.len()], axis.closed, near)
        }
    }

    /// The side in reverse.
    pub(crate) fn reversed(mut self) -> Self {
        self.points.reverse();
        self.corners.reverse();
        self
    }

    /// Adds the side to a path whose current point is the first point.
    pub(crate) fn add_to(&self, tolerance: f64, path: &mut BezPath) {
        let last = self.points.len().saturating_sub(1);
        let mut from = 0;
        for to in 1..=last {
            if to == last || self.corners[to] {
                add_stretch(&self.points[from..=to], tolerance, path);
                from = to;
            }
        }
    }

    /// Adds a closed side to a path as a separate loop.
    pub(crate) fn add_loop_to(mut self, tolerance: f64, path: &mut BezPath) {
        let n = self.points.len();
        if n < 3 {
            return;
        }
        if let Some(corner) = self.corners.iter().position(|c| *c) {
            self.points.rotate_left(corner);
            self.corners.rotate_left(corner);
            self.points.push(self.points[0]);
            self.corners.push(true);
            path.move_to(self.points[0]);
            self.add_to(tolerance, path);
        } else {
            let seam = unit(self.points[1] - self.points[n - 1]);
            self.points.push(self.points[0]);
            path.move_to(self.points[0]);
            fit(&self.points, seam, seam, tolerance, path);
        }
        path.close_path();
    }
}

/// All points of a side, with the joins of its corners. A closed axis is followed once.
fn offset_points(axis: &StrokeAxis, halves: &[f64], sign: f64, join: Join) -> Vec<SidePoint> {
    let n = axis.len();
    let count = if axis.closed { n - 1 } else { n };
    let mut points = Vec::with_capacity(count + 8 * axis.corners.len());
    let normal = |along: Vec2| Vec2::new(along.y, -along.x) * sign;
    for (i, (p, half)) in axis.points.iter().copied().zip(halves.iter().copied()).enumerate().take(count) {
        let plain = |at: Point| SidePoint { at, of: i, corner: false, dropped: false };
        if axis.corners.binary_search(&i).is_ok() {
            let [comes, leaves] = axis.at_corner(i);
            let (from, to) = (normal(comes), normal(leaves));
            let outer = comes.cross(leaves) * sign > 0.0;
            if outer {
                let corner = join != Join::Round;
                points.extend(joint(p, from, to, half, join).map(|at| SidePoint { corner, ..plain(at) }));
            } else {
                let ends = [p + from * half, p + to * half];
                points.extend(ends.map(|at| SidePoint { dropped: true, ..plain(at) }));
            }
            continue;
        }
        let along = if !axis.closed && (i == 0 || i + 1 == n) {
            let out = axis.end_tangent(usize::from(i > 0));
            if i == 0 { out } else { -out }
        } else {
            axis.direction(i, DIRECTION_REACH_POINTS)
        };
        points.push(plain(p + normal(along) * half));
    }
    points
}

/// The join points of a side on the outside of a corner.
fn joint(p: Point, from: Vec2, to: Vec2, half: f64, join: Join) -> impl Iterator<Item = Point> {
    let middle = unit(from + to);
    let cosine = middle.dot(from);
    let points: Vec<Point> = match join {
        Join::Miter if cosine * MITER_LIMIT_HALF_WIDTHS > 1.0 => vec![p + middle * (half / cosine)],
        Join::Miter | Join::Bevel => vec![p + from * half, p + to * half],
        Join::Round => {
            let turn = atan2(from.cross(to), from.dot(to));
            let count = (turn.abs() / ROUND_JOIN_STEP_RAD).ceil().max(1.0) as usize;
            let at = |k: usize| {
                let angle = turn * k as f64 / count as f64;
                let (s, c) = (sin(angle), cos(angle));
                p + Vec2::new(from.x * c - from.y * s, from.x * s + from.y * c) * half
            };
            (0..=count).map(at).collect()
        }
    };
    points.into_iter()
}

/// Whether a side point lies inside the ink of axis points near its own.
fn in_ink(axis: &StrokeAxis, halves: &[f64], point: &SidePoint) -> bool {
    let n = axis.len();
    let (own, half) = (axis.arcs[point.of], halves[point.of]);
    if half <= 0.0 {
        return false;
    }
    let (window, total) = (INK_WINDOW_HALF_WIDTHS * half, axis.length());
    let ring = if axis.closed { n - 1 } else { n };
    let covers = |j: usize| {
        let reach = half.min(halves[j]) * INK_REACH_SHARE;
        (axis.points[j] - point.at).hypot2() < reach * reach
    };
    let away = |j: usize| {
        let arc_distance = (axis.arcs[j] - own).abs();
        if axis.closed { arc_distance.min(total - arc_distance) } else { arc_distance }
    };
    for sign in [-1_isize, 1] {
        for k in 1..ring as isize {
            let j = point.of as isize + sign * k;
            let j = if axis.closed { j.rem_euclid(ring as isize) } else { j };
            let Ok(j) = usize::try_from(j) else { break };
            if j >= ring || away(j) > window || (axis.closed && 2 * k > ring as isize) {
                break;
            }
            if covers(j) {
                return true;
            }
        }
    }
    false
}

/// The points that are not bad, with self-crossings in place of removed runs.
///
/// Points closer than `near` to a crossing are removed too, because they would bend the curves that end
/// there.
fn without_folds(raw: &[SidePoint], bad: &[bool], closed: bool, near: f64) -> OffsetSide {
    let n = raw.len();
    let mut keep: Vec<bool> = bad.iter().map(|bad| !bad).collect();
    if !closed && n > 0 {
        // The caps start at these points.
        keep[0] = true;
        keep[n - 1] = true;
    }
    // Remove short runs of good points between bad ones.
    for i in 1..n {
        let run = if bad[i - 1] { keep[i..].iter().take_while(|keep| **keep).count() } else { 0 };
        if (1..=MAX_STRAY_POINTS).contains(&run) && i + run < n {
            keep[i..i + run].fill(false);
        }
    }
    let Some(first) = keep.iter().position(|keep| *keep) else { return OffsetSide::default() };
    // Replacement for the removed points after each kept one: a corner, and its crossing if there is one.
    let mut after: Vec<Option<Option<Point>>> = vec![None; n];
    let mut before = first;
    for step in 1..=n {
        let i = (first + step) % n;
        if !keep[i] || (i == before && step < n) || (!closed && step + first >= n) {
            continue;
        }
        if (before + 1) % n != i {
            let (back, ahead, at) = crossing_near(raw, before, i, closed);
            for k in 0..back {
                keep[(before + n - k) % n] = false;
            }
            for k in 0..ahead {
                keep[(i + k) % n] = false;
            }
            let (from, to) = ((before + n - back) % n, (i + ahead) % n);
            after[from] = Some(at);
            if let Some(at) = at {
                // Drop neighbours that would bend the curves at the crossing.
                for k in [from, to] {
                    keep[k] &=
                        (raw[k].at - at).hypot2() >= near * near || (!closed && (k == 0 || k + 1 == n));
                }
            }
            before = to;
        } else {
            before = i;
        }
    }
    let mut side = OffsetSide::default();
    let mut push = |at: Point, corner: bool| {
        if side.points.last() == Some(&at) {
            if let Some(last) = side.corners.last_mut() {
                *last |= corner;
            }
        } else {
            side.points.push(at);
            side.corners.push(corner);
        }
    };
    let mut cut = false;
    for i in 0..n {
        if keep[i] {
            push(raw[i].at, raw[i].corner || cut || after[i] == Some(None));
            cut = after[i] == Some(None);
        }
        if let Some(Some(at)) = after[i] {
            push(at, true);
        }
    }
    if closed && side.points.len() > 1 && side.points.first() == side.points.last() {
        side.points.pop();
        side.corners[0] |= side.corners.pop().unwrap_or_default();
    }
    side
}

/// The first self-crossing near a removed run: numbers of further points to remove before and after it, and
/// its position if it exists.
fn crossing_near(
    raw: &[SidePoint],
    before: usize,
    next: usize,
    closed: bool,
) -> (usize, usize, Option<Point>) {
    let n = raw.len();
    let inside = |back: usize, ahead: usize| closed || (back <= before && next + ahead < n);
    for beyond in (0..=2 * CROSSING_SEARCH_POINTS).rev() {
        for back in 0..=beyond.min(CROSSING_SEARCH_POINTS) {
            let ahead = beyond - back;
            if ahead > CROSSING_SEARCH_POINTS || 2 * (back + ahead) + 4 > n || !inside(back, ahead) {
                continue;
            }
            let a = (before + n - back) % n;
            let d = (next + ahead) % n;
            let (b, c) = ((a + 1) % n, (d + n - 1) % n);
            if let Some(at) = crossing(raw[a].at, raw[b].at, raw[c].at, raw[d].at) {
                return (back, ahead, Some(at));
            }
        }
    }
    // A spike without width: remove its tip.
    let ends = !closed && (before < SPIKE_POINTS || next + SPIKE_POINTS >= n);
    if ends || 4 * SPIKE_POINTS + 4 > n { (0, 0, None) } else { (SPIKE_POINTS, SPIKE_POINTS, None) }
}

/// The crossing point of two segments.
fn crossing(a: Point, b: Point, c: Point, d: Point) -> Option<Point> {
    let (u, v, w) = (b - a, d - c, c - a);
    let across = u.cross(v);
    let t = w.cross(v) / across;
    let s = w.cross(u) / across;
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&s)).then(|| a + u * t)
}
