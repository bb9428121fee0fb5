//! Tolerances of this area, each as a fraction of a named length or angle, or in pixels of a raster.

/// Distance of the near plane of a perspective view, as a fraction of the distance from eye to target.
pub(crate) const CLIP_PLANE_OF_TARGET: f64 = 1e-5;

/// Largest sine of the angle of an unsure face. Narrower faces, which rounding may turn by more, have a
/// carrier in the mesh, or none.
pub(crate) const MAX_UNSURE_SINE: f64 = 1e-2;

/// Distance outside a triangle where a pixel centre still counts as covered, pixels of a raster. It exceeds
/// rounding, so no pixel falls between two triangles.
pub(crate) const COVER_MARGIN_PIXELS: f32 = 1e-4;
