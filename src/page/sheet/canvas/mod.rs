//! Marks of a sheet in mm, and the paper that they occupy.
//!
//! Files, in reading order:
//!
//! - `sheet_canvas`: lines, circles, arrows and words as marks.
//! - `paper_occupancy`: convex shapes with a margin in a grid; answers whether a new shape would touch one
//!   of them.
//! - `annotation_board`: the canvas of one view with its occupied paper and the annotations that found no
//!   place.

pub(crate) mod annotation_board;
pub(crate) mod paper_occupancy;
pub(crate) mod sheet_canvas;
