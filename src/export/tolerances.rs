//! Tolerances of written files, each as a fraction of a named length or an angle.

/// Maximum deviation of a cubic from the control points of a circular arc, as a fraction of the radius.
/// Also the maximum deviation of a full circle's angle from a full turn, radians. It covers rounding in
/// double precision; cubics that are no arcs differ by more.
pub(crate) const MAX_ARC_FORM_ERROR: f64 = 1e-7;

/// Maximum difference between a full turn and the sum of the angles round a closed curve, radians. It
/// covers rounding of the sum: curves that go round more often differ by at least a full turn.
pub(crate) const MAX_TURN_ROUNDING_RAD: f64 = 1e-6;

/// Maximum difference between equal dash lengths, as a fraction of the length. It covers rounding when a
/// pattern is repeated along a line.
pub(crate) const MAX_DASH_DIFFERENCE_OF_LENGTH: f64 = 1e-6;
