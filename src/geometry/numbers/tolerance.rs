//! Every epsilon of the crate, each tied to the length (or angle) it is a fraction of.
//!
//! `part` means the diagonal of the bounding box of the part that is judged, of the larger one where two
//! meet (see [`Extent::scale`](crate::mesh::Extent::scale)), so that a gear of 3 mm and a cathedral are judged
//! alike, and whatever else a model has changes nothing. Lengths in px of what lies in space are meant at its
//! depth.

/// Vertices nearer than this fraction of the part are one vertex, where they lie on open edges.
pub const WELD_OF_PART: f64 = 1e-8;

/// Single-precision files additionally weld within this fraction of a part's largest coordinate:
/// one and a half units in the last place of an `f32`.
pub const WELD_OF_F32_COORDINATE: f64 = 1.5 / 8_388_608.0;

/// The distance between neighbouring numbers in single precision, as a fraction of the number, at most.
pub const F32_STEP: f64 = 1.0 / 8_388_608.0;

/// A coordinate that is placed in the world in double precision is off by no more than this fraction of itself.
pub const ROUNDED_OF_COORDINATE: f64 = 8.0 * f64::EPSILON;

/// The place and the radius of a circle that is fitted to exact corners are off by no more than this fraction of the largest coordinate.
pub const FITTED_OF_COORDINATE: f64 = 1e-12;

/// How far the corners of a tessellated circle are off it, in steps of the file: half the diagonal of a cell, and as much again, for the program
/// has computed the corners with numbers that were rounded as well.
pub const CORNER_OFF_CIRCLE: f64 = 1.5;

/// A file whose coordinates have a coarser step than this, as a fraction of its size, did not round them but wrote short numbers: such a
/// step would show, a tenth of a pixel where the model is a thousand wide.
pub const VISIBLE_STEP: f64 = 1e-4;

/// How far rounding to a lattice moves a vertex, in steps of the lattice: half the diagonal of a cell, and a little for what the
/// program that wrote it computed.
pub const ROUNDING_OF_LATTICE: f64 = 0.9;

/// How far single precision moves a vertex, in steps of its largest coordinate: twice half the diagonal of a cell. A program that writes
/// single precision has also computed with it, and the matrix of a node is rounded as well.
pub const ROUNDING_OF_SINGLE: f64 = 1.75;

/// What moving a model leaves of its coordinates in double precision, as a share of the largest: a few units in the last place.
pub const ROUNDING: f64 = 1e-15;

/// Open edges of a part that run along each other within this fraction of it are the two sides of a seam: a tenth of a
/// pixel where the part is a thousand wide.
pub const SEAM_OF_PART: f64 = 1e-4;

/// Coordinates in steps above this fraction of the model are too coarse for it: as much as [`SEAM_OF_PART`].
pub const COARSE_OF_MODEL: f64 = 1e-4;

/// A triangle lower than this fraction of the part is degenerate: it hides nothing and has no
/// normal worth asking.
pub const DEGENERATE_HEIGHT_OF_PART: f64 = 1e-12;

/// A face whose normal rounding may have turned by more than an angle with this sine takes over that of a wider face in its plane: a
/// degree, below which neither creases nor tones change.
pub const UNSURE_SINE: f64 = 0.0175;

/// Degrees by which angles between faces are off because their normals are kept in single precision: at 15 degrees four times as much
/// as the rounding of two normals.
pub const ANGLE_DEG: f64 = 1e-4;

/// A vertex this near to the plane of a triangle (fraction of the part) lies in it, where surfaces
/// are tested for passing through each other.
pub const PLANE_OF_PART: f64 = 1e-12;

/// Two triangles whose common part is no longer than this fraction of the part merely touch.
pub const OVERLAP_OF_PART: f64 = 1e-9;

/// Two triangles whose common part is no longer than this many times what rounding moves a vertex by merely touch.
pub const OVERLAP_OF_ROUNDING: f64 = 4.0;

/// Surfaces that turn from one facet to the next by this many degrees or more are not round there: the default limit of creases.
pub const MAX_FACET_DEG: f64 = 40.0;

/// A curve of intersection is a contact of round surfaces if at least this share of its length is.
pub const CONTACT_OF_CURVE: f64 = 0.9;

/// Planes at an angle of this sine or less are parallel, and have no line in common.
pub const PARALLEL_SINE: f64 = 1e-9;

/// A face at less than an angle with this sine to the line of sight is seen edge-on, and counts as averted: a face as wide as the
/// picture is then no wider than 0.003 px of a thousand. Cameras of single precision are off by less.
pub const EDGE_ON_SINE: f64 = 3e-6;

