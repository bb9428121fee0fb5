//! Gaps in strokes: dashes, hand-drawn gaps and halos.
//!
//! 1. Dash patterns are stretched so that every end and corner lies on a dash ([`dash`]; ISO 128-2).
//! 2. Hand-drawn gaps are spread at random along the line, or from a fixed origin on the model
//!    ([`hand_gaps`], [`gap_origin`]).
//! 3. A farther line is interrupted where a nearer one passes over it ([`halo`]; Appel, Rohlf and Stein
//!    1979).
//!
//! Files, in reading order: [`dash`]; [`hand_gaps`]; [`gap_origin`]; [`halo`].

pub(crate) mod dash;
pub(crate) mod gap_origin;
pub(crate) mod halo;
pub(crate) mod hand_gaps;
