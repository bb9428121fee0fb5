//! Files for other programs: DXF, canonical SVG, pages and press PDF.

mod canonical_form;
mod dxf_files;
mod page_command;
mod press_pdf;
