//! Tolerances of meshes, each as a fraction of a named length or angle, or in px of the page.
//!
//! `part` is the diagonal of the bounding box of the part in question, or of the larger part where two meet.

/// Vertices on open edges within this fraction of the part are welded.
pub(crate) const WELD_OF_PART: f64 = 1e-8;

/// Additional weld distance for single-precision files, as a fraction of the part's largest coordinate: 1.5
/// units in the last place of an `f32`.
pub(crate) const WELD_OF_F32_COORDINATE: f64 = 1.5 / 8_388_608.0;

/// Maximum step of rounded coordinates, as a fraction of the model's size.
///
/// Coordinates with a coarser step are exact short numbers: rounding to such a step would be visible (a tenth
/// of a pixel at a width of 1000 px).
pub(crate) const MAX_ROUNDED_STEP_OF_SIZE: f64 = 1e-4;

/// Maximum displacement of a vertex when it is rounded to a lattice, in lattice steps: half the diagonal of a
/// cell, plus a margin for errors of the exporting program.
pub(crate) const MAX_LATTICE_ROUNDING_STEPS: f64 = 0.9;

/// Maximum displacement of a vertex by single precision, in steps at its largest coordinate.
///
/// Twice half the diagonal of a cell: exporters that write single precision also compute with it, and node
/// matrices are rounded as well.
pub(crate) const MAX_F32_ROUNDING_STEPS: f64 = 1.75;

/// Maximum gap between the two sides of a seam (open edges), as a fraction of the part: a tenth of a pixel if
/// the part is 1000 px wide.
pub(crate) const MAX_SEAM_GAP_OF_PART: f64 = 1e-4;

/// A triangle lower than this fraction of the part is degenerate: it hides nothing and has no usable normal.
pub(crate) const DEGENERATE_HEIGHT_OF_PART: f64 = 1e-12;

/// Sine of the maximum uncertainty of a face normal. A less certain face takes the normal of a wider face in
/// its plane. One degree: smaller errors change neither creases nor tones.
pub(crate) const MAX_NORMAL_ERROR_SINE: f64 = 0.0175;

/// Error of angles between faces because normals are stored in single precision, in degrees. At 15 degrees
/// this is four times the rounding of two normals.
pub(crate) const DIHEDRAL_ROUNDING_DEG: f64 = 1e-4;

/// A vertex within this distance of a triangle's plane (fraction of the part) is in the plane, in
/// intersection tests of surfaces.
pub(crate) const PLANE_OF_PART: f64 = 1e-12;

/// Two triangles whose intersection is no longer than this fraction of the part only touch.
pub(crate) const OVERLAP_OF_PART: f64 = 1e-9;

/// Two triangles whose intersection is no longer than this multiple of a vertex's rounding error only touch.
pub(crate) const OVERLAP_OF_ROUNDING: f64 = 4.0;

/// Surfaces that turn by this many degrees or more between facets are not round there. Equal to the default
/// crease limit.
pub(crate) const MAX_FACET_DEG: f64 = 40.0;

/// Planes at an angle with this sine or less are parallel and have no common line.
pub(crate) const PARALLEL_SINE: f64 = 1e-9;

/// A face within this sine of the view direction is edge-on and counts as averted.
///
/// A face as wide as a picture of 1000 px is then narrower than 0.003 px. Errors of single-precision cameras
/// are smaller.
pub(crate) const EDGE_ON_SINE: f64 = 3e-6;

/// A plane may be edge-on if its distance from the eye is at most this fraction of their maximum distance:
/// twice [`EDGE_ON_SINE`], to allow for rounding.
pub(crate) const EDGE_ON_PLANE_OF_REACH: f64 = 2.0 * EDGE_ON_SINE;

/// A file's polygon that turns by more than this (degrees) at a diagonal is folded there and may have a
/// crease; otherwise it is a curved surface. Equal to the default of `lines.crease_deg`.
pub(crate) const FOLDED_POLYGON_DEG: f64 = 40.0;

/// A surface within this depth of a line (fraction of its part) touches the line and does not hide it.
pub(crate) const CONTACT_OF_PART: f64 = 5e-7;

/// Margin of bounding boxes in ray tests, as a fraction of the mesh: several roundings of single precision.
/// Hits themselves are decided exactly.
pub(crate) const RAY_BOX_OF_MESH: f64 = 1e-6;

/// Factor on the squared limit of the fast area test. Covers the rounding of `f64`, so that the fast test
/// accepts no triangle that the exact test rejects.
pub(crate) const AREA_ROUNDING_FACTOR: f64 = 1.0 + 1e-9;

/// Two corners may lie in a plane if their distances from it are below this fraction of the third corner's
/// distance. Larger than any error of a trusted normal; exact predicates decide the rest.
pub(crate) const MAX_PLANE_DISTANCE_OF_FARTHEST: f64 = 1e-4;

/// Minimum squared sine of a corner of a triangle with a trusted normal. Above it, the rounding error of the
/// normal is well inside the plane tolerance.
pub(crate) const MIN_TRUSTED_SINE_SQUARED: f64 = 1e-4;

/// Upper bound of the rounding error of a determinant of four points, as a fraction of the cube of their
/// extent.
pub(crate) const DETERMINANT_ROUNDING: f64 = 48.0 * f64::EPSILON;

/// Factor on the plane tolerance in a test without exact arithmetic. Points nearer to the limit are left to
/// exact predicates.
pub(crate) const PLANE_ROUNDING_FACTOR: f64 = 1.0 - 1e-6;

/// Rounding error of a sum of `f64`, per term, as a fraction of the sum of the sizes.
///
/// Source: Higham, "Accuracy and stability of numerical algorithms", 2002, section 4.2.
pub(crate) const SUM_ROUNDING_PER_TERM: f64 = f64::EPSILON;

/// Maximum angle at an edge between coplanar faces, radians. Covers the rounding of moved models.
pub(crate) const MAX_COPLANAR_ANGLE_RAD: f64 = 1e-6;

/// Maximum distance between vertices of a pose that are welded at rest, as a fraction of the model. Covers
/// the rounding of joints.
pub(crate) const MAX_SPREAD_OF_MODEL: f64 = 1e-6;

/// Minimum size of a camera's plane in the dual tree, in radii of the mesh. With a smaller one, products in
/// the computation of a face may leave the range of `f64`, and every edge is a candidate.
pub(crate) const MIN_DUAL_PLANE_SIZE: f64 = 1e-6;

/// Maximum difference of the squared length of a unit normal from 1. Covers normals in single precision,
/// whose coordinates are off by less than a ten-millionth.
pub(crate) const MAX_UNIT_LENGTH_ERROR: f64 = 1e-6;

/// Maximum contact distance due to the precision of a file, as a fraction of the part. A file with coarser
/// coordinates does not determine which surfaces touch.
pub(crate) const MAX_CONTACT_OF_PART: f64 = 1e-3;

/// Minimum displacement in a descent step of the bending energy, in half steps of the lattice: 0.2 % of a
/// step. Descent stops below it.
pub(crate) const MIN_MOVE_HALF_STEPS: f32 = 4e-3;

/// Maximum difference of texture coordinates and colours (0 to 1) across a seam. Larger differences are
/// intentional borders.
pub(crate) const MAX_SEAM_PAINT_DIFFERENCE: f32 = 1e-3;

/// Maximum error of a normal by rounding, radians, for a surface that may overlap others. The plane of a
/// narrower sliver is unknown.
pub(crate) const MAX_OVERLAP_NORMAL_ERROR_RAD: f64 = 1e-2;
