//! [`StrokeAxis`]: the centre line of a stroke, sampled from the path of a chain.
//!
//! Points are about a px apart. Each has an arc length and a scene sample; sharp corners are marked.
//! Brushes, noise and width profiles move or widen the points. The result becomes an outline, or a Bézier
//! path again. Lengths are in user units, unless stated otherwise.

use kurbo::{BezPath, Point, Vec2};

use super::path_samples::{CORNER_COSINE, dense, samples};
use crate::chains::fit::bezier_fit::{end_tangent, fit};
use crate::chains::{Chain, Sample};
use crate::geometry::plane::planar_distance::{length, segment_distance_squared, unit};
use crate::geometry::plane::polylines::arc_lengths;

/// Distance between points along the axis, px.
const POINT_STEP_PX: f64 = 1.0;

/// Minimum distance between points, as a share of [`POINT_STEP_PX`]. Closer points are merged.
const MIN_POINT_GAP_OF_STEP: f64 = 0.6;

/// Length of the chords on either side of a point that measure its turn, px.
const CORNER_REACH_PX: f64 = 2.0;

/// Maximum distance of a fitted path from its points, px.
const FIT_TOLERANCE_PX: f64 = 0.06;

/// Maximum deviation of a stretch that becomes one straight line, as a share of the fit tolerance.
const STRAIGHTNESS_OF_TOLERANCE: f64 = 0.3;

/// Centre line of a stroke, in user units.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct StrokeAxis {
    /// Points about a px apart. The last point of a closed axis equals its first.
    pub points: Vec<Point>,
    /// Arc length of each point along the chain.
    pub arcs: Vec<f64>,
    /// Scene sample at each point.
    pub samples: Vec<Sample>,
    /// Indices of the points where it turns sharply, ascending. Index 0 of a closed axis is its seam. The
    /// ends of an open axis are not included.
    pub corners: Vec<usize>,
    pub closed: bool,
}

impl StrokeAxis {
    /// The axis of a chain. `px` is the length of a px in user units. A chain without a path gives no points.
    pub(crate) fn of(chain: &Chain, px: f64) -> Self {
        let (points, joints) = dense(&chain.path, POINT_STEP_PX * px);
        let arcs = arc_lengths(&points);
        let samples = samples(chain, &points, &arcs);
        let mut axis = Self { points, arcs, samples, corners: Vec::new(), closed: chain.closed };
        axis.corners = joints.into_iter().filter(|i| axis.turns(*i, CORNER_REACH_PX * px)).collect();
        axis
    }

    /// Removes points that are too close to the previous one. Corners and ends stay.
    pub(crate) fn evened(self, px: f64) -> Self {
        let least = MIN_POINT_GAP_OF_STEP * POINT_STEP_PX * px;
        let last = self.len().saturating_sub(1);
        let mut even = Self { closed: self.closed, ..Self::default() };
        let mut arc = f64::NEG_INFINITY;
        for i in 0..self.len() {
            let corner = self.corners.binary_search(&i).is_ok();
            if !(corner || i == last || self.arcs[i] - arc >= least) {
                continue;
            }
            // A corner or end replaces a point just before it.
            if self.arcs[i] - arc < least && even.len() > 1 && even.corners.last() != Some(&(even.len() - 1))
            {
                even.points.pop();
                even.samples.pop();
                even.arcs.pop();
            }
            if corner {
                even.corners.push(even.len());
            }
            arc = self.arcs[i];
            even.push((self.points[i], self.samples[i]), arc);
        }
        even
    }

    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// Arc length from the first to the last point.
    pub(crate) fn length(&self) -> f64 {
        self.arcs.last().unwrap_or(&0.0) - self.arcs.first().unwrap_or(&0.0)
    }

    /// Arc lengths of the corners.
    pub(crate) fn corner_arcs(&self) -> Vec<f64> {
        self.corners.iter().map(|c| self.arcs[*c]).collect()
    }

