//! [`EdgeLine`]: a view edge as a straight line in the image, with the stretches where two of them coincide.

use glam::DVec3;
use kurbo::{Point, Vec2};

use crate::visibility::graph::{ViewEdge, ViewMap};

/// Edge in the image.
pub(crate) struct EdgeLine {
    pub start: Point,
    pub along: Vec2,
    pub length: f64,
}

impl EdgeLine {
    pub(crate) fn of(map: &ViewMap, edge: &ViewEdge) -> Self {
        let start = map.vertices[edge.start.index()].position;
        let d = map.vertices[edge.end.index()].position - start;
        let length = d.hypot();
        Self { start, along: if length > 0.0 { d / length } else { Vec2::ZERO }, length }
    }

    pub(crate) fn end(&self) -> Point {
        self.start + self.along * self.length
    }

    pub(crate) fn ends(&self) -> [DVec3; 2] {
        [vector(self.start), vector(self.end())]
    }

    /// Part of this line over a range of its parameter (0 to 1).
    pub(crate) fn piece(&self, (from, to): (f64, f64)) -> Self {
        let start = self.start + self.along * (self.length * from);
        Self { start, along: self.along, length: self.length * (to - from) }
    }

    /// Range of this line's parameter (0 to 1) whose distance from the other line is at most `reach`. The
    /// area around the other line is convex, so there is one range.
    pub(crate) fn within_ink_of(&self, other: &Self, reach: f64) -> Option<(f64, f64)> {
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        // Discs around the ends of the other line.
        for end in [other.start, other.end()] {
            let (at, off) = (self.along.dot(end - self.start), self.along.cross(end - self.start));
            let half = (reach * reach - off * off).sqrt();
            if half.is_finite() {
                (from, to) = (from.min(at - half), to.max(at + half));
            }
        }
        // Strip along the other line: within its length and within `reach` of it.
        let across = Vec2::new(-other.along.y, other.along.x);
        let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
        for (way, low, high) in [(other.along, 0.0, other.length), (across, -reach, reach)] {
            let (at, rate) = (way.dot(self.start - other.start), way.dot(self.along));
            if rate == 0.0 {
                if !(low..=high).contains(&at) {
                    leaves = f64::NEG_INFINITY;
                }
            } else {
                let (p, q) = ((low - at) / rate, (high - at) / rate);
                (enters, leaves) = (enters.max(p.min(q)), leaves.min(p.max(q)));
            }
        }
        // An edge that is a point in the image has only the discs.
        if enters < leaves && other.length > 0.0 {
            (from, to) = (from.min(enters), to.max(leaves));
        }
        let (from, to) = (from.max(0.0), to.min(self.length));
        (to > from).then(|| (from / self.length, to / self.length))
    }

    /// Fast rejection test before the exact one.
    pub(crate) fn runs_along(&self, other: &Self, within: f64) -> bool {
        let shorter = self.length.min(other.length);
        self.along.cross(other.along).abs() * shorter <= 4.0 * within
            && self.along.cross(other.start - self.start).abs() <= other.length.max(self.length)
    }

    /// Range of this line's parameter (0 to 1) along which the other line is within `within`.
    pub(crate) fn covered_by(&self, other: &Self, within: f64) -> Option<(f64, f64)> {
        let project = |p: Point| self.along.dot(p - self.start);
        let offset = |p: Point| self.along.cross(p - self.start);
        let (mut a, mut b) =
            ((project(other.start), offset(other.start)), (project(other.end()), offset(other.end())));
        if a.0 > b.0 {
            std::mem::swap(&mut a, &mut b);
        }
        let (from, to) = (a.0.max(0.0), b.0.min(self.length));
        if to - from <= within {
            return None;
        }
        let slope = (b.1 - a.1) / (b.0 - a.0);
        let off = |s: f64| (a.1 + slope * (s - a.0)).abs();
        (off(from) <= within && off(to) <= within).then(|| (from / self.length, to / self.length))
    }
}

/// Point of the image with zero depth.
pub(crate) fn vector(p: Point) -> DVec3 {
    DVec3::new(p.x, p.y, 0.0)
}
