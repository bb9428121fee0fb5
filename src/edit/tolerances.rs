//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// Rounding error of moving a model in double precision, as a fraction of the largest coordinate: a few units
/// in the last place.
pub const F64_ROUNDING_OF_COORDINATE: f64 = 1e-15;
