//! [`ViewMap`]: the planar graph of the projected feature lines, cut where visibility changes.

pub mod build;
pub mod doubles;
pub mod graph;
pub mod grid;
mod grouped;
pub mod layers;
pub mod occlude;
pub mod occluders;
pub mod project;
mod tile;
pub mod visibility;

pub use build::build;
pub use graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
