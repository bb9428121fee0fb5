//! The strokes of a hatching layer as marks of the drawing.
//!
//! 1. Strokes are grouped by facet, pressure step and colour, so that the drawing has few marks
//!    ([`line_layer`]).
//! 2. Each group becomes one path: fitted centre lines, or outlines where strokes taper or swell
//!    ([`stroke_path`]).
//! 3. Paper tooth is laid over the strokes as specks in the paper's colour ([`line_layer`]).
//!
//! Files, in reading order: [`stroke_path`] a stroke as a path; [`line_layer`] a layer as marks.

pub(crate) mod line_layer;
pub(crate) mod stroke_path;
