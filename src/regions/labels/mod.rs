//! Labels: part, material, paint, tone and hatching bin of every triangle of the page.
//!
//! 1. The face in front at each triangle's centre gives a label (`point_labels`).
//! 2. All triangles of a cell take the label that covers most of its area (`cell_labels`).
//! 3. Where a wide triangle disagrees, the cell's border has a gap: then each wide triangle keeps its own
//!    label.
//!
//! Files, in reading order: [`surface_label`] what a label holds; [`labelled_page`] the triangulated page
//! with its labels; [`point_labels`]; [`cell_labels`].

mod cell_labels;
pub(crate) mod labelled_page;
mod point_labels;
pub(crate) mod surface_label;
