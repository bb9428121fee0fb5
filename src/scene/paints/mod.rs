//! The colour of each triangle where textures or vertex colours give it one.
//!
//! 1. Each triangle is sampled: its colour in the texture and at its corners ([`triangle_colour`]).
//! 2. Triangles of one flat colour get a paint of their material in that colour ([`triangle_paints`]).
//! 3. Triangles with pictures or blended vertex colours get a varying paint, resolved point by point
//!    ([`varying_paints`], [`vertex_colours`], [`varying_surface`]).
//!
//! [`artist_textures`] holds pictures that a style lays on materials to draw lines where their colour
//! changes.

pub(crate) mod artist_textures;
mod triangle_colour;
pub(crate) mod triangle_paints;
mod varying_paints;
pub(crate) mod varying_surface;
pub(crate) mod vertex_colours;
