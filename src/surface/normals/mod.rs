//! Normals of the smooth surface at each vertex, split at creases.
//!
//! 1. Vertex normals are weighted sums of face normals (Max 1999), or the normals of the file.
//! 2. At vertices on separating edges, each fan of faces gets its own smooth vertex and normal.
//! 3. Normals of the file that are means next to bevels are replaced before (`bevel_normals`).
//! 4. Long edges next to short ones, whose normals tilt only at bevels, are marked as straight.
//!
//! Files, in reading order: [`smooth_normals`] (the result), [`vertex_normals`] (step 1), [`normal_sum`]
//! (weights), [`file_normals`], [`vertex_split`] (step 2), [`bevel_normals`] (step 3),
//! [`straight_edges`] (step 4).

pub(crate) mod bevel_normals;
pub(crate) mod file_normals;
mod normal_sum;
pub(crate) mod smooth_normals;
pub(crate) mod straight_edges;
mod vertex_normals;
mod vertex_split;
