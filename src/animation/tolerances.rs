//! Tolerances of animations.

/// Minimum length of a quaternion that is normalised to a rotation. Files round the components of unit
/// quaternions; a shorter one is zero, and its direction is rounding noise.
pub(crate) const MIN_QUATERNION_LENGTH: f64 = 1e-6;
