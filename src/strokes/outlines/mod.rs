//! Outlines of strokes whose width varies, and the tremor that moves their axes.
//!
//! 1. [`tremor`] moves the points of an axis by smooth noise.
//! 2. The axis is offset by half the width to both sides; points inside the stroke's own ink are removed
//!    ([`offset_side`]).
//! 3. Curves are fitted to both sides and joined by the caps ([`stroke_outline`]).
//!
//! Files, in reading order: [`tremor`]; [`offset_side`]; [`stroke_outline`].

mod offset_side;
pub(crate) mod stroke_outline;
pub(crate) mod tremor;
