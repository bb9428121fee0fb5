//! [`ViewMap`]: the planar graph of the projected feature lines, cut where visibility changes.

pub mod graph;

pub use graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
