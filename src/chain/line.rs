//! [`Line`]: the polyline of a route, on its way to becoming a chain.

use kurbo::Point;

use super::link::Step;
use crate::viewmap::ViewMap;

/// A polyline in user units. A closed one does not repeat its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Line {
    pub points: Vec<Point>,
    /// Depth, one a point.
    pub depths: Vec<f64>,
    /// Whether the piece that follows each point lies on a smooth surface; one a point (the last
    /// of an open line repeats the one before).
    pub soft: Vec<bool>,
    pub closed: bool,
}

impl Line {
    /// The points of a route, points that coincide once; if `noisy`, all of it counts as lying on a
    /// smooth surface.
    pub fn of_route(map: &ViewMap, steps: &[Step], closed: bool, noisy: bool) -> Self {
        let mut line = Self {
            points: Vec::with_capacity(steps.len() + 1),
            depths: Vec::with_capacity(steps.len() + 1),
            soft: Vec::with_capacity(steps.len() + 1),
            closed,
        };
        for step in steps {
            let vertex = &map.vertices[step.from(map).index()];
            let soft = noisy || map.edges[step.edge as usize].smooth;
            line.push(vertex.position, vertex.depth, soft);
        }
        if let (false, Some(last)) = (closed, steps.last()) {
            let vertex = &map.vertices[last.to(map).index()];
            let soft = noisy || map.edges[last.edge as usize].smooth;
            line.push(vertex.position, vertex.depth, soft);
        }
        if closed {
            while line.points.len() > 1 && line.points.first() == line.points.last() {
                line.points.pop();
                line.depths.pop();
                line.soft.pop();
            }
        }
        line
    }

    /// Adds a point, or renews the last one if it lies there already.
    pub fn push(&mut self, point: Point, depth: f64, soft: bool) {
        if self.points.last() == Some(&point) {
            if let Some(last) = self.soft.last_mut() {
                *last = soft;
            }
            return;
        }
        self.points.push(point);
        self.depths.push(depth);
        self.soft.push(soft);
    }

    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether any of it lies on a smooth surface.
    pub fn is_soft(&self) -> bool {
        self.soft.iter().any(|soft| *soft)
    }

    /// The line cut open at point `start`, which is repeated at the end.
    pub fn opened_at(&self, start: usize) -> Self {
        let n = self.len();
        let index = (0..=n).map(|i| (start + i) % n.max(1));
        let index: Vec<usize> = if n == 0 { Vec::new() } else { index.collect() };
        Self {
            points: index.iter().map(|i| self.points[*i]).collect(),
            depths: index.iter().map(|i| self.depths[*i]).collect(),
            soft: index.iter().map(|i| self.soft[*i]).collect(),
            closed: false,
        }
    }

    /// Points `first..=last` as an open line.
    pub fn slice(&self, first: usize, last: usize) -> Self {
        Self {
            points: self.points[first..=last].to_vec(),
            depths: self.depths[first..=last].to_vec(),
            soft: self.soft[first..=last].to_vec(),
            closed: false,
        }
    }

    /// The points at these indices, in this order.
    pub fn pick(&self, index: &[usize]) -> Self {
        Self {
            points: index.iter().map(|i| self.points[*i]).collect(),
            depths: index.iter().map(|i| self.depths[*i]).collect(),
            soft: index.iter().map(|i| self.soft[*i]).collect(),
            closed: self.closed,
        }
    }
}

/// Distance from a point to a segment, squared.
pub(super) fn distance2(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let length2 = way.hypot2();
    let t = if length2 > 0.0 { ((p - a).dot(way) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + way * t)).hypot2()
}

/// Length of a vector; `hypot` of the platform differs between machines.
pub(super) fn length(v: kurbo::Vec2) -> f64 {
    v.hypot2().sqrt()
}
