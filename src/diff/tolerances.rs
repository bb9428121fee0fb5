//! Tolerances of comparisons, each as a fraction of a named length or angle, or in px of the page.

/// Line widths in two drawings within this difference (px) are equal; one may have been written with two
/// decimals.
pub(crate) const MAX_WIDTH_DIFFERENCE_PX: f64 = 5.1e-3;

/// Dash lengths within this difference (px) are equal.
pub(crate) const MAX_DASH_DIFFERENCE_PX: f64 = 5.1e-3;

/// Precision of two drawings in a comparison, as a fraction of the page's longer side: SVG readers keep
/// coordinates in single precision.
pub(crate) const SVG_PRECISION_OF_PAGE: f64 = 1e-6;

/// Maximum default tolerance (px) of a comparison, for drawings written with few decimals.
pub(crate) const MAX_DIFF_STEP_PX: f64 = 0.1;

/// Flattening tolerance of curves, as a fraction of the comparison tolerance.
pub(crate) const FLATTENING_OF_TOLERANCE: f64 = 0.1;

/// Minimum flattening tolerance, as a fraction of a curve's size. Readers keep no more digits.
pub(crate) const MIN_FLATTENING_OF_CURVE: f64 = 1e-7;

/// Line ends within this fraction of the tolerance are joined: they were one point before a line was split.
pub(crate) const MAX_JOIN_GAP_OF_TOLERANCE: f64 = 1.0;

/// Maximum offset (px) between the pictures of two marks that were written in different ways, unless the
/// tolerance is smaller.
pub(crate) const MAX_PICTURE_MATCH_PX: f64 = 0.25;

/// Minimum width (px) of differences that are searched in rendered pictures after geometry found none: twice
/// the second decimal, as most drawings are written. Renderers are not more precise.
pub(crate) const MIN_PICTURE_DIFFERENCE_PX: f64 = 0.02;

/// Maximum relative error of the distance between two lines.
pub(crate) const MAX_DISTANCE_ERROR_SHARE: f64 = 2e-3;

/// Distances between two lines are not refined further than this (px): the last decimal of a JSON report.
pub(crate) const DISTANCE_RESOLUTION_PX: f64 = 1e-4;

/// Minimum of a tolerance that the user sets (px), unless the default tolerance is smaller. A tolerance of zero
/// would report rounding errors.
pub(crate) const MIN_SET_TOLERANCE_PX: f64 = 1e-3;

/// Uncovered gaps between two intervals of a line that are no longer than this (px) are rounding errors: the
/// ends of intervals are roots of quadratics.
pub(crate) const MIN_UNCOVERED_GAP_PX: f64 = 1e-7;

/// Enlargement of the distance to a cluster of segments, as a fraction: many roundings of double precision, so
/// that a cluster is never skipped whose segments are within reach.
pub(crate) const CLUSTER_MARGIN_SHARE: f64 = 1e-9;

/// A segment that rises by at most this fraction of a grid cell is treated as level, because its slope is
/// uncertain.
pub(crate) const MAX_LEVEL_RISE_OF_CELL: f64 = 1e-9;

/// Enlargement of the columns that a segment crosses in a grid row, as a fraction of a cell: rounding of its
/// slope.
pub(crate) const COLUMN_MARGIN_OF_CELL: f64 = 1e-6;

/// Maximum offset of congruent closed lines after a shift, and maximum difference of their lengths, as a
/// fraction of the length. Added to multiples of the tolerance, because the differences of many rounded points
/// add up along a long line.
pub(crate) const MAX_CONGRUENT_OFFSET_OF_LENGTH: f64 = 1e-3;

/// Maximum error of the length of a curve (px): the last decimal of a text report.
pub(crate) const MAX_LENGTH_ERROR_PX: f64 = 1e-3;

/// Maximum error of the length of a curve (px), where a length is only compared with half of another one.
pub(crate) const MAX_COMPARED_LENGTH_ERROR_PX: f64 = 1e-2;

/// Maximum offset of lines in a drawing that was drawn again in another size, as a fraction of the page's
/// longer side. Lines are smoothed again in that size: half a pixel of a page 1000 px wide.
pub(crate) const MAX_REDRAW_OFFSET_OF_PAGE: f64 = 5e-4;

/// A motion of the whole drawing is a shift if it scales by less than this: a thousandth of a pixel on a page
/// of 1000 px.
pub(crate) const MAX_SHIFT_GROWTH_SHARE: f64 = 1e-6;

/// A motion of the whole drawing is a shift if it rotates by less than this, degrees: two thousandths of a
/// pixel on a page of 1000 px.
pub(crate) const MAX_SHIFT_TURN_DEG: f64 = 1e-4;

/// Minimum growth or shrinkage of a part that a sentence mentions, as a fraction. The factor is printed with
/// three decimals; closer to 1 it says little.
pub(crate) const MIN_STATED_GROWTH_SHARE: f64 = 4e-3;

/// Scale factors of motions that are scored. More extreme ones come from marks that do not correspond.
pub(crate) const MOTION_SCALES: std::ops::Range<f64> = 1e-3..1e3;

/// Minimum gain for a later motion to replace an earlier one, as a share of the sample points. One point is a
/// greater share, so this only decides between equal scores.
pub(crate) const MIN_SCORE_GAIN_SHARE: f64 = 1e-9;

/// Minimum sum of squared distances from the mean (px²) for the fit of a rotation and a scale to points.
/// Points within a thousandth of a pixel are one point, which has no direction.
pub(crate) const MIN_POINT_SPREAD_PX2: f64 = 1e-6;

/// Minimum determinant of the covariance of points for the fit of an affine map, as a fraction of the
/// product of their variances. Points with a smaller one are collinear except for rounding.
pub(crate) const MIN_SPREAD_DETERMINANT_SHARE: f64 = 1e-9;

/// Minimum divisor (px) where a tolerance or a dash pattern may be zero. Keeps the quotient finite.
pub(crate) const MIN_DIVISOR_PX: f64 = 1e-9;
