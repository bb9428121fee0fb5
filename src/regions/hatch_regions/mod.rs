//! Hatch regions: areas of the page for hatching, and the border pieces where strokes end.
//!
//! 1. Triangles of one label form cells; cells that only light and shade separate form a facet.
//! 2. Each side of a triangle between two cells is a border piece that stores the cells on both its sides.
//! 3. Queries find where a segment crosses border pieces; `hatching::clip` cuts strokes there. No polygon is
//!    built.
//!
//! Files, in reading order: [`border_piece`]; [`hatch_map`] cells, facets and queries; [`piece_tiles`] border
//! pieces by the tiles of the page they pass.

pub(crate) mod border_piece;
pub(crate) mod hatch_map;
mod piece_tiles;
