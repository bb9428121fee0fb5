//! Paint: regions as filled paths in the layers `fills` and `shadows`.
//!
//! 1. Bands of light with straight, parallel borders are joined into one region with a gradient
//!    (`gradient_regions`).
//! 2. Narrow regions are painted first. Each reaches a little under the neighbours painted after it.
//! 3. Outlines of several regions together follow the borders they share with others (`region_unions`).
//!
//! Files, in reading order: [`region_paint`]; [`gradient_regions`]; [`region_unions`].

pub(crate) mod gradient_regions;
pub(crate) mod region_paint;
pub(crate) mod region_unions;
