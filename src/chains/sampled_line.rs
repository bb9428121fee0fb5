//! [`SampledLine`]: the polyline of a route, with samples and per-side properties, on its way to becoming a chain.

use kurbo::Point;

use super::Sample;
use crate::chains::link::directed_edge::DirectedEdge;
use crate::geometry::plane::planar_distance::length;
use crate::mesh::PartId;
use crate::visibility::{ViewMap, ViewVertex};

/// Polyline in user units. A closed one does not repeat its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct SampledLine {
    pub points: Vec<Point>,
    /// One per point.
    pub samples: Vec<Sample>,
    /// Whether the side after each point lies on a smooth surface; one per point. The last entry of an open
    /// line repeats the one before.
    pub soft: Vec<bool>,
    /// Whether the side after each point has background behind it; one per point, as in `soft`.
    pub silhouette: Vec<bool>,
    /// Part of the side after each point; one per point, as in `soft`.
    pub part: Vec<PartId>,
    pub closed: bool,
}

impl SampledLine {
    /// Polyline of a route, without repeated points. If `noisy`, all of it counts as smooth.
    pub(crate) fn of_route(map: &ViewMap, steps: &[DirectedEdge], closed: bool, noisy: bool) -> Self {
        let mut line = Self { closed, ..Self::with_capacity(steps.len() + 1) };
        for step in steps {
            let vertex = &map.vertices[step.from(map).index()];
            let edge = &map.edges[step.edge as usize];
            line.push_of(vertex.position, sample(vertex), noisy || edge.smooth, edge.silhouette, edge.part);
        }
        if let (false, Some(last)) = (closed, steps.last()) {
            let vertex = &map.vertices[last.to(map).index()];
            let edge = &map.edges[last.edge as usize];
            line.push_of(vertex.position, sample(vertex), noisy || edge.smooth, edge.silhouette, edge.part);
        }
        while closed && line.points.len() > 1 && line.points.first() == line.points.last() {
            line.pop();
        }
        line
    }

    fn with_capacity(count: usize) -> Self {
        Self {
            points: Vec::with_capacity(count),
            samples: Vec::with_capacity(count),
            soft: Vec::with_capacity(count),
            silhouette: Vec::with_capacity(count),
            part: Vec::with_capacity(count),
            closed: false,
        }
    }

    /// Appends a point of the default part, or updates the last point if it has the same position.
    pub(crate) fn push(&mut self, point: Point, sample: Sample, soft: bool, silhouette: bool) {
        self.push_of(point, sample, soft, silhouette, PartId::default());
    }

    /// Appends a point, or updates the last point if it has the same position.
    pub(crate) fn push_of(
        &mut self,
        point: Point,
        sample: Sample,
        soft: bool,
        silhouette: bool,
        part: PartId,
    ) {
        if self.points.last() == Some(&point) {
            if let (Some(was_soft), Some(was)) = (self.soft.last_mut(), self.silhouette.last_mut()) {
                *was_soft = soft;
                *was = silhouette;
            }
            if let Some(was) = self.part.last_mut() {
                *was = part;
            }
            return;
        }
        self.points.push(point);
        self.samples.push(sample);
        self.soft.push(soft);
        self.silhouette.push(silhouette);
        self.part.push(part);
    }

    /// Removes the last point.
    pub(crate) fn pop(&mut self) {
        self.points.pop();
        self.samples.pop();
        self.soft.pop();
        self.silhouette.pop();
        self.part.pop();
    }

    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether any side lies on a smooth surface.
    pub(crate) fn is_soft(&self) -> bool {
        self.soft.iter().any(|soft| *soft)
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
            soft: self.soft[first..=last].to_vec(),
            silhouette: self.silhouette[first..=last].to_vec(),
            part: self.part[first..=last].to_vec(),
            closed: false,
        }
    }

    /// The points at the given indices, in that order.
    pub(crate) fn pick(&self, index: &[usize]) -> Self {
        Self {
            points: index.iter().map(|i| self.points[*i]).collect(),
            samples: index.iter().map(|i| self.samples[*i]).collect(),
            soft: index.iter().map(|i| self.soft[*i]).collect(),
            silhouette: index.iter().map(|i| self.silhouette[*i]).collect(),
            part: index.iter().map(|i| self.part[*i]).collect(),
            closed: self.closed,
        }
    }
}

fn sample(vertex: &ViewVertex) -> Sample {
    Sample::new(vertex.depth, f64::from(vertex.strength))
}
