//! Square tiles over the image, where segments and triangles meet.
//!
//! 1. A grid of square tiles covers the bounding box of the segments. Denser meshes get smaller tiles.
//! 2. Each segment is traversed tile by tile (Amanatides and Woo 1987).
//! 3. Each triangle is scan-converted into the tiles it overlaps, row by row, with its sides as half planes.
//!
//! Files, in reading order: [`tile_grid`] the grid and its traversal; [`aligned_grid`] grids whose tiles keep
//! their place when lines change; [`triangle_columns`] the tiles of a row that a triangle covers.

pub(crate) mod aligned_grid;
pub(crate) mod tile_grid;
pub(crate) mod triangle_columns;
