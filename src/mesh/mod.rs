//! [`Mesh`]: all that can be drawn, as one welded triangle mesh in world space.

pub mod ids;
pub mod soup;

pub use ids::{EdgeId, FaceId, MaterialId, PartId, VertexId};
pub use soup::{EdgeMark, Soup, Wire};
