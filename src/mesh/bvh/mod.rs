//! Bounding volume hierarchies over triangles, for queries by box, by ray and by nearest point.
//!
//! Triangles are sorted along a Morton curve or split at the median, and each node holds a run of them.
//!
//! 1. `box_tree` lists pairs of triangles whose boxes overlap, on quantized coordinates with packed
//!    comparisons (Lamport 1975).
//! 2. `rays` tests rays against triangles, one by one or many parallel rays at once.
//! 3. `dual` finds the edges that may be contours for a camera (Claes et al. 2001).
//!
//! Files, in reading order: [`box_tree`] (8-wide tree), [`packed_boxes`] (eight boxes in machine words),
//! [`quantized_box`] (box of one triangle), [`nearest_tree`] (closest point). Folders: [`rays`], [`dual`].

pub(crate) mod box_tree;
pub(crate) mod dual;
pub(crate) mod nearest_tree;
mod packed_boxes;
pub(crate) mod quantized_box;
pub(crate) mod rays;

pub(crate) use dual::dual_boxes::DualCandidates;
pub(crate) use dual::dual_tree::DualTree;
pub use dual::dual_tree::ToneTree;
