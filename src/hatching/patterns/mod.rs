//! Patterns over tones: dots, lines, crosses and tiles.
//!
//! Source: Claes et al., Fast 3D cartoon rendering with improved quality by exploiting graphics hardware,
//! 2001, section 3.4, with vector shapes in place of textures.
//! 1. A tile is read from path data, an SVG file or a picture ([`tile`]).
//! 2. The pattern is repeated over the page, or comes in already placed on the surface ([`pattern_marks`]).
//! 3. Lines are clipped as strokes are, filled shapes as polygons ([`pattern_shapes`]).
//!
//! Files, in reading order: [`pattern_options`] the `[[fills.pattern]]` table; [`tile`]; [`pattern_shapes`];
//! [`pattern_marks`].

pub(crate) mod pattern_marks;
pub(crate) mod pattern_options;
mod pattern_shapes;
pub(crate) mod tile;
