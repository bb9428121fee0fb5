//! [`SampledLine`]: the polyline of a route, with samples and per-side properties, on its way to becoming a chain.

use kurbo::Point;

use super::Sample;
use crate::chains::link::directed_edge::DirectedEdge;
use crate::geometry::plane::planar_distance::length;
use crate::mesh::PartId;
use crate::visibility::{ViewMap, ViewVertex, ViewVertexId};

/// Properties of the side between two points of a line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct LineSide {
    /// Whether it lies on a smooth surface.
    pub(crate) soft: bool,
    /// Whether it has background behind it.
    pub(crate) silhouette: bool,
    pub(crate) part: PartId,
}

impl LineSide {
    /// Side of the default part.
    pub(crate) fn soft(soft: bool) -> Self {
        Self { soft, ..Self::default() }
    }
}

/// Polyline in user units. A closed one does not repeat its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct SampledLine {
    pub points: Vec<Point>,
    /// One per point.
    pub samples: Vec<Sample>,
    /// The side after each point; one per point. The last entry of an open line repeats the one before.
    pub(crate) sides: Vec<LineSide>,
    pub closed: bool,
}

impl SampledLine {
    /// Polyline of a route, without repeated points. If `noisy`, all of it counts as smooth.
    pub(crate) fn of_route(map: &ViewMap, steps: &[DirectedEdge], closed: bool, noisy: bool) -> Self {
        let count = steps.len() + 1;
        let (points, samples) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut line = Self { points, samples, sides: Vec::with_capacity(count), closed };
        let mut push = |vertex: ViewVertexId, step: &DirectedEdge| {
            let (vertex, edge) = (&map.vertices[vertex.index()], &map.edges[step.edge as usize]);
            let side = LineSide { soft: noisy || edge.smooth, silhouette: edge.silhouette, part: edge.part };
            line.push(vertex.position, sample(vertex), side);
        };
        steps.iter().for_each(|step| push(step.from(map), step));
        if let (false, Some(last)) = (closed, steps.last()) {
            push(last.to(map), last);
        }
        while closed && line.points.len() > 1 && line.points.first() == line.points.last() {
            line.pop();
        }
        line
    }

    /// Appends a point, or updates the side after the last point if it has the same position.
    pub(crate) fn push(&mut self, point: Point, sample: Sample, side: LineSide) {
        if let (true, Some(last)) = (self.points.last() == Some(&point), self.sides.last_mut()) {
            *last = side;
            return;
        }
        self.points.push(point);
        self.samples.push(sample);
        self.sides.push(side);
    }

    /// Removes the last point.
    pub(crate) fn pop(&mut self) {
        self.points.pop();
        self.samples.pop();
        self.sides.pop();
    }

    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether any side lies on a smooth surface.
    pub(crate) fn is_soft(&self) -> bool {
        self.sides.iter().any(|side| side.soft)
    }

    /// Length weighted by strength.
    pub(crate) fn strength(&self) -> f64 {
        let n = self.len();
        let sides = if self.closed { n } else { n.saturating_sub(1) };
        let side = |i: usize| {
            let j = (i + 1) % n;
            let mean = (self.samples[i].strength + self.samples[j].strength) / 2.0;
            mean * length(self.points[j] - self.points[i])
        };
        (0..sides).map(side).sum()
    }

    /// Greatest strength.
    pub(crate) fn peak(&self) -> f64 {
        self.samples.iter().map(|sample| sample.strength).fold(0.0, f64::max)
    }

    /// The line opened at point `start`, which is repeated at the end.
    pub(crate) fn opened_at(&self, start: usize) -> Self {
        let n = self.len();
        let index = (0..=n).map(|i| (start + i) % n.max(1));
        let index: Vec<usize> = if n == 0 { Vec::new() } else { index.collect() };
        Self { closed: false, ..self.pick(&index) }
    }

    /// Points `first..=last` as an open line.
    pub(crate) fn slice(&self, first: usize, last: usize) -> Self {
        Self {
            points: self.points[first..=last].to_vec(),
            samples: self.samples[first..=last].to_vec(),
            sides: self.sides[first..=last].to_vec(),
            closed: false,
        }
    }

    /// The points at the given indices, in that order.
    pub(crate) fn pick(&self, index: &[usize]) -> Self {
        Self {
            points: index.iter().map(|i| self.points[*i]).collect(),
            samples: index.iter().map(|i| self.samples[*i]).collect(),
            sides: index.iter().map(|i| self.sides[*i]).collect(),
            closed: self.closed,
        }
    }
}

fn sample(vertex: &ViewVertex) -> Sample {
    Sample::new(vertex.depth, f64::from(vertex.strength))
}
