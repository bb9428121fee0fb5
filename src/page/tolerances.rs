//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// Maximum rounding error of a coordinate that is transformed to world space in double precision, as a
/// fraction of the coordinate.
pub const MAX_ROUNDING_OF_COORDINATE: f64 = 8.0 * f64::EPSILON;

/// Maximum error of the centre and radius of a circle fitted to exact corners, as a fraction of the largest
/// coordinate.
pub const MAX_CIRCLE_FIT_OF_COORDINATE: f64 = 1e-12;
