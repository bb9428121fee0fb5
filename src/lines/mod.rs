//! Feature lines: curves on the surface that may be drawn.

pub mod kind;
pub mod options;

pub use kind::LineKind;
pub use options::{HiddenLines, LineOptions};
