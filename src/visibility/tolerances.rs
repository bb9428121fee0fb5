//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.
//!
//! `part` is the diagonal of the bounding box of the part in question, or of the larger part where two meet.

/// A surface within this depth of a line (px) touches the line. Smaller distances are not visible.
pub const CONTACT_PX: f64 = 5e-4;

/// Minimum length (px) of a hidden or visible span; shorter ones are rounding errors.
pub const MIN_VISIBILITY_SPAN_PX: f64 = 1e-4;

/// Distance (px) of the test for background from a contour.
pub const BACKGROUND_PROBE_PX: f64 = 1e-3;

/// Minimum depth difference (fraction of the part) for a surface to hide a line that shares a vertex with it.
/// Smaller differences are rounding errors.
pub const NEIGHBOUR_OF_PART: f64 = 1e-10;

/// Minimum depth difference (px) for a surface to hide a line that shares a vertex with it.
pub const NEIGHBOUR_PX: f64 = 1e-7;

/// A triangle lower than this in the image (px) is edge-on and covers nothing.
pub const MIN_IMAGE_HEIGHT_PX: f64 = 1e-8;

/// Two lines within this distance of each other (px) are drawn once.
pub const DUPLICATE_LINE_PX: f64 = 5e-3;

/// Minimum distance (px) within which a hidden line coincides with another one; lines with wider ink coincide
/// within the width of the ink.
///
/// Where the ink width is unknown, a larger value would merge long stretches of curves that only touch.
pub const BEHIND_INK_PX: f64 = 0.02;

/// Lines that cross at an angle with this sine or more do not coincide, however close they are.
pub const BEHIND_INK_SINE: f64 = 0.02;

/// Maximum length (px) of a contour that turns back in the image without a cusp.
pub const MIN_CUSP_PX: f64 = 1.0;

/// Two contours of a fold within this distance in the image (px) are drawn as one pen stroke. Their feet must
/// be within the base distance (px) in space.
pub const THIN_FOLD_PX: f64 = 0.4;

/// Longest base of a thin fold that is not drawn, px.
pub const THIN_FOLD_BASE_PX: f64 = 3.0;
