//! Strokes with ink: widths, tremor, brushes, and the border of the frame.

mod dry_brush;
mod frame_border;
mod inked_lines;
mod inked_models;
mod pen_function;
mod random_widths;
mod turning_strokes;
