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

pub mod box_tree;
pub mod dual;
pub mod nearest_tree;
mod packed_boxes;
pub(crate) mod quantized_box;
pub mod rays;

pub use dual::dual_boxes::DualCandidates;
pub use dual::dual_tree::{DualTree, ToneTree};
