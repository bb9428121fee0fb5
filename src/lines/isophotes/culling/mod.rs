//! Shortcuts of the search for isophotes. They change the time, not the drawing.
//!
//! [`covered_faces`] finds faces behind nearer ones, where gradients need no tracing.

pub(crate) mod covered_faces;
