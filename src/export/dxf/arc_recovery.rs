//! Paths as straight steps and arcs, with arcs recovered from cubics.
//!
//! A chain on a circle is written as cubics of one form: handles along the tangents, with the length given by
//! the arc's angle. Such a cubic is read back as its arc, and neighbouring arcs of one circle are merged.
//! Other curves are flattened.

use std::f64::consts::TAU;

use kurbo::{CubicBez, PathEl, Point, Vec2};

use crate::export::tolerances::MAX_ARC_FORM_ERROR;
use crate::geometry::numbers::portable_math::{atan2, cos, sin, tan};

/// Largest angle of an arc written as one cubic, in radians.
const MAX_CUBIC_RAD: f64 = 1.6;

/// Largest angle of an arc in radians. The ends of longer arcs are so close together that the centre is
/// uncertain.
pub(crate) const MAX_ARC_RAD: f64 = 6.0;

/// A straight line or an arc, by its end point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathStep {
    pub end: Point,
    /// Centre and angle of an arc.
    pub arc: Option<(Point, f64)>,
}

/// One subpath.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PathSteps {
    pub start: Point,
    pub steps: Vec<PathStep>,
    pub closed: bool,
}

impl PathSteps {
    /// Subpaths of a path; curves other than arcs are flattened within `tolerance`.
    pub(crate) fn of(path: &[PathEl], tolerance: f64) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        let mut own = Self { start: Point::ZERO, steps: Vec::new(), closed: false };
        let mut take = |own: &mut Self, closed: bool, start: Point| {
            let next = Self { start, steps: Vec::new(), closed: false };
            let done = std::mem::replace(own, next);
            if !done.steps.is_empty() {
                all.push(Self { closed, ..done }.merged());
            }
        };
        for element in path {
            let from = own.end();
            match *element {
                PathEl::MoveTo(point) => take(&mut own, false, point),
                PathEl::LineTo(point) => own.line(point),
                PathEl::ClosePath => {
                    let start = own.start;
                    take(&mut own, true, start);
                }
                PathEl::QuadTo(a, b) => own.flat([PathEl::MoveTo(from), PathEl::QuadTo(a, b)], tolerance),
                PathEl::CurveTo(a, b, end) => match arc_of(CubicBez::new(from, a, b, end)) {
                    Some(arc) => own.steps.push(PathStep { end, arc: Some(arc) }),
                    None => own.flat([PathEl::MoveTo(from), PathEl::CurveTo(a, b, end)], tolerance),
                },
            }
        }
        let start = own.start;
        take(&mut own, false, start);
        all
    }

    /// Whether any step is an arc.
    pub(crate) fn has_arcs(&self) -> bool {
        self.steps.iter().any(|step| step.arc.is_some())
    }

    /// All points of a subpath without arcs.
    pub(crate) fn points(&self) -> Vec<Point> {
        std::iter::once(self.start).chain(self.steps.iter().map(|step| step.end)).collect()
    }

    fn end(&self) -> Point {
        self.steps.last().map_or(self.start, |step| step.end)
    }

    fn line(&mut self, end: Point) {
        if self.end() != end {
            self.steps.push(PathStep { end, arc: None });
        }
    }

    /// Adds a flattened curve.
    fn flat(&mut self, curve: [PathEl; 2], tolerance: f64) {
        kurbo::flatten(curve, tolerance, |element| {
            if let PathEl::LineTo(point) = element {
                self.line(point);
            }
        });
    }

    /// Merges neighbouring arcs of one circle. A closed subpath with arcs returns to its start, and starts
    /// where an arc starts.
    fn merged(mut self) -> Self {
        if !self.has_arcs() {
            return self;
        }
        if self.closed {
            self.line(self.start);
            let is_end = |k: usize| {
                let (here, before) =
                    (self.steps[k], self.steps[(k + self.steps.len() - 1) % self.steps.len()]);
                here.arc.is_some() && !is_one_circle(before, here)
            };
            if let Some(first) = (0..self.steps.len()).find(|k| is_end(*k)) {
                self.steps.rotate_left(first);
                self.start = self.end();
            }
        }
        let mut merged: Vec<PathStep> = Vec::with_capacity(self.steps.len());
        for step in self.steps {
            match merged.last_mut() {
                Some(last) if is_one_circle(*last, step) => {
                    if let (Some((_, turn)), Some((_, more))) = (&mut last.arc, step.arc) {
                        *turn += more;
                    }
                    last.end = step.end;
                }
                _ => merged.push(step),
            }
        }
        Self { steps: merged, ..self }
    }

    /// The full circle that the subpath is, if any.
    pub(crate) fn circle(&self) -> Option<(Point, f64)> {
        match self.steps.as_slice() {
            [PathStep { arc: Some((centre, turn)), .. }]
                if self.closed && (turn.abs() - TAU).abs() < MAX_ARC_FORM_ERROR =>
            {
                Some((*centre, (self.start - *centre).hypot()))
            }
            _ => None,
        }
    }

    /// End points and bulges of an arc. An arc that nearly closes is split into two halves.
    pub(crate) fn bulges(start: Point, end: Point, (centre, turn): (Point, f64)) -> Vec<(Point, f64)> {
        if turn.abs() < MAX_ARC_RAD {
            return vec![(end, tan(turn / 4.0))];
        }
        let (s, c) = (sin(turn / 2.0), cos(turn / 2.0));
        let out = start - centre;
        let middle = centre + Vec2::new(out.x * c - out.y * s, out.x * s + out.y * c);
        vec![(middle, tan(turn / 8.0)), (end, tan(turn / 8.0))]
    }
}

/// Whether two steps are arcs of one circle in the same direction.
fn is_one_circle(a: PathStep, b: PathStep) -> bool {
    match (a.arc, b.arc) {
        (Some((one, turn)), Some((other, more))) => {
            let radius = (a.end - one).hypot();
            (one - other).hypot() <= MAX_ARC_FORM_ERROR * radius && turn * more > 0.0
        }
        _ => false,
    }
}

/// Centre and angle of the arc that a cubic stands for.
fn arc_of(curve: CubicBez) -> Option<(Point, f64)> {
    let (out, back) = (curve.p1 - curve.p0, curve.p3 - curve.p2);
    let (first, last) = (out.hypot(), back.hypot());
    let turn = atan2(out.cross(back), out.dot(back));
    if !(first > 0.0
        && turn != 0.0
        && turn.abs() <= MAX_CUBIC_RAD
        && (first - last).abs() <= MAX_ARC_FORM_ERROR * first)
    {
        return None;
    }
    // The centre is to the left of the tangent if the angle is positive (from x to y).
    let radius = first / (4.0 / 3.0 * tan(turn / 4.0));
    let centre = curve.p0 + Vec2::new(-out.y, out.x) * (radius / first);
    let (s, c) = (sin(turn), cos(turn));
    let from = curve.p0 - centre;
    let end = centre + Vec2::new(from.x * c - from.y * s, from.x * s + from.y * c);
    ((end - curve.p3).hypot() <= MAX_ARC_FORM_ERROR * radius.abs()).then_some((centre, turn))
}
