//! Tolerances of sections, exploded views and simplified scenes.

/// Rounding error of moving a model in double precision, as a fraction of the largest coordinate: a few units
/// in the last place.
pub(crate) const F64_ROUNDING_OF_COORDINATE: f64 = 1e-15;

/// Weight of the fourth power of the collapse distance, added to the cost. Keeps faces in flat regions well
/// shaped: it decides only where the error is nearly zero.
pub(crate) const LENGTH_COST_WEIGHT: f64 = 1e-10;

/// Maximum projected area, as a fraction of the full area, of a face that counts as parallel to the axis.
/// Covers the rounding of `f64`.
pub(crate) const MAX_UPRIGHT_AREA_RATIO: f64 = 1e-9;

/// Maximum gap between the directions that two triangles cover around a point, radians. Covers the rounding
/// of angles in `f64`.
pub(crate) const ANGLE_ROUNDING_RAD: f64 = 1e-9;

/// Maximum sine of the angle between directions that count as equal. Single-precision rounding turns the
/// faces of the test models by less.
pub(crate) const MAX_PARALLEL_SINE: f64 = 1e-3;

/// Distance within which surfaces touch, as a fraction of the model's diagonal. Covers coordinates in single
/// precision.
pub(crate) const TOUCH_DISTANCE_OF_DIAGONAL: f64 = 1e-5;
