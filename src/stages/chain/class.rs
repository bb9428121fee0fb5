//! [`Class`]: what must be equal of view edges that join into one line.

use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};
use crate::shape::Origin;
use crate::viewmap::ViewEdge;

/// Edges of equal class may join into one chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Class {
    pub kind: LineKind,
    pub part: PartId,
    pub material: MaterialId,
    pub hidden: bool,
    pub silhouette: bool,
    pub both_seen: bool,
    pub origin: Origin,
}

impl Class {
    /// The class of an edge as the view map has it. Hidden pieces of any invisibility are one class.
    pub fn of(edge: &ViewEdge) -> Self {
        Self {
            kind: edge.kind,
            part: edge.part,
            material: edge.material,
            hidden: edge.invisibility > 0,
            silhouette: edge.silhouette,
            both_seen: edge.both_seen,
            origin: edge.origin,
        }
    }

    /// The class without what may change along one line of the surface.
    pub fn of_source(edge: &ViewEdge) -> Self {
        Self { hidden: false, silhouette: false, both_seen: false, ..Self::of(edge) }
    }
}
