//! Tolerances of chains, each as a fraction of a named quantity, in radians or in user units.

/// Maximum distance of a collinear point from the line between its neighbours, user units. Above rounding,
/// and far below what is visible.
pub(crate) const MAX_COLLINEAR_DISTANCE_UNITS: f64 = 1e-9;

/// Minimum determinant of the equations for the two handles of a Bézier curve, as a fraction of the product
/// of their diagonal. Below it the equations do not determine both handles.
pub(crate) const MIN_DETERMINANT_SHARE: f64 = 1e-12;

/// Minimum parameter range of a piece of a path segment (0 to 1). Shorter pieces are rounding errors of a cut
/// at the end of a segment.
pub(crate) const MIN_PIECE_OF_SEGMENT: f64 = 1e-9;

/// Rounding error of a number of cubics. A turn that exceeds a whole number of them by less gets no further
/// one.
pub(crate) const ARC_COUNT_ROUNDING: f64 = 1e-9;

/// Rounding error of turning angles along a polyline, radians.
pub(crate) const TURN_ROUNDING_RAD: f64 = 1e-6;
