//! Isophotes, the tone borders inside faces: curves on a lit surface along which its tone changes. For tone
//! borders along mesh edges see `paint_borders::tone_edges`.
//!
//! 1. For each face, channel of light and set of shadowed lights, the levels of tone are looked up (`isophote_lines`,
//!    which runs all steps).
//! 2. The face is subdivided until the light is almost linear on each piece; there levels are straight
//!    (`level_tracer`).
//! 3. Narrow steps of a gradient are drawn as one (`level_strides`), and gradients on covered faces are
//!    skipped.
//! 4. Pieces that change no tone, for example inside a shadow, are found afterwards (`tone_changes`).
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, Fast 3D cartoon rendering, IVCNZ 2001, sections 3.5 and
//! 3.6.
//!
//! Files, in reading order: [`lit_surface`] light, tone and paint at a point; [`isophote_lines`];
//! [`level_tracer`]; [`level_strides`]; [`culling`] faces that may be seen; [`tone_changes`].

pub(crate) mod culling;
pub(crate) mod isophote_lines;
mod level_strides;
pub(crate) mod level_tracer;
pub(crate) mod lit_surface;
pub(crate) mod tone_changes;
