//! Tests of exported files, each read back with an independent reader.

mod dxf_strokes;
mod part_groups;
mod pdf_pages;
mod png_ink;
mod press_pdf;
mod svg_and_png;
