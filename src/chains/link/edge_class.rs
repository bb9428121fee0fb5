//! [`Class`]: what must be equal of view edges that join into one line.

use crate::lines::LineKind;
use crate::mesh::components::bodies::body_of;
use crate::mesh::{MaterialId, PartId};
use crate::surface::Origin;
use crate::visibility::{ViewEdge, ViewMap};

/// Edges of equal class may join into one chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Class {
    pub kind: LineKind,
    /// The first part of the body: a line goes on from part to part of one surface.
    pub body: PartId,
    pub material: MaterialId,
    pub hidden: bool,
    pub silhouette: bool,
    pub both_seen: bool,
    pub origin: Origin,
}

impl Class {
    /// The class of an edge as the view map has it. Hidden pieces of any invisibility are one class.
    pub fn of(map: &ViewMap, edge: &ViewEdge) -> Self {
        Self {
            kind: edge.kind,
            body: body_of(&map.bodies, edge.part),
            material: edge.material,
            hidden: edge.invisibility > 0,
            silhouette: edge.silhouette,
            both_seen: edge.both_seen,
            origin: edge.origin,
        }
    }

    /// The class without what may change along one line of the surface.
    pub fn of_source(map: &ViewMap, edge: &ViewEdge) -> Self {
        Self { hidden: false, silhouette: false, both_seen: false, ..Self::of(map, edge) }
    }
}
