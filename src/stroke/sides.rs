//! The two sides of a line of varying width: its axis moved to the left and to the right.
//!
//! On the inside of a bend or corner, points that would lie in the ink of the line's neighbouring points are
//! left out, so that a side does not turn back on itself; what remains meets where the sides cross. On
//! the outside of a corner the sides are joined as the pen says.

use kurbo::{BezPath, Point, Vec2};

use super::axis::{Axis, add_stretch, length};
use crate::chain::fit::{fit, unit};
use crate::drawing::Join;
use crate::math::function::{atan2, cos, sin};

/// Directions and bends are taken over this many points on either side.
pub(super) const REACH: isize = 2;

/// A point of a side lies in the ink if it is nearer to the axis than this part of its own distance.
const IN_INK: f64 = 0.985;

/// How far along the axis ink is looked for, half widths.
const WINDOW: f64 = 7.0;

/// A joint that would point out farther than this, half widths, is cut off, as in SVG.
const MITER_LIMIT: f64 = 4.0;

/// Points of a round joint are this far apart, radians.
const ROUND_STEP: f64 = 0.35;

/// A point of a side.
#[derive(Debug, Clone, Copy)]
struct SidePoint {
    at: Point,
    /// The point of the axis that it belongs to.
    of: usize,
    /// Whether the side has a corner here.
    corner: bool,
    /// Whether it must go, wherever it lies: the ends of both sides within a corner.
    dropped: bool,
}

/// One side of a line, cleaned of what lies in the ink.
#[derive(Debug, Clone, Default)]
pub(super) struct Side {
    pub points: Vec<Point>,
    corners: Vec<bool>,
}

impl Side {
    /// The left (`sign` 1) or right (-1) side of an axis, `halves` away from it.
    pub fn new(axis: &Axis, halves: &[f64], sign: f64, join: Join) -> Self {
        let raw = raw(axis, halves, sign, join);
        let bad: Vec<bool> = raw.iter().map(|p| p.dropped || in_ink(axis, halves, p)).collect();
        let side = cleaned(&raw, &bad, axis.closed);
        if side.points.len() > 1 { side } else { cleaned(&raw, &vec![false; raw.len()], axis.closed) }
    }

    /// The same, run through from its other end.
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self.corners.reverse();
        self
    }

    /// Adds the side to a path that stands at its first point.
    pub fn add_to(&self, tolerance: f64, path: &mut BezPath) {
        let last = self.points.len().saturating_sub(1);
        let mut from = 0;
        for to in 1..=last {
            if to == last || self.corners[to] {
                add_stretch(&self.points[from..=to], tolerance, path);
                from = to;
            }
        }
    }

    /// Adds a closed side to a path, as a loop of its own.
    pub fn add_loop_to(mut self, tolerance: f64, path: &mut BezPath) {
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

/// All points of a side, with the joints of its corners; those of a closed axis once round.
fn raw(axis: &Axis, halves: &[f64], sign: f64, join: Join) -> Vec<SidePoint> {
    let n = axis.len();
    let count = if axis.closed { n - 1 } else { n };
    let mut points = Vec::with_capacity(count + 8 * axis.corners.len());
    let normal = |along: Vec2| Vec2::new(along.y, -along.x) * sign;
    for i in 0..count {
        let (p, half) = (axis.points[i], halves[i]);
        let plain = |at: Point| SidePoint { at, of: i, corner: false, dropped: false };
        if axis.corners.binary_search(&i).is_ok() {
            let [comes, leaves] = axis.at_corner(i);
            let (from, to) = (normal(comes), normal(leaves));
            let outer = comes.cross(leaves) * sign > 0.0;
            let ends = [p + from * half, p + to * half];
            if outer {
                let sharp = join != Join::Round;
                points.push(SidePoint { corner: sharp, ..plain(ends[0]) });
                points.extend(
                    joint(p, from, to, half, join).map(|at| SidePoint { corner: sharp, ..plain(at) }),
                );
                points.push(SidePoint { corner: sharp, ..plain(ends[1]) });
            } else {
                points.extend(ends.map(|at| SidePoint { dropped: true, ..plain(at) }));
            }
            continue;
        }
        let along = if !axis.closed && (i == 0 || i + 1 == n) {
            let out = axis.end_tangent(usize::from(i > 0));
            if i == 0 { out } else { -out }
        } else {
            axis.direction(i, REACH)
        };
        points.push(plain(p + normal(along) * half));
    }
    points
}

/// What lies between the two ends of the sides at the outside of a corner.
fn joint(p: Point, from: Vec2, to: Vec2, half: f64, join: Join) -> impl Iterator<Item = Point> {
    let between: Vec<Point> = match join {
        Join::Bevel => Vec::new(),
        Join::Miter => {
            let middle = unit(from + to);
            let cosine = middle.dot(from);
            if cosine * MITER_LIMIT > 1.0 { vec![p + middle * (half / cosine)] } else { Vec::new() }
        }
        Join::Round => {
            let turn = atan2(from.cross(to), from.dot(to));
            let count = (turn.abs() / ROUND_STEP).ceil() as usize;
            let at = |k: usize| {
                let angle = turn * k as f64 / count as f64;
                let (s, c) = (sin(angle), cos(angle));
                p + Vec2::new(from.x * c - from.y * s, from.x * s + from.y * c) * half
            };
            (1..count).map(at).collect()
        }
    };
    between.into_iter()
}

/// Whether a point of a side lies in the ink of points of the axis near its own.
fn in_ink(axis: &Axis, halves: &[f64], point: &SidePoint) -> bool {
    let n = axis.len();
    let (own, half) = (axis.arcs[point.of], halves[point.of]);
    if half <= 0.0 {
        return false;
    }
    let (window, total) = (WINDOW * half, axis.length());
    let ring = if axis.closed { n - 1 } else { n };
    let covers = |j: usize| {
        let reach = half.min(halves[j]) * IN_INK;
        (axis.points[j] - point.at).hypot2() < reach * reach
    };
    let away = |j: usize| {
        let way = (axis.arcs[j] - own).abs();
        if axis.closed { way.min(total - way) } else { way }
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

/// The points that are not bad, and where the side crosses itself instead of those that are.
fn cleaned(raw: &[SidePoint], bad: &[bool], closed: bool) -> Side {
    let n = raw.len();
    let mut side = Side::default();
    let Some(first) = (0..n).find(|i| !bad[*i]) else { return side };
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
    let mut before = first;
    push(raw[first].at, raw[first].corner);
    for step in 1..=n {
        let i = (first + step) % n;
        if (!closed && first + step >= n) || bad[i] {
            continue;
        }
        let gap = (i + n - before) % n;
        if gap > 1 {
            let (a, b) = (raw[before].at, raw[(before + 1) % n].at);
            let (c, d) = (raw[(i + n - 1) % n].at, raw[i].at);
            let mid = if length(a - d) > 0.0 { a.midpoint(d) } else { a };
            push(crossing(a, b, c, d).unwrap_or(mid), true);
        }
        if step < n {
            push(raw[i].at, raw[i].corner);
        }
        before = i;
    }
    if closed && side.points.len() > 1 && side.points.first() == side.points.last() {
        side.points.pop();
        side.corners.pop();
    }
    side
}

/// Where two segments cross.
fn crossing(a: Point, b: Point, c: Point, d: Point) -> Option<Point> {
    let (u, v, w) = (b - a, d - c, c - a);
    let across = u.cross(v);
    let t = w.cross(v) / across;
    let s = w.cross(u) / across;
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&s)).then(|| a + u * t)
}
