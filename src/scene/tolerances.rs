//! Tolerances of this area, each as a fraction of a named length or angle, or in px of the page.

/// Maximum step of coordinates, as a fraction of the model, before a warning. Equal to [`MAX_SEAM_GAP_OF_PART`].
pub const MAX_COORDINATE_STEP_OF_MODEL: f64 = 1e-4;
