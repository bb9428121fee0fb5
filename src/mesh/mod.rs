//! [`Mesh`]: all that can be drawn, as one welded triangle mesh in world space.

pub mod boxes;
pub mod ids;
pub mod intersect;
pub mod soup;
pub mod triangle_pair;

pub use ids::{EdgeId, FaceId, MaterialId, PartId, VertexId};
pub use soup::{EdgeMark, Soup, Wire};
