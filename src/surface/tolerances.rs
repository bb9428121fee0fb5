//! Tolerances of curved surfaces: of cylinders, curvature, refined edges and patches.

/// Maximum difference of the distances from an axis to the corners of one facet, as a fraction of the
/// largest distance. Covers the rounded coordinates of a file.
pub(crate) const MAX_FACET_RADIUS_SPREAD: f64 = 2e-4;

/// Maximum difference of the radii of facets of one rim, as a fraction of the radius.
///
/// The same bound holds for the sine between coaxial axes, for the cosine between the normal of a facet and
/// the axis, and for the offset of a facet along its own plane. All of them are several times
/// [`MAX_FACET_RADIUS_SPREAD`], because axes are estimated from rounded facets.
pub(crate) const MAX_RIM_RADIUS_SPREAD: f64 = 1e-3;

/// Maximum sine of the angle between parallel lines of a strip, and between the axes of one cylinder: 0.06
/// degrees. Covers coordinates in single precision.
pub(crate) const MAX_PARALLEL_SINE: f64 = 1e-3;

/// Maximum difference of the centres and radii of strips of one cylinder, as a fraction of the radius. Covers
/// coordinates in single precision: the bisectors of narrow strips meet at small angles.
pub(crate) const MAX_CIRCLE_OFFSET_OF_RADIUS: f64 = 5e-3;

/// Maximum distance of a line from the side of its strip, as a fraction of the strip's width. A line farther
/// inside divides the facet, which is then no strip.
pub(crate) const MAX_SIDE_OFFSET_OF_WIDTH: f64 = 1e-3;

/// Maximum difference of the ends of both sides of a strip that does not taper, as a fraction of its length
/// or, if larger, its width.
pub(crate) const MAX_END_DIFFERENCE_OF_STRIP: f64 = 1e-3;

/// Minimum sine of the angle between the normals of two adjacent strips. Keeps the division finite where
/// their bisectors are parallel.
pub(crate) const MIN_BISECTOR_SINE: f64 = 1e-9;

/// Minimum weight of a term of the Chebyshev series of heat diffusion. The weights add up to 1, so that an
/// omitted term turns a unit normal by about a tenth of a degree.
pub(crate) const MIN_CHEBYSHEV_WEIGHT: f64 = 2e-3;

/// Start value of Miller's backward recurrence. Not a tolerance: the values are divided by their sum in the
/// end. It is small, so that they can grow.
pub(crate) const BESSEL_START: f64 = 1e-250;

/// Factor that scales the values of Miller's recurrence down before they overflow. Not a tolerance: the
/// values are divided by their sum in the end.
pub(crate) const BESSEL_RESCALE: f64 = 1e-200;

/// Minimum argument of the modified Bessel functions. Keeps the division finite without diffusion.
pub(crate) const MIN_BESSEL_ARGUMENT: f64 = 1e-12;

/// Maximum cosine of the angle between opposite unit normals: one unit of rounding above −1. There is no shortest
/// rotation between them.
pub(crate) const MAX_OPPOSITE_COSINE: f64 = -1.0 + f64::EPSILON;

/// Offset of the ray start below the edge, in arc heights. The ray misses the faces at the edge, and the
/// measured thickness hardly changes.
pub(crate) const RAY_OFFSET_OF_RISE: f64 = 1e-3;

/// Maximum angle defect at a vertex of a cylinder, radians. It is zero in theory; the rest is rounding of
/// coordinates in single precision.
pub(crate) const ANGLE_ROUNDING_RAD: f64 = 2e-4;

/// Factor on the limit of the fast test for slivers. Covers the rounding of `f64`, so that the fast test
/// excludes no face that the exact test accepts.
pub(crate) const SLIVER_ROUNDING_FACTOR: f64 = 1.0 + 1e-9;

/// Factor for the comparison of areas. The rounding of sums of `f64` depends on the order of faces, and
/// equal areas must compare as equal.
pub(crate) const AREA_ROUNDING_FACTOR: f64 = 1.0 - 1e-9;

/// Minimum cosine of a flat edge: 0.1 degrees.
pub(crate) const MIN_FLAT_COSINE: f32 = 0.999_998_5;

/// Minimum ratio of the widths of a face and a strip next to it. Above it the face is the surface, and the strip
/// its rounded edge.
pub(crate) const MIN_STRIP_WIDTH_RATIO: f64 = 6.0;