/// Normals at less than this cosine to the line of sight count as having this one, where is divided by it.
pub const LEAST_FACING: f64 = 1e-10;

/// A plane whose distance from the eye, as a fraction of how far they may be apart, is no more than
/// this may be seen edge-on: twice what [`EDGE_ON_SINE`] says, for rounding.
pub const DUAL_OF_REACH: f64 = 2.0 * EDGE_ON_SINE;

/// A polygon of a file that turns by more than this (degrees) at a diagonal is folded there, and may have a crease; less is a surface that
/// bends. The default of `lines.crease_deg`: what is sharp enough for a crease anywhere.
pub const FOLDED_POLYGON_DEG: f64 = 40.0;

/// A surface this near in depth (fraction of its part) touches a line rather than hiding it.
pub const CONTACT_OF_PART: f64 = 5e-7;

/// A surface this near in depth (px) touches a line: nearer than this nothing is drawn apart.
pub const CONTACT_PX: f64 = 5e-4;

/// A point this near to the projected border of a triangle (px) counts as inside, so that a line
/// exactly behind an edge is hidden by the faces of that edge.
pub const COVER_PX: f64 = 1e-7;

/// Hidden or visible pieces shorter than this (px) are rounding, not geometry.
pub const PIECE_PX: f64 = 1e-4;

/// The near plane of a perspective view lies at this fraction of the way from eye to target.
pub const NEAR_OF_TARGET: f64 = 1e-5;

/// How far beside a contour (px) the view asks whether there is only background.
pub const BESIDE_PX: f64 = 1e-3;

/// How far beside a contour of a rounded surface (px): farther than its faces stand out from it.
pub const BESIDE_ROUNDED_PX: f64 = 1.0;

/// A surface that shares a vertex with a line hides it only where it is at least this much nearer
/// (fraction of its part): below that lies rounding.
pub const NEIGHBOUR_OF_PART: f64 = 1e-10;

/// How much nearer (px) a surface must be that shares a vertex with a line, to hide it.
pub const NEIGHBOUR_PX: f64 = 1e-7;

/// A triangle lower than this in the image (px) is seen edge-on and covers nothing.
pub const IMAGE_HEIGHT_PX: f64 = 1e-8;

/// Two lines that run within this distance (px) of each other are drawn once.
pub const DOUBLE_PX: f64 = 5e-3;

/// A hidden line that runs within this distance (px) of another one coincides with it, however wide its ink is. Where the
/// width of the ink is not known, curves that only touch would run along each other for long if it were more.
pub const BEHIND_INK_PX: f64 = 0.02;

/// Lines that cross at an angle of this sine or more do not run along each other, however near they come.
pub const BEHIND_INK_SINE: f64 = 0.02;

/// Zero sets cross an edge of the mesh at least this fraction of it away from its ends, so that no
/// piece of theirs is without length.
pub const ZERO_SET_OF_EDGE: f64 = 1e-6;

/// An edge of a rounded surface is cut where its arc lies farther than this (px) from it.
pub const ARC_PX: f64 = 0.08;

/// Edges no longer than this (px, seen square on) are never cut: lines over them are smooth already.
pub const SHORT_EDGE_PX: f64 = 2.5;

/// A contour that turns back in the image for no longer than this (px) has no cusp there.
pub const CUSP_PX: f64 = 1.0;

/// The two contours of a fold that lie within this distance (px) of each other in the image, and whose feet are no farther
/// apart in space than the base (px), are in one stroke of a pen.
pub const NEEDLE_PX: f64 = 0.4;
pub const NEEDLE_BASE_PX: f64 = 3.0;

/// A threshold of lines inside below this counts as this; thresholds are pure numbers, measured by
/// the size of features.
pub const LEAST_THRESHOLD: f64 = 1e-9;

/// Faces are cut until a tone border lies no farther than this (px) from where it ought to be.
pub const ISOPHOTE_PX: f64 = 0.03;

/// Where a tone is this near to a level (of tones from 0 to 1), its border is found.
pub const ISOPHOTE_VALUE: f64 = 1e-7;

/// How far the border of a bin of hatching may lie from where the light says, px.
pub const BIN_PX: f64 = 0.3;

/// Between two tones of a hatching the light may be off by this much.
pub const BIN_VALUE: f64 = 1e-3;

/// With more levels than this tones are a gradient, whose steps nobody sees one by one.
pub const FEW_LEVELS: usize = 64;