    /// Whether the chords of length `reach` on both sides of a point turn by more than the corner angle.
    fn turns(&self, i: usize, reach: f64) -> bool {
        let n = self.len();
        let at = |k: isize| -> Option<Point> {
            let j = i as isize + k;
            let j = if self.closed { j.rem_euclid(n as isize - 1) } else { j };
            self.points.get(usize::try_from(j).ok()?).copied()
        };
        let far = |sign: isize| {
            let mut last = self.points[i];
            for k in 1..8 {
                let Some(p) = at(sign * k) else { break };
                last = p;
                if length(p - self.points[i]) >= reach {
                    break;
                }
            }
            last
        };
        let (before, after) = (self.points[i] - far(-1), far(1) - self.points[i]);
        unit(before).dot(unit(after)) < CORNER_COSINE
    }

    /// The part between two arc lengths. In a closed axis, `to` may lie past the seam.
    pub(crate) fn cut(&self, from: f64, to: f64) -> Self {
        let total = self.length();
        if self.closed && from <= 0.0 && to >= total {
            return self.clone();
        }
        let mut part = Self::default();
        if self.len() < 2 {
            return part;
        }
        let rounds = if self.closed { 2 } else { 1 };
        let last = self.len() - 1;
        part.push(self.at(if from >= total && self.closed { from - total } else { from }), from);
        for round in 0..rounds {
            let shift = total * f64::from(round);
            for i in 0..=last {
                let arc = self.arcs[i] + shift;
                // The seam is one point, stored twice.
                if arc <= from || arc >= to || (self.closed && i == last) {
                    continue;
                }
                if self.corners.binary_search(&i).is_ok() {
                    part.corners.push(part.len());
                }
                part.push((self.points[i], self.samples[i]), arc);
            }
        }
        part.push(self.at(if to >= total && self.closed { to - total } else { to }), to);
        part
    }

    /// Adds a midpoint if the axis has only two points, because an outline needs three.
    pub(crate) fn subdivided(mut self) -> Self {
        if let (&[a, b], &[from, to], &[start, end]) = (&self.points[..], &self.arcs[..], &self.samples[..]) {
            self.points.insert(1, a.midpoint(b));
            self.arcs.insert(1, (from + to) / 2.0);
            self.samples.insert(1, start.lerp(end, 0.5));
        }
        self
    }

    fn push(&mut self, (point, sample): (Point, Sample), arc: f64) {
        self.points.push(point);
        self.samples.push(sample);
        self.arcs.push(arc);
    }

    /// Point and sample at an arc length.
    pub(crate) fn at(&self, arc: f64) -> (Point, Sample) {
        let last = self.len() - 1;
        let next = self.arcs.partition_point(|a| *a < arc).clamp(1, last.max(1)).min(last);
        let here = next.saturating_sub(1);
        let way = self.arcs[next] - self.arcs[here];
        let t = if way > 0.0 { ((arc - self.arcs[here]) / way).clamp(0.0, 1.0) } else { 0.0 };
        (self.points[here].lerp(self.points[next], t), self.samples[here].lerp(self.samples[next], t))
    }

    /// Extends an open axis by `amount` past its first point (side 0) or last point (side 1).
    pub(crate) fn extend(&mut self, side: usize, amount: f64, px: f64) {
        let n = self.len();
        if n < 2 || amount <= 0.0 {
            return;
        }
        let count = (amount / (POINT_STEP_PX * px)).ceil() as usize;
        let (end, sample, arc) = if side == 0 {
            (self.points[0], self.samples[0], self.arcs[0])
        } else {
            (self.points[n - 1], self.samples[n - 1], self.arcs[n - 1])
        };
        let out = -self.end_tangent(side);
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let beyond = |k: usize| amount * k as f64 / count as f64;
        let more: Vec<(Point, f64)> =
            (1..=count).map(|k| (end + out * beyond(k), arc + sign * beyond(k))).collect();
        if side == 0 {
            self.points.splice(0..0, more.iter().rev().map(|m| m.0));
            self.arcs.splice(0..0, more.iter().rev().map(|m| m.1));
            self.samples.splice(0..0, std::iter::repeat_n(sample, count));
            self.corners.iter_mut().for_each(|c| *c += count);
        } else {
            self.points.extend(more.iter().map(|m| m.0));
            self.arcs.extend(more.iter().map(|m| m.1));
            self.samples.extend(std::iter::repeat_n(sample, count));
        }
    }

