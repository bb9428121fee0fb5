//! Guides, the lines along which hatching is drawn, and the strokes laid along them.
//!
//! 1. Guides run straight over the page ([`guide`]), along a direction field of the surface or light
//!    ([`guide_directions`], [`streamlines`]; Jobard and Lefer 1997), or along level curves fixed to the model
//!    ([`section_guides`]).
//! 2. Each guide has a rank from 0 to 1. It is inked where the tone wants more than that share of all guides
//!    (Praun, Hoppe, Webb and Finkelstein, "Real-time hatching", SIGGRAPH 2001).
//! 3. Strokes are laid along guides with gaps, bows and tremor, and cut at cell borders
//!    ([`stroke_layout`], with `clip::line_clip`).
//!
//! Files, in reading order: [`guide`]; [`guide_directions`]; [`streamlines`]; [`section_guides`];
//! [`stroke_layout`].

pub(crate) mod guide;
pub(crate) mod guide_directions;
pub(crate) mod section_guides;
pub(crate) mod streamlines;
pub(crate) mod stroke_layout;
