//! The pipeline, on one screen.

pub mod report;
pub mod stage;

pub use report::{Report, Stopwatch};
pub use stage::Stage;
