//! Bytes: a [`crate::drawing::Drawing`] as SVG, PDF or PNG.

mod attributes;
pub(crate) mod canonical;
pub(crate) mod number;
pub(crate) mod order;
mod path_data;
pub mod pdf;
mod pdf_content;
pub mod png;
pub mod svg;
pub(crate) mod xml;

pub use png::{PngOptions, Resolution};
pub use svg::{Grouping, SvgOptions};
