//! Tolerances of frames and their times.

/// Minimum time of a frame in divisions, milliseconds. Keeps the number of faces finite; no frame is drawn
/// faster.
pub(crate) const MIN_FRAME_TIME_MS: f64 = 1e-3;

/// Maximum excess of a span over whole frames that is rounding of its times, in frames.
pub(crate) const MAX_SPAN_ROUNDING_FRAMES: f64 = 1e-6;
