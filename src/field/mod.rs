//! Fields: numbers that vary over the surface, from which lines and regions are traced.

pub mod cut;
pub mod facing;
pub mod finer;
pub mod shaded_normals;
pub mod shading;
pub mod smoothing;

pub use cut::{SurfaceCut, cut};
pub use facing::facing;
pub use finer::finer_near_contours;
pub use shaded_normals::ShadedNormals;
pub use shading::{Shading, SurfacePoint};
pub use smoothing::smooth_near_zero;
