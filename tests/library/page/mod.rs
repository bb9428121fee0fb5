//! Pages, panels, letters and technical sheets.

mod dimension_values;
mod letters;
mod page_files;
mod panels;
mod sheet_layouts;
mod sheet_lengths;
mod sheet_texts;
mod technical_sheets;
