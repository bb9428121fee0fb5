//! [`RawLine`]: the line of a route, with the properties that tidying needs.

use crate::chains::link::edge_class::EdgeClass;
use crate::chains::link::routes::Routes;
use crate::chains::sampled_line::SampledLine;
use crate::geometry::plane::planar_distance::length;
use crate::geometry::plane::polylines::polyline_length;
use crate::lines::LineKind;
use crate::surface::MeshSource;
use crate::visibility::{ViewEdge, ViewMap, ViewVertexId, ViewVertexKind};

/// Largest dihedral angle of a scan's crease that may be noise, degrees.
const MAX_NOISE_DEG: f32 = 45.0;

/// Line before smoothing.
#[derive(Debug, Clone)]
pub(crate) struct RawLine {
    pub line: SampledLine,
    pub class: EdgeClass,
    /// Smallest number of surfaces in front of its hidden edges; 0 if it is visible.
    pub invisibility: u16,
    /// Whether more than half of its edges lie on smooth surfaces.
    pub smooth: bool,
    /// First and last view vertex; equal for a ring.
    pub ends: [ViewVertexId; 2],
    /// Start and end vertex of each edge.
    pub vertices: Vec<ViewVertexId>,
    /// Whether a surface covers the line at its first and last point. There the line ends in the drawing, but
    /// continues on the surface.
    pub covered: [bool; 2],
    /// Weighted length of a crease; 0 for other lines. The weight grows from 0 at the noise angle to 1 at 90
    /// degrees.
    pub pronounced: f64,
    /// Smallest number of its feature segments.
    pub segment: u32,
}

impl RawLine {
    /// Line of a route; `None` if the route projects to a point. Contours and creases of scans count as
    /// smooth.
    pub(crate) fn of_route(
        map: &ViewMap,
        routes: &Routes,
        route: usize,
        classes: &[Option<EdgeClass>],
    ) -> Option<Self> {
        let (steps, closed) = routes.get(route);
        let (first, last) = (steps.first()?, steps.last()?);
        let class = classes[first.edge as usize]?;
        let noisy =
            class.origin == MeshSource::Scanned && matches!(class.kind, LineKind::Contour | LineKind::Crease);
        let line = SampledLine::of_route(map, steps, closed, noisy);
        // A closed line of two points becomes an open one that runs there and back.
        let line = if closed && line.len() == 2 { line.opened_at(0) } else { line };
        if line.len() < 2 {
            return None;
        }
        let edges = || steps.iter().map(|step| &map.edges[step.edge as usize]);
        let hidden = edges().map(|edge| edge.invisibility).filter(|i| *i > 0).min().unwrap_or(0);
        let pronounced = if class.kind == LineKind::Crease {
            let excess =
                |edge: &ViewEdge| f64::from((edge.strength - MAX_NOISE_DEG) / (90.0 - MAX_NOISE_DEG));
            edges().zip(steps).map(|(edge, step)| excess(edge) * step.length(map)).sum()
        } else {
            0.0
        };
        let ends = [first.from(map), last.to(map)];
        Some(Self {
            line,
            class,
            invisibility: if class.hidden { hidden } else { 0 },
            smooth: noisy || 2 * edges().filter(|edge| edge.smooth).count() > steps.len(),
            ends,
            vertices: edges().flat_map(|edge| [edge.start, edge.end]).collect(),
            covered: ends.map(|v| map.vertices[v.index()].kind == ViewVertexKind::TJunction),
            pronounced,
            segment: edges().map(|edge| edge.segment).min().unwrap_or(0),
        })
    }

    /// Length in the image.
    pub(crate) fn length(&self) -> f64 {
        let points = &self.line.points;
        let open = polyline_length(points);
        match (points.first(), points.last()) {
            (Some(first), Some(last)) if self.line.closed => open + length(*first - *last),
            _ => open,
        }
    }

    /// Share of its length that is silhouette, 0 to 1.
    pub(crate) fn silhouette_part(&self) -> f64 {
        let sides = || self.line.points.windows(2).map(|pair| length(pair[1] - pair[0]));
        let silhouette = sides().zip(&self.line.sides).filter(|(_, side)| side.silhouette);
        silhouette.map(|(length, _)| length).sum::<f64>() / sides().sum::<f64>().max(f64::MIN_POSITIVE)
    }

    /// Whether it ends where it starts.
    pub(crate) fn is_ring(&self) -> bool {
        self.line.closed || self.ends[0] == self.ends[1]
    }
}

/// Number of visible edge ends at each view vertex.
pub(crate) struct VertexDegrees(Vec<u32>);

impl VertexDegrees {
    pub(crate) fn new(map: &ViewMap, classes: &[Option<EdgeClass>]) -> Self {
        let mut degrees = vec![0; map.vertices.len()];
        for (edge, class) in map.edges.iter().zip(classes) {
            if class.is_some_and(|class| !class.hidden) {
                degrees[edge.start.index()] += 1;
                degrees[edge.end.index()] += 1;
            }
        }
        Self(degrees)
    }

    /// Whether at most one line ends at the vertex.
    pub(crate) fn is_free(&self, vertex: ViewVertexId) -> bool {
        self.0[vertex.index()] <= 1
    }

    /// Whether more than two edge ends meet at the vertex.
    pub(crate) fn is_junction(&self, vertex: ViewVertexId) -> bool {
        self.0[vertex.index()] > 2
    }

    /// Removes one edge end at the vertex.
    pub(crate) fn cut_off(&mut self, vertex: ViewVertexId) {
        self.0[vertex.index()] = self.0[vertex.index()].saturating_sub(1);
    }

    /// Removes all edges of a line that is dropped.
    pub(crate) fn remove_line(&mut self, raw: &RawLine) {
        raw.vertices.iter().for_each(|vertex| self.cut_off(*vertex));
    }
}
