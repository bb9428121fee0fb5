//! Shortcuts of the visibility computation. They change its time, not its result.
//!
//! 1. An occlusion buffer stores a nearness limit for every small square of the image: everything farther is
//!    hidden (compare the hierarchical Z-buffer of Greene, Kass and Miller 1993). Single triangles and fused
//!    occluders fill it.
//! 2. Segments and triangles behind the buffer are not compared.
//!
//! Files, in reading order: [`occlusion_buffer`]; [`occluder_fusion`] faces joined into large occluders;
//! [`nearness_bound`] the stored values; [`view_occlusion`] a buffer made before the lines are known;
//! [`longest_interval`] the hidden part of a line.

pub(crate) mod longest_interval;
pub(crate) mod nearness_bound;
mod occluder_fusion;
pub(crate) mod occlusion_buffer;
pub(crate) mod view_occlusion;
