//! Measures of drawings: covered area, ink, segments, marks, and how far they move.

pub mod camera_turns;
pub mod canonical_checks;
pub mod line_picture;
pub mod plain_fills;
pub mod polygon_cover;
pub mod segment_sets;
pub mod stroke_marks;
