//! From a chain and its pen to the shapes that are painted.
//!
//! 1. Spans along the chain get their ink: the pen's, the material's, or the gap between two blacks
//!    ([`ink_spans`]).
//! 2. The axis is cut at gaps, extended, widened and moved ([`chain_ink`]), and cut where the ink changes
//!    ([`ink_pieces`]).
//! 3. Lines that leave the camera's frame are drawn past its border and cut there ([`frame_cut`]).
//!
//! Files, in reading order: [`stroke_shape`] the result; [`ink_spans`]; [`ink_pieces`]; [`frame_cut`];
//! [`chain_ink`].

pub(crate) mod chain_ink;
pub(crate) mod frame_cut;
mod ink_pieces;
pub(crate) mod ink_spans;
pub(crate) mod stroke_shape;
