//! Tolerances of this area, each as a fraction of a named quantity, or in px of the page.

/// Minimum distance of a zero-set crossing from the ends of a mesh edge, as a fraction of the edge. Prevents
/// pieces of zero length.
pub(crate) const ZERO_SET_OF_EDGE: f64 = 1e-6;

/// With more levels than this, tones form a gradient whose single steps are not visible.
pub(crate) const MAX_SEPARATE_LEVELS: usize = 64;

/// Minimum distance from a model's lamp, as a fraction of the frame's longer side at the target: closer to
/// the lamp its light grows no more.
pub(crate) const MIN_LAMP_DISTANCE_OF_FRAME: f64 = 1e-3;

/// Highlights fade out where the cosine of the incident light is below this, so that they end without a jump
/// at the terminator.
pub(crate) const HIGHLIGHT_FADE_COSINE: f64 = 0.1;

/// Minimum softness of a spot light's cone, as a difference of cosines. Recommended by KHR_lights_punctual.
pub(crate) const MIN_CONE_SOFTNESS_COSINE: f64 = 1e-3;

/// Height of the sky-visibility sample above a vertex, as a fraction of the surrounding edges.
pub(crate) const SKY_PROBE_OF_EDGE: f64 = 1e-2;

/// Margin for the rounding of lengths and bounds in double precision, as a fraction of them. Much larger than
/// the error: a rounding is at most 1.2e-16.
pub(crate) const F64_MARGIN_SHARE: f64 = 1e-9;

/// Margin for the rounding of a value to single precision, as a fraction of it. Much larger than the error: a
/// rounding is at most 6e-8.
pub(crate) const F32_MARGIN_SHARE: f64 = 1e-6;

/// Margin for the rounding of a facing value (the cosine between normal and line of sight). Much larger than
/// the error.
pub(crate) const FACING_MARGIN: f64 = 1e-6;

/// Minimum depth for measuring the edge length of a part, as a fraction of the part. Keeps the length
/// in px positive and finite for parts at or behind the eye.
pub(crate) const MIN_SMOOTHING_DEPTH_OF_PART: f64 = 1e-3;
