//! Tolerances of the command line: ranges of options, and rounding of times and numbers in messages.

use std::ops::RangeInclusive;

/// Linear tolerances of STEP files that are accepted, mm: from a tenth of a micrometre, finer than any
/// machining, to a metre.
pub(crate) const STEP_TOLERANCES_MM: RangeInclusive<f64> = 1e-4..=1e3;

/// Maximum excess of a film over the time of its animation, seconds. It covers the rounding of times
/// that are multiples of a frame.
pub(crate) const TIME_ROUNDING_S: f64 = 1e-9;

/// Minimum duration that a number of drawings is divided by, seconds. Keeps the rate finite.
pub(crate) const MIN_DURATION_S: f64 = 1e-9;

/// A model whose size exceeds the height of the frame by at most this fraction fits: rounding of the camera's
/// position and of the scale.
pub(crate) const FRAME_ROUNDING_OF_HEIGHT: f64 = 1e-9;

/// Smaller numbers than this are written with an exponent in messages, because decimals would be mostly zeros.
pub(crate) const MIN_DECIMAL_NUMBER: f64 = 1e-4;
