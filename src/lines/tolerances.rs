//! Tolerances of this area, each as a fraction of a named quantity, or in px of the page.

/// Minimum share of the length of an intersection curve that must be contact of round surfaces for the whole
/// curve to count as contact.
pub(crate) const MIN_CONTACT_OF_CURVE: f64 = 0.9;

/// Minimum cosine between a normal and the view direction in divisions.
pub(crate) const MIN_FACING_COSINE: f64 = 1e-10;

/// Minimum of the thresholds for lines inside the outline. Thresholds are dimensionless, scaled by the
/// feature size.
pub(crate) const MIN_LINE_THRESHOLD: f64 = 1e-9;

/// Faces are split until a tone border deviates by at most this (px) from its exact position.
pub(crate) const MAX_ISOPHOTE_ERROR_PX: f64 = 0.03;

/// Maximum difference between a tone (0 to 1) and a level for the border to count as found.
pub(crate) const MAX_ISOPHOTE_ERROR_TONE: f64 = 1e-7;

/// Maximum error of the border of a hatching tone bin, px.
pub(crate) const MAX_BIN_BORDER_ERROR_PX: f64 = 0.3;

/// Maximum error of the light at the border of a hatching tone bin, tones from 0 to 1.
pub(crate) const MAX_BIN_BORDER_ERROR_TONE: f64 = 1e-3;

/// Maximum difference between a gradient's tone and a level for the border to count as found.
pub(crate) const MAX_GRADIENT_BORDER_ERROR_TONE: f64 = 1e-4;

/// Gradient steps narrower than this in the image (px) are merged.
pub(crate) const MIN_GRADIENT_STEP_PX: f64 = 1.0;

/// Maximum displacement (px) of tone borders from the faces to the curved surface.
pub(crate) const MAX_SURFACE_LIFT_PX: f64 = 0.6;

/// Minimum distance between two cuts of a segment or mesh edge, and of a cut from its ends, as a fraction of
/// it. Closer cuts are one cut that was rounded differently.
pub(crate) const MIN_CUT_DISTANCE_OF_SEGMENT: f64 = 1e-9;

/// Shift of the shadow test point from an edge towards the middle of the face, as a fraction of the distance.
/// An adjacent surface may shade the edge itself.
pub(crate) const SHADOW_PROBE_SHIFT_SHARE: f64 = 1e-4;

/// Largest error of nearness (0 to 1) in single precision: about 80 roundings of a nearness up to 1.
pub(crate) const MAX_NEARNESS_ERROR: f32 = 1e-5;

/// Parameter interval (0 to 1) around a root that is not narrowed further. The spacing of double precision at
/// 1.
pub(crate) const MIN_ROOT_INTERVAL: f64 = f64::EPSILON;

/// Distance outside a triangle, in barycentric weight, within which the meeting point of three colour cells
/// counts as on its side. Allows for rounding of the point.
pub(crate) const MEETING_WEIGHT_MARGIN: f64 = 1e-6;
