//! Every epsilon of the crate, each as a fraction of a named length or angle.
//!
//! `part` is the diagonal of the bounding box of the part in question, or of the larger part where two meet
//! (see `mesh::part_metrics`). A 3 mm gear and a cathedral are therefore treated
//! alike, and other parts of the model have no influence. Lengths in px of things in space are measured at
//! their depth.

/// Vertices on open edges within this fraction of the part are welded.
pub const WELD_OF_PART: f64 = 1e-8;

/// Additional weld distance for single-precision files, as a fraction of the part's largest coordinate: 1.5
/// units in the last place of an `f32`.
pub const WELD_OF_F32_COORDINATE: f64 = 1.5 / 8_388_608.0;

/// Maximum distance between neighbouring `f32` numbers, as a fraction of the number.
pub const F32_STEP: f64 = 1.0 / 8_388_608.0;

/// Maximum rounding error of a coordinate that is transformed to world space in double precision, as a
/// fraction of the coordinate.
pub const MAX_ROUNDING_OF_COORDINATE: f64 = 8.0 * f64::EPSILON;

/// Maximum error of the centre and radius of a circle fitted to exact corners, as a fraction of the largest
/// coordinate.
pub const MAX_CIRCLE_FIT_OF_COORDINATE: f64 = 1e-12;

/// Maximum distance of a corner from its tessellated circle, in steps of the file's coordinates.
///
/// Half the diagonal of a cell for rounding, and the same again because the exporting program computed with
/// rounded numbers.
pub const MAX_CIRCLE_CORNER_STEPS: f64 = 1.5;

/// Maximum step of rounded coordinates, as a fraction of the model's size.
///
/// Coordinates with a coarser step are exact short numbers: rounding to such a step would be visible (a tenth
/// of a pixel at a width of 1000 px).
pub const MAX_ROUNDED_STEP_OF_SIZE: f64 = 1e-4;

/// Maximum displacement of a vertex when it is rounded to a lattice, in lattice steps: half the diagonal of a
/// cell, plus a margin for errors of the exporting program.
pub const MAX_LATTICE_ROUNDING_STEPS: f64 = 0.9;

/// Maximum displacement of a vertex by single precision, in steps at its largest coordinate.
///
/// Twice half the diagonal of a cell: exporters that write single precision also compute with it, and node
/// matrices are rounded as well.
pub const MAX_F32_ROUNDING_STEPS: f64 = 1.75;

/// Rounding error of moving a model in double precision, as a fraction of the largest coordinate: a few units
/// in the last place.
pub const F64_ROUNDING_OF_COORDINATE: f64 = 1e-15;

/// Maximum gap between the two sides of a seam (open edges), as a fraction of the part: a tenth of a pixel if
/// the part is 1000 px wide.
pub const MAX_SEAM_GAP_OF_PART: f64 = 1e-4;

/// Maximum step of coordinates, as a fraction of the model, before a warning. Equal to [`MAX_SEAM_GAP_OF_PART`].
pub const MAX_COORDINATE_STEP_OF_MODEL: f64 = 1e-4;

/// A triangle lower than this fraction of the part is degenerate: it hides nothing and has no usable normal.
pub const DEGENERATE_HEIGHT_OF_PART: f64 = 1e-12;

/// Sine of the maximum uncertainty of a face normal. A less certain face takes the normal of a wider face in
/// its plane. One degree: smaller errors change neither creases nor tones.
pub const MAX_NORMAL_ERROR_SINE: f64 = 0.0175;

/// Error of angles between faces because normals are stored in single precision, in degrees. At 15 degrees
/// this is four times the rounding of two normals.
pub const DIHEDRAL_ROUNDING_DEG: f64 = 1e-4;

/// A vertex within this distance of a triangle's plane (fraction of the part) is in the plane, in
/// intersection tests of surfaces.
pub const PLANE_OF_PART: f64 = 1e-12;

/// Two triangles whose intersection is no longer than this fraction of the part only touch.
pub const OVERLAP_OF_PART: f64 = 1e-9;

/// Two triangles whose intersection is no longer than this multiple of a vertex's rounding error only touch.
pub const OVERLAP_OF_ROUNDING: f64 = 4.0;

/// Surfaces that turn by this many degrees or more between facets are not round there. Equal to the default
/// crease limit.
pub const MAX_FACET_DEG: f64 = 40.0;

/// Minimum share of the length of an intersection curve that must be contact of round surfaces for the whole
/// curve to count as contact.
pub const MIN_CONTACT_OF_CURVE: f64 = 0.9;

/// Planes at an angle with this sine or less are parallel and have no common line.
pub const PARALLEL_SINE: f64 = 1e-9;

/// A face within this sine of the view direction is edge-on and counts as averted.
///
/// A face as wide as a picture of 1000 px is then narrower than 0.003 px. Errors of single-precision cameras
/// are smaller.
pub const EDGE_ON_SINE: f64 = 3e-6;

/// Minimum cosine between a normal and the view direction in divisions.
pub const MIN_FACING_COSINE: f64 = 1e-10;

/// A plane may be edge-on if its distance from the eye is at most this fraction of their maximum distance:
/// twice [`EDGE_ON_SINE`], to allow for rounding.
pub const EDGE_ON_PLANE_OF_REACH: f64 = 2.0 * EDGE_ON_SINE;

