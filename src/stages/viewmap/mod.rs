//! [`ViewMap`]: the planar graph of the projected feature lines, cut where visibility changes.

pub mod ahead;
pub mod build;
mod compared;
pub mod cover;
pub mod doubles;
mod expanse;
pub mod front;
pub mod graph;
pub mod grid;
pub mod image;
pub mod layers;
pub mod limits;
mod long_pairs;
mod longest_run;
mod near_tiles;
mod needles;
pub mod occlude;
pub mod occluders;
mod outer_side;
pub mod precedence;
pub mod project;
mod rounded;
mod runs;
mod sides;
mod slope;
mod teeth;
mod tile;
pub mod trails;
pub mod visibility;
mod witnesses;

pub use ahead::{Ahead, Way};
pub use build::{build, build_through};
pub use front::{Front, front_faces};
pub use graph::{ContourCounts, SeenContour, ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
pub use trails::{Beside, build_beside};
