//! [`DirectedEdge`]: a view edge with a direction, and a total order of such steps that depends on geometry only.

use crate::geometry::plane::planar_distance::length;
use crate::visibility::{ViewMap, ViewVertexId};

/// Edge of a route, with its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct DirectedEdge {
    pub edge: u32,
    pub reversed: bool,
}

impl DirectedEdge {
    /// The same edge in the other direction.
    pub fn turned(self) -> Self {
        Self { reversed: !self.reversed, ..self }
    }

    pub fn from(self, map: &ViewMap) -> ViewVertexId {
        let edge = &map.edges[self.edge as usize];
        if self.reversed { edge.end } else { edge.start }
    }

    pub fn to(self, map: &ViewMap) -> ViewVertexId {
        self.turned().from(map)
    }

    /// Length in the image.
    pub fn length(self, map: &ViewMap) -> f64 {
        let at = |v: ViewVertexId| map.vertices[v.index()].position;
        length(at(self.to(map)) - at(self.from(map)))
    }
}

/// Orders steps by start, end and segment. Segments come last because their numbers depend on what else is
/// drawn.
pub(crate) fn order(map: &ViewMap, a: DirectedEdge, b: DirectedEdge) -> std::cmp::Ordering {
    let segment = |s: DirectedEdge| map.edges[s.edge as usize].segment;
    let at = |v: ViewVertexId| map.vertices[v.index()].position;
    let (p, q) = (at(a.from(map)), at(b.from(map)));
    let (r, s) = (at(a.to(map)), at(b.to(map)));
    (p.x.total_cmp(&q.x))
        .then(p.y.total_cmp(&q.y))
        .then(r.x.total_cmp(&s.x))
        .then(r.y.total_cmp(&s.y))
        .then(segment(a).cmp(&segment(b)))
}