    /// Unit direction from the first point (side 0) or last point (side 1) of an open axis into the axis.
    pub(crate) fn end_tangent(&self, side: usize) -> Vec2 {
        let n = self.len();
        let count = match (side, self.corners.first(), self.corners.last()) {
            (0, Some(first), _) => first + 1,
            (1, _, Some(last)) => n - last,
            _ => n,
        };
        end_tangent(|k| self.points[if side == 0 { k } else { n - 1 - k }], count)
    }

    /// First and last index of the corner-free stretch around point `i`. A corner begins the stretch after
    /// it. In a closed axis, indices continue across the seam.
    pub(crate) fn stretch(&self, i: usize) -> (isize, isize) {
        let n = self.len() as isize;
        let k = self.corners.partition_point(|c| *c <= i);
        let ring = n - 1;
        let corner = |k: usize| self.corners.get(k).map(|c| *c as isize);
        let before = if k > 0 { corner(k - 1) } else { None };
        let after = corner(k);
        if self.closed {
            if self.corners.is_empty() {
                return (i as isize - ring, i as isize + ring);
            }
            let last = self.corners[self.corners.len() - 1] as isize;
            let first = self.corners[0] as isize;
            (before.unwrap_or(last - ring), after.unwrap_or(first + ring))
        } else {
            (before.unwrap_or(0), after.unwrap_or(n - 1))
        }
    }

    /// The point at an index, which may continue across the seam of a closed axis.
    pub(crate) fn point(&self, i: isize) -> Point {
        let n = self.len() as isize;
        let i = if self.closed { i.rem_euclid(n - 1) } else { i.clamp(0, n - 1) };
        self.points[i as usize]
    }

    /// Unit direction at a point from up to `reach` points on either side, not across corners.
    pub(crate) fn direction(&self, i: usize, reach: isize) -> Vec2 {
        let (first, last) = self.stretch(i);
        let k = i as isize;
        unit(self.point((k + reach).min(last)) - self.point((k - reach).max(first)))
    }

    /// Unit directions of arrival at a corner and departure from it.
    pub(crate) fn at_corner(&self, corner: usize) -> [Vec2; 2] {
        let c = corner as isize;
        [unit(self.point(c) - self.point(c - 1)), unit(self.point(c + 1) - self.point(c))]
    }

    /// The path of the axis, with Béziers between its corners.
    pub(crate) fn path(&self, px: f64) -> BezPath {
        let mut path = BezPath::new();
        let n = self.len();
        if n < 2 {
            return path;
        }
        let tolerance = FIT_TOLERANCE_PX * px;
        if self.closed && self.corners.is_empty() {
            path.move_to(self.points[0]);
            let seam = unit(self.points[1] - self.points[n - 2]);
            fit(&self.points, seam, seam, tolerance, &mut path);
            path.close_path();
            return path;
        }
        let points: Vec<Point>;
        let cuts: Vec<usize>;
        if self.closed {
            let first = self.corners[0];
            points = (0..n).map(|k| self.points[(first + k) % (n - 1)]).collect();
            cuts = self.corners.iter().map(|c| c - first).chain([n - 1]).collect();
        } else {
            points = self.points.clone();
            cuts = [0].into_iter().chain(self.corners.iter().copied()).chain([n - 1]).collect();
        }
        path.move_to(points[0]);
        for pair in cuts.windows(2) {
            add_stretch(&points[pair[0]..=pair[1]], tolerance, &mut path);
        }
        if self.closed {
            path.close_path();
        }
        path
    }
}

/// Adds a smooth stretch of points to a path whose current point is the first of them.
pub(crate) fn add_stretch(points: &[Point], tolerance: f64, path: &mut BezPath) {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
    let n = points.len();
    if n < 2 {
        return;
    }
    let straight = STRAIGHTNESS_OF_TOLERANCE * tolerance;
    if n == 2 || points.iter().all(|p| segment_distance_squared(*p, *first, *last) <= straight * straight) {
        path.line_to(*last);
        return;
    }
    let start = end_tangent(|i| points[i], n);
    let end = -end_tangent(|i| points[n - 1 - i], n);
    fit(points, start, end, tolerance, path);
}
