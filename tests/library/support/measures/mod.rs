//! Measures that compare lines, areas and pictures.
//!
//! Reading order:
//!
//! 1. [`line_picture`]: distances to a set of segments. [`segment_sets`]: overlap of two sets.
//! 2. [`polygon_cover`]: area covered by ink. [`plain_fills`]: the fills of a drawing.
//! 3. [`stroke_marks`]: widths and lengths of painted marks.
//! 4. [`canonical_checks`]: equality of SVG texts and of pictures.
//! 5. [`camera_turns`]: stability of lines between two cameras.

pub(crate) mod camera_turns;
pub(crate) mod canonical_checks;
pub(crate) mod line_picture;
pub(crate) mod plain_fills;
pub(crate) mod polygon_cover;
pub(crate) mod segment_sets;
pub(crate) mod stroke_marks;
