//! [`Raw`]: the line of a route with what tidying has to know of it.

use crate::chains::link::edge_class::Class;
use crate::chains::link::routes::Routes;
use crate::chains::sampled_line::Line;
use crate::geometry::plane::planar_distance::length;
use crate::lines::LineKind;
use crate::surface::Origin;
use crate::visibility::{ViewEdge, ViewMap, ViewVertexId, ViewVertexKind};

/// Degrees of a dihedral angle that on a scan may well be noise.
const FAINT_DEG: f32 = 45.0;

/// A line before it is smoothed.
#[derive(Debug, Clone)]
pub(crate) struct Raw {
    pub line: Line,
    pub class: Class,
    /// Smallest number of surfaces that hide any of it.
    pub invisibility: u16,
    /// Whether most of it lies on smooth surfaces.
    pub smooth: bool,
    /// Where it begins and ends; twice the same vertex in a ring.
    pub ends: [ViewVertexId; 2],
    /// The view vertices its pieces begin and end at, each piece's two.
    pub vertices: Vec<ViewVertexId>,
    /// Whether a surface covers the line at its first and last point, so that it ends in the
    /// drawing, but not on the surface.
    pub covered: [bool; 2],
    /// Length of a crease, each piece weighted by how much it turns beyond what may be noise; a
    /// right angle counts once. 0 for other lines.
    pub pronounced: f64,
    /// Smallest number of the feature segments that it has pieces of.
    pub segment: u32,
}

impl Raw {
    /// The line of a route; `None` for one seen end-on as a point. All of it counts as lying on a
    /// smooth surface if it is a contour or crease of a scan.
    pub fn of_route(map: &ViewMap, routes: &Routes, route: usize, classes: &[Option<Class>]) -> Option<Self> {
        let (steps, closed) = routes.get(route);
        let (first, last) = (steps.first()?, steps.last()?);
        let class = classes[first.edge as usize]?;
        let noisy =
            class.origin == Origin::Scanned && matches!(class.kind, LineKind::Contour | LineKind::Crease);
        let line = Line::of_route(map, steps, closed, noisy);
        // A closed line of two points runs there and back.
        let line = if closed && line.len() == 2 { line.opened_at(0) } else { line };
        if line.len() < 2 {
            return None;
        }
        let edges = || steps.iter().map(|step| &map.edges[step.edge as usize]);
        let hidden = edges().map(|edge| edge.invisibility).filter(|i| *i > 0).min().unwrap_or(0);
        let pronounced = if class.kind == LineKind::Crease {
            let excess = |edge: &ViewEdge| f64::from((edge.strength - FAINT_DEG) / (90.0 - FAINT_DEG));
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
    pub fn length(&self) -> f64 {
        let points = &self.line.points;
        let open: f64 = points.windows(2).map(|pair| length(pair[1] - pair[0])).sum();
        match (points.first(), points.last()) {
            (Some(first), Some(last)) if self.line.closed => open + length(*first - *last),
            _ => open,
        }
    }

    /// The part of it that has background behind it, 0 to 1.
    pub fn silhouette_part(&self) -> f64 {
        let sides = || self.line.points.windows(2).map(|pair| length(pair[1] - pair[0]));
        let silhouette = sides().zip(&self.line.silhouette).filter(|(_, is)| **is);
        silhouette.map(|(side, _)| side).sum::<f64>() / sides().sum::<f64>().max(f64::MIN_POSITIVE)
    }

    /// Whether it ends where it began.
    pub fn is_ring(&self) -> bool {
        self.line.closed || self.ends[0] == self.ends[1]
    }
}

/// How many visible pieces come together at each view vertex.
pub(crate) struct Degrees(Vec<u32>);

impl Degrees {
    pub fn new(map: &ViewMap, classes: &[Option<Class>]) -> Self {
        let mut degrees = vec![0; map.vertices.len()];
        for (edge, class) in map.edges.iter().zip(classes) {
            if class.is_some_and(|class| !class.hidden) {
                degrees[edge.start.index()] += 1;
                degrees[edge.end.index()] += 1;
            }
        }
        Self(degrees)
    }

    /// Whether nothing but one line ends here.
    pub fn is_free(&self, vertex: ViewVertexId) -> bool {
        self.0[vertex.index()] <= 1
    }

    /// Whether more than two lines end here, or a line passes through where another ends.
    pub fn is_junction(&self, vertex: ViewVertexId) -> bool {
        self.0[vertex.index()] > 2
    }

    /// Takes away a piece that ended here.
    pub fn cut_off(&mut self, vertex: ViewVertexId) {
        self.0[vertex.index()] = self.0[vertex.index()].saturating_sub(1);
    }

    /// Takes away a line that is left out.
    pub fn leave_out(&mut self, raw: &Raw) {
        raw.vertices.iter().for_each(|vertex| self.cut_off(*vertex));
    }
}
