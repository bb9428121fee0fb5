//! Tolerances of scenes: of coordinates, cameras and textures.

/// Maximum step of coordinates, as a fraction of the model, before a warning. Equal to
/// [`MAX_SEAM_GAP_OF_PART`](crate::mesh::tolerances::MAX_SEAM_GAP_OF_PART).
pub(crate) const MAX_COORDINATE_STEP_OF_MODEL: f64 = 1e-4;

/// Maximum difference of a multiple of a decimal step from a whole number, as a fraction of it. Covers the
/// rounding of the coordinate, of the step and of their product or quotient in `f64`.
pub(crate) const INTEGER_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Sine of the angle between `up` and the optical axis below which they count as parallel. The picture's
/// right direction would be rounding noise.
pub(crate) const MIN_UP_SINE: f64 = 1e-9;

/// Minimum height of a fitted parallel view, as a fraction of the model's diagonal. Matters only for models
/// that are thin in the view direction, such as a rod seen end-on.
pub(crate) const MIN_VIEW_HEIGHT_OF_DIAGONAL: f64 = 1e-6;

/// Maximum deviation of a segment from the curved border of a mask, as a fraction of its length. Segments are
/// at most about a texel long, so that borders have no visible corners even where texels are magnified.
pub(crate) const MAX_CURVE_ERROR_OF_SEGMENT: f64 = 1e-3;

/// Overlaps of a pixel and a texel below this fraction of a texel are rounding errors.
pub(crate) const MIN_TEXEL_SHARE: f64 = 1e-6;

/// Minimum of twice the squared standard deviation of a blur, texels squared. Keeps the division finite
/// without a blur.
pub(crate) const MIN_DOUBLED_BLUR_VARIANCE: f64 = 1e-9;

/// Minimum resolution of a colour map, texels per px. Texels that are magnified more are drawn at this scale,
/// which keeps the sizes derived from it positive.
pub(crate) const MIN_TEXELS_PER_PX: f64 = 1e-3;

/// Crossings within this fraction of a side from its end count as the end. Covers the rounding of `f64`.
pub(crate) const END_OF_SIDE: f64 = 1e-9;
