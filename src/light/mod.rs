//! Light on the surface: lights, tones and scalar fields that lines and regions are traced from.
//!
//! 1. `lights` evaluates diffuse and specular light at a point of the surface.
//! 2. `tones` maps light to tones and tones to colours.
//! 3. `contour_field` evaluates n·v, whose zero set is the contour, and cuts the surface along level sets.
//!
//! Files, in reading order: [`shading_normals`] the normals used for lighting; [`ambient_occlusion`] the
//! share of the sky that each vertex sees; [`lights`]; [`tones`]; [`contour_field`].

pub mod ambient_occlusion;
pub mod contour_field;
pub mod lights;
pub mod shading_normals;
pub mod tones;

#[cfg(test)]
mod tests;
pub(crate) mod tolerances;

pub use ambient_occlusion::ambient_visibility;
pub use contour_field::contour_refinement::cuts_near_contours;
pub use contour_field::culling::normal_cones::NormalCones;
pub use contour_field::facing_field::facing;
pub use contour_field::field_smoothing::smooth_near_zero;
pub use contour_field::level_set_cut::{SurfaceCut, cut};
pub use lights::light_options::{LightOptions, LightSource, SourceKind, Space};
pub use lights::light_slope::LightSlope;
pub(crate) use lights::light_slope::TURN_PER_CHORD;
pub use lights::lighting::{Caster, SurfacePoint};
pub use shading_normals::ShadingNormals;
pub use tones::shade_options::ShadeOptions;
pub use tones::shading::Shading;
pub use tones::tone_options::ToneOptions;
