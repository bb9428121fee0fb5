//! Fields: one number a smooth vertex, from which lines are traced.

pub mod cut;
pub mod facing;
pub mod finer;
pub mod smoothing;

pub use cut::{SurfaceCut, cut};
pub use facing::facing;
pub use finer::finer_near_contours;
pub use smoothing::smooth_near_zero;
