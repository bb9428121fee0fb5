//! Tolerances of motion lines.

/// Segments of a motion line per second that are accepted: from one in a quarter of an hour to ten per
/// millisecond.
pub(crate) const SEGMENT_RATES_PER_S: std::ops::RangeInclusive<f64> = 1e-3..=1e4;
