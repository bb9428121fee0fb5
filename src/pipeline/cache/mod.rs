//! Results that several views of one surface share. They save time and change no drawing.
//!
//! 1. Edge search trees, intersections and cones are built once enough views have been drawn
//!    ([`view_cache`]).
//! 2. Shadows of lights fixed in the world are kept from the first view ([`shadow_cache`]).
//!
//! Files, in reading order: [`view_cache`]; [`shadow_cache`].

pub(crate) mod shadow_cache;
pub(crate) mod view_cache;
