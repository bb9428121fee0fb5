//! PDF: one drawing as a page, or pages of several drawings for screens, presses and archives.
//!
//! Source: ISO 32000-1 (PDF 1.7).
//!
//! 1. `document_content` collects layers and content segments of all pages.
//! 2. `content_stream` writes the painting operators of each segment, in parallel.
//! 3. Fonts, pictures, masks and gradients become objects (`fonts`, `picture_crops`, `soft_masks`,
//!    `paint_objects`).
//! 4. `resources` numbers and writes these objects, and names them for the pages. `composition_pages` writes
//!    the file.
//!
//! Also: `drawing_page` the short way for a single drawing; `press` inks, halftone screens and standards;
//! `halftone_fills` fills as dots; `page_boxes` trim, bleed and printer's marks; `pdf_streams` units
//! and compression.

#[cfg(feature = "pdf")]
pub(crate) mod composition_pages;
#[cfg(feature = "pdf")]
mod content_stream;
#[cfg(feature = "pdf")]
mod document_content;
#[cfg(feature = "pdf")]
pub(crate) mod drawing_page;
#[cfg(feature = "pdf")]
mod fonts;
#[cfg(feature = "pdf")]
mod halftone_fills;
#[cfg(feature = "pdf")]
mod page_boxes;
#[cfg(feature = "pdf")]
mod paint_objects;
#[cfg(feature = "pdf")]
mod pdf_streams;
#[cfg(feature = "pdf")]
mod picture_crops;
pub(crate) mod press;
#[cfg(feature = "pdf")]
mod resources;
#[cfg(feature = "pdf")]
mod soft_masks;
