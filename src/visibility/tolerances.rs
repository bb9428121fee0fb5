//! Tolerances of this area, each as a fraction of a named quantity, in px of the page or in user units.
//!
//! `part` is the diagonal of the bounding box of the part in question, or of the larger part where two meet.

/// A surface within this depth of a line (px) touches the line. Smaller distances are not visible.
pub(crate) const CONTACT_PX: f64 = 5e-4;

/// Minimum length (px) of a hidden or visible span; shorter ones are rounding errors.
pub(crate) const MIN_VISIBILITY_SPAN_PX: f64 = 1e-4;

/// Distance (px) of the test for background from a contour.
pub(crate) const BACKGROUND_PROBE_PX: f64 = 1e-3;

/// Minimum depth difference (fraction of the part) for a surface to hide a line that shares a vertex with it.
/// Smaller differences are rounding errors.
pub(crate) const NEIGHBOUR_OF_PART: f64 = 1e-10;

/// Minimum depth difference (px) for a surface to hide a line that shares a vertex with it.
pub(crate) const NEIGHBOUR_PX: f64 = 1e-7;

/// A triangle lower than this in the image (px) is edge-on and covers nothing.
pub(crate) const MIN_IMAGE_HEIGHT_PX: f64 = 1e-8;

/// Two lines within this distance of each other (px) are drawn once.
pub(crate) const DUPLICATE_LINE_PX: f64 = 5e-3;

/// Minimum distance (px) within which a hidden line coincides with another one; lines with wider ink coincide
/// within the width of the ink.
///
/// Where the ink width is unknown, a larger value would merge long stretches of curves that only touch.
pub(crate) const BEHIND_INK_PX: f64 = 0.02;

/// Lines that cross at an angle with this sine or more do not coincide, however close they are.
pub(crate) const BEHIND_INK_SINE: f64 = 0.02;

/// Maximum length (px) of a contour that turns back in the image without a cusp.
pub(crate) const MIN_CUSP_PX: f64 = 1.0;

/// Two contours of a fold within this distance in the image (px) are drawn as one pen stroke. Their feet must
/// be within the base distance (px) in space.
pub(crate) const THIN_FOLD_PX: f64 = 0.4;

/// Longest base of a thin fold that is not drawn, px.
pub(crate) const THIN_FOLD_BASE_PX: f64 = 3.0;

/// Distance within which two lines with a common vertex coincide, as a fraction of that for other lines. The
/// two sides of a T-vertex are that close; the folds of a contour hardly ever are.
pub(crate) const JOINED_LINE_OF_DISTANCE: f64 = 1e-3;

/// Minimum length of a hidden or visible span within one tile, as a fraction of the minimum for the whole
/// segment. A span may continue in the next tile, so only rounding errors are absorbed before the tiles are
/// joined.
pub(crate) const TILE_SPAN_OF_SHORTEST: f64 = 1e-3;

/// Growth of a tile where triangles and lines are assigned to it, as a fraction of half its side. Exceeds
/// rounding, so nothing on the border of a tile is lost.
pub(crate) const TILE_MARGIN_OF_TILE: f64 = 1e-5;

/// Minimum margin of a triangle's bounding box in the search for its tiles, as a fraction of the tile's side.
/// Exceeds rounding of image coordinates.
pub(crate) const BOX_MARGIN_OF_TILE: f64 = 1e-6;

/// Margin of bounding boxes in the image, user units: slightly more than rounding, so lines on the border of
/// a triangle are still compared with it.
pub(crate) const BOX_MARGIN_UNITS: f64 = 1e-4;

/// Maximum visible part of a segment that counts as hidden from end to end, as a fraction of the segment: the
/// rounding error of the sum of its hidden parts.
pub(crate) const MAX_VISIBLE_OF_BURIED_SEGMENT: f64 = 1e-9;

/// Margin within which a face of a fused occluder may meet a square, as a fraction of the square's side.
/// Exceeds rounding, so no face is missed.
pub(crate) const FUSED_FACE_MARGIN_OF_SQUARE: f64 = 1e-4;

/// Margin within which a border edge of a fused occluder passes a square, as a fraction of the square's side.
/// More than twice [`FUSED_FACE_MARGIN_OF_SQUARE`], so no square on the border counts as covered.
pub(crate) const FUSED_BORDER_MARGIN_OF_SQUARE: f64 = 1e-2;

/// Bound for the rounding error of a nearness in single precision, as a fraction of the largest term: that of
/// a sum, its terms, a product and its factor, six times 2⁻²⁴ for values up to 1.
pub(crate) const NEARNESS_ROUNDING_SHARE: f64 = 5e-7;

/// Bound for the rounding error of a nearness near zero. Numbers of single precision below 1.2e-38 have fewer
/// digits, so their error is not a fraction of them.
pub(crate) const MIN_NEARNESS_MAGNITUDE: f64 = 1e-37;

/// Rounding error of the column where a side of a triangle crosses a row of tiles, in tiles.
pub(crate) const COLUMN_ROUNDING_TILES: f64 = 1e-6;

/// Margin of a face's bounding box at a query point, as a fraction of its coordinates: about a thousand times
/// the rounding error of the side test.
pub(crate) const FACE_BOX_OF_COORDINATE: f64 = 1e-12;
