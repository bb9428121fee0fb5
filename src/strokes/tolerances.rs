//! Tolerances of strokes, each as a fraction of a named quantity, in px of the page or in user units.

/// Flattening tolerance of a brush shape in measurements, as a fraction of its length or width.
pub(crate) const BRUSH_FLATNESS_OF_SIZE: f64 = 1e-3;

/// Minimum distance (px) between neighbouring points on the outline of a brushed shape. Closer points are one
/// point and have no direction.
pub(crate) const MIN_OUTLINE_STEP_PX: f64 = 1e-9;

/// Maximum error of curve lengths in a dash pattern, as a fraction of its period. Not visible in the dashes.
pub(crate) const MAX_LENGTH_ERROR_OF_PERIOD: f64 = 1e-3;

/// Maximum difference of widths that count as equal, as a fraction of the pen's width: above rounding, and
/// far below what is visible.
pub(crate) const MAX_WIDTH_DIFFERENCE_OF_PEN: f64 = 1e-6;

/// Minimum width and height of the grid of path ends, user units. Keeps its cells from being empty where all
/// ends lie on one line or point.
pub(crate) const MIN_GRID_EXTENT_UNITS: f64 = 1e-9;
