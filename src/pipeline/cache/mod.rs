//! Results that several views of one surface share. They save time and change no drawing.
//!
//! One rule: the first view keeps the results that it computes for itself. The second view builds the
//! structures that only help later views.
//!
//! 1. Intersections are kept from the first view. The search for cut faces, and the trees over edges and
//!    normals if the style requests them, are built by the second ([`view_cache`]).
//! 2. Shadows of lights fixed in the world are kept from the first view ([`shadow_cache`]).
//!
//! Files, in reading order: [`view_cache`]; [`shadow_cache`].

pub(crate) mod shadow_cache;
pub(crate) mod view_cache;
