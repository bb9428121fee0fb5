//! Sentences that explain many findings at once.
//!
//! 1. [`motion`] fits a shift or a similarity to marks by trial and least squares, and scores it on both
//!    drawings.
//! 2. [`whole_motion`] tests whether one motion carries the whole drawing.
//! 3. [`moved_parts`] decides which parts moved as a whole, by one motion per part. This counts only if neither
//!    the drawing (step 2) nor the camera (step 4) moved.
//! 4. [`camera_change`] detects another camera before the marks are compared: parts move off one affine map
//!    in many directions.
//! 5. [`cause_sentences`] groups the findings by these motions, by parts that came or went, and by colours
//!    and pens.

pub(crate) mod camera_change;
pub(crate) mod cause_sentences;
pub(crate) mod motion;
pub(crate) mod moved_parts;
pub(crate) mod whole_motion;
