//! Axes: the centre lines of strokes as points about a px apart.
//!
//! 1. The path of a chain is sampled; corners and the chain's samples are carried over ([`path_samples`],
//!    [`stroke_axis`]).
//! 2. Ends where another chain continues in the same direction are found ([`joined_ends`]).
//! 3. The axis is cut at gaps and, if the pen is lifted there, at corners ([`axis_pieces`]).
//!
//! Files, in reading order: [`path_samples`]; [`stroke_axis`]; [`joined_ends`]; [`axis_pieces`].

pub(crate) mod axis_pieces;
pub(crate) mod joined_ends;
pub(crate) mod path_samples;
pub(crate) mod stroke_axis;
