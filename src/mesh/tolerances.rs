//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.
//!
//! `part` is the diagonal of the bounding box of the part in question, or of the larger part where two meet.

/// Vertices on open edges within this fraction of the part are welded.
pub const WELD_OF_PART: f64 = 1e-8;

/// Additional weld distance for single-precision files, as a fraction of the part's largest coordinate: 1.5
/// units in the last place of an `f32`.
pub const WELD_OF_F32_COORDINATE: f64 = 1.5 / 8_388_608.0;

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

/// Maximum gap between the two sides of a seam (open edges), as a fraction of the part: a tenth of a pixel if
/// the part is 1000 px wide.
pub const MAX_SEAM_GAP_OF_PART: f64 = 1e-4;

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

/// Planes at an angle with this sine or less are parallel and have no common line.
pub const PARALLEL_SINE: f64 = 1e-9;

/// A plane may be edge-on if its distance from the eye is at most this fraction of their maximum distance:
/// twice [`EDGE_ON_SINE`], to allow for rounding.
pub const EDGE_ON_PLANE_OF_REACH: f64 = 2.0 * crate::view::tolerances::EDGE_ON_SINE;

/// A file's polygon that turns by more than this (degrees) at a diagonal is folded there and may have a
/// crease; otherwise it is a curved surface. Equal to the default of `lines.crease_deg`.
pub const FOLDED_POLYGON_DEG: f64 = 40.0;

/// A surface within this depth of a line (fraction of its part) touches the line and does not hide it.
pub const CONTACT_OF_PART: f64 = 5e-7;

/// Margin of bounding boxes in ray tests, as a fraction of the mesh: several roundings of single precision.
/// Hits themselves are decided exactly.
pub const RAY_BOX_OF_MESH: f64 = 1e-6;