/// Where a tone of a gradient is this near to a level, its border is found.
pub const GRADIENT_VALUE: f64 = 1e-4;

/// Steps of a gradient that are narrower than this in the image (px) are drawn two or more as one.
pub const STEP_PX: f64 = 1.0;

/// Borders of steps of light that are joined to a gradient lie no farther than this (px) from straight lines across it.
pub const RAMP_PX: f64 = 0.35;

/// How far points are left out of borders that only hatching has, px.
pub const THIN_BIN_PX: f64 = 0.1;

/// How far points are left out of the borders of steps of a gradient, px.
pub const THIN_STEP_PX: f64 = 0.2;

/// Regions are cut on a grid of this many steps along the longer side of the frame.
pub const REGION_STEPS: f64 = 1_048_576.0;

/// Points of borders nearer than this (steps of that grid) to the line between their neighbours are
/// there by rounding.
pub const REGION_SNAP: f64 = 1.5;

/// What looks different from the rest of its cell over more than this (px) is not there by rounding.
pub const LEAK_PX: f64 = 1.2;

/// A border that ends this near (px) to another one goes on to it.
pub const BRIDGE_PX: f64 = 1.0;

/// Light of a model's lamp grows no more nearer to it than this fraction of the frame's longer side, as it is
/// at the target.
pub const LAMP_OF_FRAME: f64 = 1e-3;

/// Highlights fade where light falls at less than this cosine, so that they end without a jump
/// where the surface turns away from the light.
pub const HIGHLIGHT_FADE_COSINE: f64 = 0.1;

/// The border of a spot light's cone is at least this soft (difference of cosines), as
/// KHR_lights_punctual advises.
pub const LEAST_CONE: f64 = 1e-3;

/// Boxes that rays are tested against are this fraction of the mesh wider than what is in them:
/// several roundings of single precision. What the rays meet is decided exactly.
pub const RAY_BOX_OF_MESH: f64 = 1e-6;

/// How much of the sky a vertex sees is asked from this far above it, as a fraction of the edges around
/// it.
pub const LOOKOUT_OF_EDGE: f64 = 1e-2;

/// Tone borders move from faces to the curved surface where that is less than this (px) away.
pub const LIFT_PX: f64 = 0.6;

/// Points of borders nearer than this (px) to the line through those around them are passed over.
pub const THIN_PX: f64 = 0.01;

/// Borders that cross the row of a grid this near to each other (steps of the grid) cross it in one place.
pub const SCAN_OF_STEP: f64 = 1e-6;

/// The outline of a dot lies no farther than this (px) from its circle and the borders that cut it.
pub const DOT_PX: f64 = 0.01;

/// What borders leave of a dot is left out if its area is less than that of a square of this side (px).
pub const DOT_CRUMB_PX: f64 = 0.1;

/// Where a border just touches a dot, the dot is made smaller by this part of itself.
pub const DOT_NUDGE: f64 = 1e-5;

/// Widths of lines in two drawings that differ by no more than this (px) are one width, written twice, once with two decimals.
pub const WIDTH_PX: f64 = 5.1e-3;

/// Lengths of dashes that differ by less than this (px) are alike.
pub const DASH_PX: f64 = 5.1e-3;

/// Readers of SVG keep coordinates in single precision: two drawings cannot be compared more finely than this
/// part of the page's longer side.
pub const READ_OF_PAGE: f64 = 1e-6;

/// Drawings are compared at least this finely by default, however few decimals they are written with (px).
pub const COARSEST_STEP_PX: f64 = 0.1;

/// Curves are flattened within this part of the tolerance that they are compared with.
pub const FLAT_OF_TOLERANCE: f64 = 0.1;

/// Curves that are compared are not flattened more finely than this part of their size: readers keep no more digits.
pub const FLAT_OF_CURVE: f64 = 1e-7;

/// Ends this near to each other, as a part of the tolerance, were one point before a line was split.
pub const JOIN_OF_TOLERANCE: f64 = 1.0;

/// Marks that were written in two ways may lie this far apart (px) in one picture, if the tolerance is not narrower.
pub const COARSEST_VETO_PX: f64 = 0.25;

/// Differences that geometry has not found are sought in pictures where they are wider than this (px): twice the second decimal, as
/// most drawings are written. Renderers are not more precise.
pub const FINEST_SEEN_PX: f64 = 0.02;

/// Distances of two lines are found within this part of themselves.
pub const DISTANCE_SHARE: f64 = 2e-3;
