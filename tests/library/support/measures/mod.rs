//! Measures that compare lines, areas and pictures.
//!
//! Reading order:
//!
//! 1. [`line_picture`]: distances to a set of segments. [`segment_sets`]: overlap of two sets.
//! 2. [`polygon_cover`]: area covered by ink. [`plain_fills`]: the fills of a drawing.
//! 3. [`stroke_marks`]: widths and lengths of painted marks.
//! 4. [`canonical_checks`]: equality of SVG texts and of pictures.
//! 5. [`camera_turns`]: stability of lines between two cameras.

pub mod camera_turns;
pub mod canonical_checks;
pub mod line_picture;
pub mod plain_fills;
pub mod polygon_cover;
pub mod segment_sets;
pub mod stroke_marks;
