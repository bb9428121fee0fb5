//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// Line widths in two drawings within this difference (px) are equal; one may have been written with two
/// decimals.
pub const MAX_WIDTH_DIFFERENCE_PX: f64 = 5.1e-3;

/// Dash lengths within this difference (px) are equal.
pub const MAX_DASH_DIFFERENCE_PX: f64 = 5.1e-3;

/// Precision of two drawings in a comparison, as a fraction of the page's longer side: SVG readers keep
/// coordinates in single precision.
pub const SVG_PRECISION_OF_PAGE: f64 = 1e-6;

/// Maximum default tolerance (px) of a comparison, for drawings written with few decimals.
pub const MAX_DIFF_STEP_PX: f64 = 0.1;

/// Flattening tolerance of curves, as a fraction of the comparison tolerance.
pub const FLATTENING_OF_TOLERANCE: f64 = 0.1;

/// Minimum flattening tolerance, as a fraction of a curve's size. Readers keep no more digits.
pub const MIN_FLATTENING_OF_CURVE: f64 = 1e-7;

/// Line ends within this fraction of the tolerance are joined: they were one point before a line was split.
pub const MAX_JOIN_GAP_OF_TOLERANCE: f64 = 1.0;

/// Maximum offset (px) between the pictures of two marks that were written in different ways, unless the
/// tolerance is smaller.
pub const MAX_PICTURE_MATCH_PX: f64 = 0.25;

/// Minimum width (px) of differences that are searched in rendered pictures after geometry found none: twice
/// the second decimal, as most drawings are written. Renderers are not more precise.
pub const MIN_PICTURE_DIFFERENCE_PX: f64 = 0.02;

/// Maximum relative error of the distance between two lines.
pub const MAX_DISTANCE_ERROR_SHARE: f64 = 2e-3;
