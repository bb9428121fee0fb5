//! Styles for models that were cut open or moved apart.
//!
//! Source: ISO 128-50:2001, Basic conventions for representing areas on cuts and sections, 4 and 6.
//! 1. The directions of the long sides of cut faces are measured in the picture ([`cut_directions`]).
//! 2. Each cut part gets hatching that differs from its neighbours and does not run along its long sides
//!    ([`section_style`]).
//!
//! Files, in reading order: [`cut_directions`]; [`section_style`].

mod cut_directions;
pub(crate) mod section_style;
