//! [`EdgeClass`]: the properties that view edges must share to be joined into one chain.

use crate::lines::LineKind;
use crate::mesh::components::bodies::body_of;
use crate::mesh::{MaterialId, PartId};
use crate::surface::MeshSource;
use crate::visibility::{ViewEdge, ViewMap};

/// Class of a view edge. Only edges of equal class are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct EdgeClass {
    pub kind: LineKind,
    /// First part of the body. A line may continue from part to part of one surface.
    pub body: PartId,
    pub material: MaterialId,
    pub hidden: bool,
    pub silhouette: bool,
    pub both_seen: bool,
    pub origin: MeshSource,
}

impl EdgeClass {
    /// Class of an edge in the view map. All hidden edges are equal in this respect, for any invisibility
    /// above 0.
    pub(crate) fn of(map: &ViewMap, edge: &ViewEdge) -> Self {
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

    /// Class without the properties that may change along one line of the surface.
    pub(crate) fn of_source(map: &ViewMap, edge: &ViewEdge) -> Self {
        Self { hidden: false, silhouette: false, both_seen: false, ..Self::of(map, edge) }
    }
}
