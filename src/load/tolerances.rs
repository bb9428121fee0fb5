//! Tolerances of readers: of polygons and of the precision of coordinates.

/// Maximum sine of the angle between collinear points: a hundred times the error of single precision on a
/// straight side.
pub(crate) const MAX_COLLINEAR_SINE: f64 = 1e-5;

/// Maximum relative error of an `f32` written with nine digits: half a unit of the ninth digit.
pub(crate) const MAX_SINGLE_ERROR: f64 = 5.000_001e-9;

/// Numbers below this fraction of the largest are noise around zero and are not measured. Their digits would
/// belong to rounding errors, such as those of sines and cosines.
pub(crate) const MIN_VALUE_OF_LARGEST: f64 = 1e-6;
