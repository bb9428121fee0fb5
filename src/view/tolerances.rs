//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// A face within this sine of the view direction is edge-on and counts as averted.
///
/// A face as wide as a picture of 1000 px is then narrower than 0.003 px. Errors of single-precision cameras
/// are smaller.
pub const EDGE_ON_SINE: f64 = 3e-6;

/// Distance of the near plane of a perspective view, as a fraction of the distance from eye to target.
pub const CLIP_PLANE_OF_TARGET: f64 = 1e-5;
