//! Tolerances of images on surfaces, each as a fraction of a named quantity, or in px of the page.

/// Minimum difference in nearness for one face to be in front of another, on a scale of 0 to 1 over the depth
/// of the view. Neighbours share the pixels along their sides and are equally near there, up to the rounding
/// of single precision.
pub(crate) const MIN_NEARNESS_GAP: f32 = 1e-5;

/// Maximum distance (px) of a corner from a line that it lies on. Smaller distances are not visible, and
/// would cut slivers off a facet.
pub(crate) const MAX_LINE_DISTANCE_PX: f64 = 1e-4;

/// Minimum determinant of the spread of points, as a fraction of the squared sum of its variances. Below it
/// the points are about a millionth as wide as long, and lie on a line within rounding.
pub(crate) const MIN_SPREAD_DETERMINANT_SHARE: f64 = 1e-12;
