//! Light on the surface: lights, tones and scalar fields that lines and regions are traced from.
//!
//! 1. `lights` evaluates diffuse and specular light at a point of the surface.
//! 2. `tones` maps light to tones and tones to colours.
//! 3. `contour_field` evaluates n·v, whose zero set is the contour, and cuts the surface along level sets.
//!
//! Files, in reading order: [`shading_normals`] the normals used for lighting; [`ambient_occlusion`] the
//! share of the sky that each vertex sees; [`lights`]; [`tones`]; [`contour_field`].

pub(crate) mod ambient_occlusion;
pub(crate) mod contour_field;
pub(crate) mod lights;
pub(crate) mod shading_normals;
pub(crate) mod tones;

#[cfg(test)]
mod tests;
pub(crate) mod tolerances;

pub use ambient_occlusion::ambient_visibility;
pub(crate) use contour_field::contour_refinement::{cuts_along_rims, cuts_near_contours};
pub(crate) use contour_field::facing_field::facing;
pub(crate) use contour_field::field_smoothing::smooth_near_zero;
pub(crate) use contour_field::level_set_cut::{SurfaceCut, cut};
pub(crate) use lights::light_options::LightOptions;
pub(crate) use lights::light_slope::LightSlope;
pub(crate) use lights::light_slope::TURN_PER_CHORD;
pub use lights::lighting::Caster;
pub(crate) use lights::lighting::SurfacePoint;
pub(crate) use shading_normals::ShadingNormals;
pub(crate) use tones::shade_options::ShadeOptions;
pub(crate) use tones::shading::Shading;
pub(crate) use tones::tone_options::ToneOptions;
