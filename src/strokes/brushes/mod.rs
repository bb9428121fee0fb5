//! Brushes: shapes and pictures laid along lines.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth 2001, fig. 5e; mapped by arc length as in Hsu and Lee,
//! Drawing and animation using skeletal strokes, SIGGRAPH 1994.
//! 1. A style sheet names path data, an SVG file or a picture ([`brush_source`]); a picture is traced or kept
//!    ([`brush_strip`]).
//! 2. The shape is mapped once or repeatedly along the axis ([`brush`]); a picture is mapped in affine pieces
//!    ([`brush_image`]).
//! 3. Paper between the axis and a brush next to it is filled, because paint ends at the axis
//!    ([`brush_core`]).
//!
//! Files, in reading order: [`brush_source`]; [`brush_strip`]; [`brush`]; [`brush_image`]; [`brush_core`].

pub(crate) mod brush;
mod brush_core;
pub(crate) mod brush_image;
pub(crate) mod brush_source;
pub(crate) mod brush_strip;
