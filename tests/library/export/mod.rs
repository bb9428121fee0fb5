//! Written files, each read back by another reader.

mod dxf_strokes;
mod part_groups;
mod png_ink;
mod press_pdf;
mod svg_and_png;
