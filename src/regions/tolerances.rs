//! Tolerances of this area, each as a fraction of a named quantity, or in px of the page.

/// Maximum deviation (px) of step borders from straight lines across the gradient into which the steps are
/// merged.
pub(crate) const MAX_GRADIENT_BORDER_ERROR_PX: f64 = 0.35;

/// Simplification tolerance of borders that only hatching uses, px.
pub(crate) const BIN_SIMPLIFY_PX: f64 = 0.1;

/// Simplification tolerance of borders between gradient steps, px.
pub(crate) const GRADIENT_SIMPLIFY_PX: f64 = 0.2;

/// Steps of the snapping grid of regions along the longer side of the frame.
pub(crate) const REGION_GRID_STEPS: f64 = 1_048_576.0;

/// Border points within this distance (grid steps) of the line between their neighbours are rounding
/// artefacts.
pub(crate) const REGION_SNAP_STEPS: f64 = 1.5;

/// Minimum extent (px) of a label difference within a cell; smaller ones are rounding errors.
pub(crate) const MIN_LABEL_DIFFERENCE_PX: f64 = 1.2;

/// A border that ends within this distance (px) of another one is extended to it.
pub(crate) const MAX_BRIDGE_PX: f64 = 1.0;

/// Simplification tolerance of borders, px.
pub(crate) const BORDER_SIMPLIFY_PX: f64 = 0.01;

/// Maximum difference between the unit normals of neighbouring lattice points on a flat face: an angle of
/// 0.06 degrees.
pub(crate) const MAX_NEIGHBOUR_NORMAL_DISTANCE: f64 = 1e-3;

/// Weight added to that of each sample, so that the sum of weights is never zero.
pub(crate) const MIN_SAMPLE_WEIGHT: f64 = 1e-6;

/// Step length (px) for projecting directions to the page: short enough for a step along the surface to be
/// straight, and long enough to keep its digits in the difference.
pub(crate) const PROJECTION_STEP_PX: f64 = 1e-2;

/// Maximum squared sine of the angle between two steps on a surface that have one direction: the rounding of
/// double precision. No curvature follows from such steps.
pub(crate) const MIN_STEP_SINE_SQUARED: f64 = f64::EPSILON;

/// Largest distance outside a face, in barycentric weight, of a point that counts as on it. Allows for
/// rounding on the side between two faces.
pub(crate) const MAX_OUTSIDE_WEIGHT: f64 = 1e-9;

/// Largest distance in the plane of a chart between corners that count as one. Two faces that agree on both
/// common corners continue each other.
pub(crate) const MAX_CHART_CORNER_DISTANCE: f64 = 1e-5;
