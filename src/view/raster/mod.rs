//! Pixel buffers of a view. They propose candidates; exact geometry decides.
//!
//! 1. Every vertex is placed on a grid of pixels, with nearness scaled to 0..1.
//! 2. Triangles are rasterised; each pixel keeps the nearest face (Z-buffer).
//! 3. Normals and depths are interpolated per pixel where image-space edge detection needs them.
//!
//! Files, in reading order: [`pixel_grid`] coverage of triangles; [`depth_cell`] face and nearness in one
//! number; [`face_buffer`] the nearest face per pixel; [`row_bands`] triangles sorted by rows;
//! [`normal_depth_maps`] step 3; [`hairline_gaps`] gaps between faces closed in the maps; [`painter_order`]
//! faces from back to front; [`intersecting_candidates`] faces that may intersect visibly.

mod depth_cell;
pub(crate) mod face_buffer;
mod hairline_gaps;
pub(crate) mod intersecting_candidates;
pub(crate) mod normal_depth_maps;
pub(crate) mod painter_order;
pub(crate) mod pixel_grid;
mod row_bands;

pub use face_buffer::FaceBuffer;
pub(crate) use normal_depth_maps::{NO_FRONT, NormalDepthMaps};
pub use pixel_grid::PixelGrid;
pub(crate) use pixel_grid::PixelPoint;
