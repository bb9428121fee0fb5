//! Textures: pictures and vertex colours as a view shows them, reduced to a few colours.
//!
//! 1. The number of texels per px is measured on the visible faces, as a mean and from place to place.
//! 2. A picture is reduced to a few colours at one scale, or at several powers of two where its scale varies.
//! 3. The colour at a point of a face comes from the level that its texel density selects.
//!
//! Files, in reading order: [`texel_scale`] texels per px; [`picture_levels`] a picture at several scales;
//! [`textured_face`] colours on one face; [`view_textures`] all textures of a view.

pub(crate) mod picture_levels;
mod texel_scale;
pub(crate) mod textured_face;
pub(crate) mod view_textures;
