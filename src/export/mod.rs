//! Bytes: a [`crate::drawing::Drawing`] as SVG, PDF or PNG.

mod attributes;
pub(crate) mod canonical;
pub(crate) mod number;
pub(crate) mod order;
mod path_data;
#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "pdf")]
mod pdf_content;
#[cfg(feature = "png")]
pub mod png;
pub mod svg;
pub(crate) mod xml;

#[cfg(feature = "png")]
pub use png::{PngOptions, Resolution};
pub use svg::{Grouping, SvgOptions};
