//! Shortcuts of the visibility computation. They change its time, not its result.
//!
//! 1. An occlusion buffer stores a nearness limit for every small square of the image: everything farther is
//!    hidden (compare the hierarchical Z-buffer of Greene, Kass and Miller 1993). Single triangles and fused
//!    occluders fill it.
//! 2. Segments and triangles behind the buffer are not compared.
//! 3. Edge functions in single precision (Pineda 1988) reject most of the remaining pairs.
//! 4. Long segments and long triangles are compared once instead of in every tile.
//!
//! Files, in reading order: [`occlusion_buffer`]; [`occluder_fusion`] faces joined into large occluders;
//! [`back_faces`] the faces that fusion can skip; [`nearness_bound`] the stored values; [`view_occlusion`] a
//! buffer made before the lines are known; [`tile_occluders`], [`edge_functions`] the triangles of one tile;
//! [`long_pairs`], [`longest_interval`] long pairs; [`triangle_blocks`] lookup of the triangles over few
//! tiles.

mod back_faces;
mod edge_functions;
pub(crate) mod long_pairs;
pub(crate) mod longest_interval;
pub(crate) mod nearness_bound;
mod occluder_fusion;
pub(crate) mod occlusion_buffer;
pub(crate) mod tile_occluders;
pub(crate) mod triangle_blocks;
pub(crate) mod view_occlusion;
