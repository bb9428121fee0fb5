//! Bounding volume hierarchies over triangles, for queries by box, by ray and by nearest point.
//!
//! Triangles are sorted along a Morton curve or split at the median, and each node holds a run of them.
//!
//! 1. `box_tree` lists pairs of triangles whose boxes overlap.
//! 2. `triangle_tree` tests single rays and finds nearest points; `rays` tests many parallel rays at once.
//! 3. `dual` finds the edges that may be contours for a camera (Claes et al. 2001).
//!
//! Files, in reading order: [`node_boxes`] (boxes of eight children), [`box_tree`] (8-wide tree),
//! [`triangle_tree`]. Folders: [`rays`], [`dual`].

pub(crate) mod box_tree;
pub(crate) mod dual;
pub(crate) mod node_boxes;
pub(crate) mod rays;
pub(crate) mod triangle_tree;

pub(crate) use dual::dual_boxes::DualCandidates;
pub(crate) use dual::dual_tree::DualTree;
pub use dual::dual_tree::ToneTree;
