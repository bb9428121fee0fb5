//! Tolerances of pages: lengths in mm of paper, shares of a named length, and cosines of angles.

// Coordinates of the model.

/// Maximum rounding error of a coordinate that is transformed to world space in double precision, as a
/// fraction of the coordinate.
pub(crate) const MAX_ROUNDING_OF_COORDINATE: f64 = 8.0 * f64::EPSILON;

/// Maximum error of the centre and radius of a circle fitted to exact corners, as a fraction of the largest
/// coordinate.
pub(crate) const MAX_CIRCLE_FIT_OF_COORDINATE: f64 = 1e-12;

/// Rounding error in double precision of a transformed corner and of the mean of all corners, as a fraction
/// of the largest coordinate.
///
/// It is added to the rounding of the file when the shapes of two parts are compared.
pub(crate) const CORNER_ROUNDING_OF_COORDINATE: f64 = 1e-12;

/// Maximum distance of two points from a line along an axis, as a fraction of their distance. Allows
/// for the `f64` rounding of the coordinates. The relative error of the length is half the square of this.
pub(crate) const MAX_OFF_AXIS_SHARE: f64 = 1e-9;

/// Positions on cylinders that differ by at most this fraction of the radius are equal. The same fraction of
/// the distance between holes bounds the differences between distances on a pitch circle.
///
/// Single precision rounds a coordinate by 6e-8 of its value. That stays below this limit up to 80,000 radii
/// from the origin.
pub(crate) const MAX_OFFSET_OF_RADIUS: f64 = 5e-3;

/// A surface in front of the rim of a cylinder by at most this fraction of the view's diagonal does not hide
/// it: about two pixels of the face buffer that the rim is tested with.
pub(crate) const MAX_RIM_DEPTH_OF_VIEW: f64 = 2e-3;

// Scales and written numbers.

/// Maximum relative error of a product of few factors in double precision. A value this close below a tie
/// counts as a tie.
pub(crate) const TIE_ROUNDING_SHARE: f64 = 8.0 * f64::EPSILON;

/// Maximum relative difference between scales that are equal, and between lengths on paper of a model unit.
///
/// Above the `f64` rounding of products of scales and units. Neighbouring scales that are tried differ by 6 %
/// or more.
pub(crate) const MAX_SCALE_DIFFERENCE_SHARE: f64 = 1e-9;

/// Maximum relative difference between the drawn and the shown scale of a view that is reused.
///
/// Only `f64` rounding: the line widths of a drawing belong to its exact scale.
pub(crate) const MAX_DRAWN_SCALE_DIFFERENCE_SHARE: f64 = 1e-12;

/// Minimum gain in the sum of the logarithms of all scales for an arrangement to count as larger. Above the
/// `f64` rounding of the sum, so the first of equal arrangements is taken.
pub(crate) const MIN_LOG_SCALE_GAIN: f64 = 1e-9;

// Directions.

/// Minimum cosine between parallel directions of a sheet, such as the axes of its views and the normals of
/// its planes.
///
/// Allows 0.003 degrees, far above the `f64` rounding of unit vectors.
pub(crate) const MIN_PARALLEL_COSINE: f64 = 1.0 - 1e-9;

/// Maximum cosine between the normal of a plane and the viewing direction for the plane to be edge-on.
/// Covers the `f64` rounding of unit vectors.
pub(crate) const MAX_EDGE_ON_COSINE: f64 = 1e-9;

/// Minimum cosine between the axis of a cylinder and the viewing direction for the cylinder to be seen
/// end-on.
///
/// Allows 0.08 degrees, because axes are fitted to rounded corners.
pub(crate) const MIN_END_ON_COSINE: f64 = 1.0 - 1e-6;

/// Maximum cosine between the axis of a cylinder and the viewing direction for the cylinder to be seen from
/// the side. Covers the rounding of the fitted axis.
pub(crate) const MAX_SIDE_ON_COSINE: f64 = 1e-6;

/// Minimum sine between the upward direction of a camera and the viewing direction. With a smaller one the
/// cross product of both does not define a horizontal axis.
pub(crate) const MIN_UPWARD_SINE: f64 = 1e-6;

/// A component of a unit vector on paper up to this value counts as 0: the vector is horizontal or vertical.
/// Covers the `f64` rounding of unit vectors, and keeps divisions by the component finite.
pub(crate) const MAX_ZERO_COMPONENT: f64 = 1e-9;

/// Minimum arc of a bent line of letters, radians. The middle of a flatter line would rise by less than
/// 1/8000 of its width; such a line is set straight, and its radius, width / arc, is not needed.
pub(crate) const MIN_LETTERING_ARC_RAD: f64 = 1e-3;

// Paper.

/// Positions on paper within this distance are equal, mm. Above the `f64` rounding of coordinates on paper
/// (below 1e-12 mm), and far below what a printer resolves.
pub(crate) const POSITION_ROUNDING_MM: f64 = 1e-6;

/// Lengths on paper that differ by at most this are equal, mm. Above the `f64` rounding of a sum of heights,
/// so that a text or row that fills its space exactly still fits.
pub(crate) const LENGTH_ROUNDING_MM: f64 = 1e-9;

/// Minimum gain of two leaders that exchange their slots, mm, unless they cross. Above the `f64` rounding of
/// a sum of lengths, so leaders of equal length are not exchanged back and forth.
pub(crate) const MIN_LEADER_GAIN_MM: f64 = 1e-9;

/// Minimum gain in area of a smaller table, mm². Above the `f64` rounding of the area, so the first of equal
/// tables is taken.
pub(crate) const MIN_AREA_GAIN_MM2: f64 = 1e-9;

/// Minimum distance from the middle of a balloon to the aim of its tail, mm. Keeps the direction of the tail
/// finite.
pub(crate) const MIN_AIM_DISTANCE_MM: f64 = 1e-9;

/// Twice the area of the triangle of a side of a polygon and a point outside it, mm², below which the point
/// counts as on the boundary. Covers the `f64` rounding of points on the boundary.
pub(crate) const MAX_OUTWARD_CROSS_PRODUCT_MM2: f64 = 1e-9;

/// Minimum area of a part within its panel for a balloon to point to it, mm². A smaller one is not visible
/// on paper.
pub(crate) const MIN_TARGET_AREA_MM2: f64 = 1e-3;

/// Overlaps of panels up to this area are ignored, and so is the area of a panel outside the printed area,
/// mm². Panels that share a side overlap by rounding.
pub(crate) const MAX_PANEL_OVERLAP_MM2: f64 = 1e-3;

/// Maximum deviation of a Bézier path from its circle, mm. Smaller deviations are not visible on paper.
pub(crate) const MAX_CIRCLE_ERROR_MM: f64 = 1e-3;

/// Maximum deviation of the circle that clips a detail view, mm. The circle adds little to the tolerance of
/// clipping, which is 0.01 mm.
pub(crate) const MAX_CLIP_CIRCLE_ERROR_MM: f64 = 1e-4;