/// A file's polygon that turns by more than this (degrees) at a diagonal is folded there and may have a
/// crease; otherwise it is a curved surface. Equal to the default of `lines.crease_deg`.
pub const FOLDED_POLYGON_DEG: f64 = 40.0;

/// A surface within this depth of a line (fraction of its part) touches the line and does not hide it.
pub const CONTACT_OF_PART: f64 = 5e-7;

/// A surface within this depth of a line (px) touches the line. Smaller distances are not visible.
pub const CONTACT_PX: f64 = 5e-4;

/// A point within this distance of a projected triangle's border (px) is inside, so a line exactly behind an
/// edge is hidden by the faces of that edge.
pub const TRIANGLE_BORDER_PX: f64 = 1e-7;

/// Minimum length (px) of a hidden or visible span; shorter ones are rounding errors.
pub const MIN_VISIBILITY_SPAN_PX: f64 = 1e-4;

/// Distance of the near plane of a perspective view, as a fraction of the distance from eye to target.
pub const CLIP_PLANE_OF_TARGET: f64 = 1e-5;

/// Distance (px) of the test for background from a contour.
pub const BACKGROUND_PROBE_PX: f64 = 1e-3;

/// Distance (px) of the test for background from the contour of a rounded surface; larger than the deviation
/// of its faces.
pub const ROUNDED_BACKGROUND_PROBE_PX: f64 = 1.0;

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

/// Minimum distance of a zero-set crossing from the ends of a mesh edge, as a fraction of the edge. Prevents
/// pieces of zero length.
pub const ZERO_SET_OF_EDGE: f64 = 1e-6;

/// An edge of a rounded surface is split if its arc deviates from it by more than this (px).
pub const MAX_ARC_ERROR_PX: f64 = 0.08;

/// Edges up to this length (px, seen face-on) are never split; lines across them are already smooth.
pub const MIN_SPLIT_EDGE_PX: f64 = 2.5;

/// Maximum length (px) of a contour that turns back in the image without a cusp.
pub const MIN_CUSP_PX: f64 = 1.0;

/// Two contours of a fold within this distance in the image (px) are drawn as one pen stroke. Their feet must
/// be within the base distance (px) in space.
pub const THIN_FOLD_PX: f64 = 0.4;
pub const THIN_FOLD_BASE_PX: f64 = 3.0;

/// Minimum of the thresholds for lines inside the outline. Thresholds are dimensionless, scaled by the
/// feature size.
pub const MIN_LINE_THRESHOLD: f64 = 1e-9;

/// Faces are split until a tone border deviates by at most this (px) from its exact position.
pub const MAX_ISOPHOTE_ERROR_PX: f64 = 0.03;

/// Maximum difference between a tone (0 to 1) and a level for the border to count as found.
pub const MAX_ISOPHOTE_ERROR_TONE: f64 = 1e-7;

/// Maximum error of the border of a hatching tone bin, px.
pub const MAX_BIN_BORDER_ERROR_PX: f64 = 0.3;

/// Maximum error of the light at the border of a hatching tone bin, tones from 0 to 1.
pub const MAX_BIN_BORDER_ERROR_TONE: f64 = 1e-3;

/// With more levels than this, tones form a gradient whose single steps are not visible.
pub const MAX_SEPARATE_LEVELS: usize = 64;

/// Maximum difference between a gradient's tone and a level for the border to count as found.
pub const MAX_GRADIENT_BORDER_ERROR_TONE: f64 = 1e-4;

/// Gradient steps narrower than this in the image (px) are merged.
pub const MIN_GRADIENT_STEP_PX: f64 = 1.0;

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

/// Minimum distance from a model's lamp, as a fraction of the frame's longer side at the target: closer to
/// the lamp its light grows no more.
pub const MIN_LAMP_DISTANCE_OF_FRAME: f64 = 1e-3;

/// Highlights fade out where the cosine of the incident light is below this, so that they end without a jump
/// at the terminator.
pub const HIGHLIGHT_FADE_COSINE: f64 = 0.1;

/// Minimum softness of a spot light's cone, as a difference of cosines. Recommended by KHR_lights_punctual.
pub const MIN_CONE_SOFTNESS_COSINE: f64 = 1e-3;

/// Margin of bounding boxes in ray tests, as a fraction of the mesh: several roundings of single precision.
/// Hits themselves are decided exactly.
pub const RAY_BOX_OF_MESH: f64 = 1e-6;

/// Height of the sky-visibility sample above a vertex, as a fraction of the surrounding edges.
pub const SKY_PROBE_OF_EDGE: f64 = 1e-2;

/// Maximum displacement (px) of tone borders from the faces to the curved surface.
pub const MAX_SURFACE_LIFT_PX: f64 = 0.6;

/// Simplification tolerance of borders, px.
pub const BORDER_SIMPLIFY_PX: f64 = 0.01;

/// Borders that cross a grid row within this distance (grid steps) cross it at one point.
pub const CROSSING_MERGE_OF_STEP: f64 = 1e-6;

/// Maximum deviation (px) of a dot's outline from its circle and from the borders that clip it.
pub const MAX_DOT_OUTLINE_ERROR_PX: f64 = 0.01;

/// A clipped dot is dropped if its area is less than that of a square with this side (px).
pub const MIN_DOT_PIECE_PX: f64 = 0.1;

/// Shrinkage of a dot that a border is tangent to, as a fraction.
pub const DOT_SHRINK_OF_RADIUS: f64 = 1e-5;

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
