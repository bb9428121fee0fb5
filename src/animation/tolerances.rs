//! Tolerances for reading animation tracks.

/// Minimum length of a quaternion that is normalised to a rotation. A shorter one stands for zero: its
/// direction is only the rounding of the file's components.
pub(crate) const MIN_QUATERNION_LENGTH: f64 = 1e-6;
