//! Tolerances of written files, each as a fraction of a named length or an angle.

/// Maximum deviation of a cubic from the form that arcs are written in, as a fraction of the radius, and of
/// the angle of a full circle from a full turn, radians. Many roundings of double precision; other curves
/// differ by more.
pub(crate) const MAX_ARC_FORM_ERROR: f64 = 1e-7;

/// Maximum difference between a full turn and the sum of the angles round a closed curve, radians: rounding of
/// the sum. A curve that goes round another number of times differs by a full turn.
pub(crate) const MAX_TURN_ROUNDING_RAD: f64 = 1e-6;

/// Maximum difference between equal dash lengths, as a fraction of the length: rounding when a dash pattern is
/// repeated along a line.
pub(crate) const MAX_DASH_DIFFERENCE_OF_LENGTH: f64 = 1e-6;
