//! Edges of a mesh and the faces that meet at each of them.
//!
//! 1. Vertices are divided into blocks, one task each, with the faces that touch each block.
//! 2. A counting sort by smaller vertex lists the edges of a block; equal edges collect their faces.
//! 3. After faces are removed, changed or added, the edge table is updated instead of rebuilt.
//!
//! The result does not depend on the number of threads.
//!
//! Files, in reading order: [`edge_table`] (`Edges`, `EdgeFaces`), [`vertex_ranges`] (step 1),
//! [`edge_update`] (step 3), [`vertex_edges`] (edge between two vertices), [`edge_set`] (bit set of edges),
//! [`triangle_sides`].

pub(crate) mod edge_set;
pub(crate) mod edge_table;
mod edge_update;
pub(crate) mod triangle_sides;
pub(crate) mod vertex_edges;
pub(crate) mod vertex_ranges;
