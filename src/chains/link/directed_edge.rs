//! [`DirectedEdge`]: an edge of the view map with the direction of a route along it.
//!
//! [`order`] sorts such edges by geometry, so that routes do not depend on the order of the view map.

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
    pub(crate) fn turned(self) -> Self {
        Self { reversed: !self.reversed, ..self }
    }

    /// View vertex where the route enters the edge.
    pub(crate) fn from(self, map: &ViewMap) -> ViewVertexId {
        let edge = &map.edges[self.edge as usize];
        if self.reversed { edge.end } else { edge.start }
    }

    /// View vertex where the route leaves the edge.
    pub(crate) fn to(self, map: &ViewMap) -> ViewVertexId {
        self.turned().from(map)
    }

    /// Distance between its ends in the image, user units.
    pub(crate) fn length(self, map: &ViewMap) -> f64 {
        let at = |v: ViewVertexId| map.vertices[v.index()].position;
        length(at(self.to(map)) - at(self.from(map)))
    }
}

/// Orders edges by start position, end position and segment number. Segment numbers depend on the other
/// lines of the drawing, so they only break ties.
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
