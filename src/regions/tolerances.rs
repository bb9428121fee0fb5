//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// Maximum deviation (px) of step borders from straight lines across the gradient into which the steps are
/// merged.
pub const MAX_GRADIENT_BORDER_ERROR_PX: f64 = 0.35;

/// Simplification tolerance of borders that only hatching uses, px.
pub const BIN_SIMPLIFY_PX: f64 = 0.1;

/// Simplification tolerance of borders between gradient steps, px.
pub const GRADIENT_SIMPLIFY_PX: f64 = 0.2;

/// Steps of the snapping grid of regions along the longer side of the frame.
pub const REGION_GRID_STEPS: f64 = 1_048_576.0;

/// Border points within this distance (grid steps) of the line between their neighbours are rounding
/// artefacts.
pub const REGION_SNAP_STEPS: f64 = 1.5;

/// Minimum extent (px) of a label difference within a cell; smaller ones are rounding errors.
pub const MIN_LABEL_DIFFERENCE_PX: f64 = 1.2;

/// A border that ends within this distance (px) of another one is extended to it.
pub const MAX_BRIDGE_PX: f64 = 1.0;

/// Simplification tolerance of borders, px.
pub const BORDER_SIMPLIFY_PX: f64 = 0.01;
