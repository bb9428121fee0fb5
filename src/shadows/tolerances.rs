//! Tolerances of shadows, each as a fraction of a named quantity.

/// Maximum cosine between a face's normal and the ray of light for which points on the face are interpolated.
/// At such a grazing angle, the intersection of ray and plane would enlarge rounding errors by ten million or
/// more.
pub(crate) const MAX_GRAZING_COSINE: f64 = 1e-7;
