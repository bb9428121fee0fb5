//! Sentences that explain many findings at once.
//!
//! 1. [`motion`] fits a shift or a similarity to marks by trial and least squares, and scores it on both
//!    drawings.
//! 2. [`whole_motion`] tests whether one motion carries the whole drawing.
//! 3. [`moved_parts`] fits one motion per part of the model.
//! 4. [`camera_change`] detects another camera before the marks are compared: parts move off one affine map
//!    in many directions.
//! 5. [`cause_sentences`] groups the findings by these motions, by parts that came or went, and by colours
//!    and pens.

pub(crate) mod camera_change;
pub(crate) mod cause_sentences;
pub(crate) mod motion;
pub(crate) mod moved_parts;
pub(crate) mod whole_motion;
