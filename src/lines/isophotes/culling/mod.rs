//! Shortcuts of the search for isophotes. They change the time, not the drawing.
//!
//! [`covered_faces`] finds faces behind nearer ones, where gradients need no tracing; [`tone_faces`] finds the
//! faces that may hold a border.

pub(crate) mod covered_faces;
pub(crate) mod tone_faces;
