//! Everything below the lines of a drawing: paint, glass, patterns, pictures and hatching.
//!
//! 1. Light, shadows and occlusion are computed on the surface, and tone borders join the feature lines
//!    ([`surface_fills`]).
//! 2. Surfaces behind glass are seen and painted separately ([`glass_pass`]).
//! 3. Regions are painted; pictures, patterns and hatching are laid over them ([`fill_pass`]).
//!
//! Files, in reading order: [`surface_requirements`] what a style needs; [`surface_fills`]; [`glass_pass`];
//! [`fill_pass`]; [`picture_pass`]; [`pattern_pass`]; [`surface_patterns`] dots and tiles on the surface;
//! [`view_hatching`] hatching of a view.

pub(crate) mod fill_pass;
pub(crate) mod glass_pass;
mod pattern_pass;
mod picture_pass;
pub(crate) mod surface_fills;
mod surface_patterns;
pub(crate) mod surface_requirements;
pub(crate) mod view_hatching;
