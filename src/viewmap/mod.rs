//! [`ViewMap`]: the planar graph of the projected feature lines, cut where visibility changes.

pub mod arcs;
pub mod build;
pub mod cover;
pub mod doubles;
pub mod events;
pub mod front;
pub mod graph;
pub mod grid;
pub(crate) mod grouped;
pub mod layers;
pub mod occlude;
pub mod occluders;
pub mod overruled;
pub mod places;
pub mod project;
mod rounded;
mod tile;
pub mod visibility;

pub use build::build;
pub use front::{Front, front_faces};
pub use graph::{ArcCounts, ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
pub use overruled::{Overruled, overruled};
pub use places::{Place, places};
