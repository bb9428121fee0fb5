//! Pages, panels, lettering and technical sheets: layouts, texts, dimensions and page files.

mod balloons;
mod dimension_values;
mod letters;
mod page_files;
mod panels;
mod parts_lists;
mod sheet_layouts;
mod sheet_lengths;
mod sheet_texts;
mod technical_sheets;
