//! The field n·v, whose zero set is the contour, and level sets of fields on rounded surfaces.
//!
//! 1. n·v is evaluated at every smooth vertex (Hertzmann and Zorin 2000, §4.1).
//! 2. Near its zero set it is smoothed, by a radius of a few px.
//! 3. Coarse surfaces are refined where the contour may pass (Hertzmann and Zorin 2000, §4.3).
//! 4. Rounded faces are cut along level sets into pieces that share their borders (Claes et al. 2001).
//!
//! Files, in reading order: [`facing_field`] step 1; [`field_smoothing`] step 2; [`contour_refinement`] step
//! 3; [`level_set_cut`] step 4; [`culling`] bounds that skip edges without a contour.

pub(crate) mod contour_refinement;
pub(crate) mod culling;
pub(crate) mod facing_field;
pub(crate) mod field_smoothing;
pub(crate) mod level_set_cut;
