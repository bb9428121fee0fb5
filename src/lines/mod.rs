//! Feature lines: curves on the surface that may be drawn.

pub mod kind;

pub use kind::LineKind;
