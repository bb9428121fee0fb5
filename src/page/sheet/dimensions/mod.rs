//! The dimensions of a sheet: lengths, diameters and radii, each with its view and its text.
//!
//! 1. `dimension_set` holds the dimensions of all views, and adds the overall size and the positions of
//!    holes.
//! 2. `hole_dimensions` finds the whole cylinders that a view sees along their axes.
//! 3. `requested_dimensions` adds the dimensions that the page file names, between points and parts.
//!
//! Texts are made here: a number from `lengths` with ⌀, R or a count, or the text of the page file.
//! `annotations` finds the place of each dimension on the paper.

pub(crate) mod dimension_set;
pub(crate) mod hole_dimensions;
pub(crate) mod requested_dimensions;
