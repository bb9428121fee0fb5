//! Fields: one number a smooth vertex, from which lines are traced.

pub mod facing;
pub mod finer;

pub use facing::facing;
pub use finer::finer_near_contours;
