//! Paint borders: lines between the colours of textures, vertices and materials, on faces and along edges.
//!
//! 1. Borders in a texture that was reduced to a few colours are mapped to the faces that show it
//!    (`face_borders`).
//! 2. Vertex colours are interpolated; borders lie where the nearest palette colour changes
//!    (`vertex_colour_borders`).
//! 3. Edges of the mesh are borders where paint, part or tone differ across them (`tone_edges`).
//! 4. A border is an artist line if its colours differ by more than a tolerance, and an isophote otherwise.
//!
//! Files, in reading order: [`colour_voronoi`] nearest palette colour inside a triangle;
//! [`vertex_colour_borders`]; [`face_borders`]; [`tone_edges`]; [`paint_lines`] adds all of them to the
//! feature lines.

mod colour_voronoi;
mod face_borders;
pub(crate) mod paint_lines;
pub(crate) mod tone_edges;
mod vertex_colour_borders;
