//! Fields: numbers that vary over the surface, from which lines and regions are traced.

mod cones;
pub mod cut;
pub mod facing;
pub mod finer;
mod lamp;
pub mod light_options;
pub mod lighting;
pub mod occlusion;
pub mod ramp;
pub mod shade_options;
pub mod shaded_normals;
pub mod shading;
mod slope;
pub mod smoothing;
pub mod specular;
pub mod tone_options;
mod tones;
mod turned;

#[cfg(test)]
mod tests;

pub use cones::Cones;
pub use cut::{SurfaceCut, cut};
pub use facing::facing;
pub use finer::cuts_near_contours;
pub use light_options::{LightOptions, LightSource, SourceKind, Space};
pub use lighting::{Caster, SurfacePoint};
pub use occlusion::openness;
pub use shade_options::ShadeOptions;
pub use shaded_normals::ShadedNormals;
pub use shading::Shading;
pub use slope::Slope;
pub(crate) use slope::TURN_OF_CHORD;
pub use smoothing::smooth_near_zero;
pub use tone_options::ToneOptions;
