//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// Borders that cross a grid row within this distance (grid steps) cross it at one point.
pub const CROSSING_MERGE_OF_STEP: f64 = 1e-6;

/// Maximum deviation (px) of a dot's outline from its circle and from the borders that clip it.
pub const MAX_DOT_OUTLINE_ERROR_PX: f64 = 0.01;

/// A clipped dot is dropped if its area is less than that of a square with this side (px).
pub const MIN_DOT_PIECE_PX: f64 = 0.1;

/// Shrinkage of a dot that a border is tangent to, as a fraction.
pub const DOT_SHRINK_OF_RADIUS: f64 = 1e-5;
