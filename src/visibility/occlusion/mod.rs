//! The parts of a segment that triangles hide, as intervals of its parameter.
//!
//! 1. In image space the segment is straight and the triangle planar, so the hidden part is one interval with
//!    computed ends.
//! 2. The intervals of all triangles are merged by a sweep, with or without a count of the layers in front.
//! 3. Lines shifted slightly to the open sides of a segment show where it has background next to it.
//!
//! Source: Appel 1967 (quantitative invisibility); interval subtraction as in Blender Line Art and
//! three-edge-projection.
//! Files, in reading order: [`triangle_occlusion`] one triangle against one segment; [`interval_sweep`] union
//! and layer counts; [`tiled_triangles`] the triangles that overlap each tile; [`outer_sides`] background
//! next to a segment; [`occlusion_input`] the data shared by all tiles.

pub(crate) mod interval_sweep;
pub(crate) mod occlusion_input;
pub(crate) mod outer_sides;
pub(crate) mod tiled_triangles;
pub(crate) mod triangle_occlusion;
