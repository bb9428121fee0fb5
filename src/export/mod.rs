//! Bytes: a [`crate::drawing::Drawing`] as SVG or PNG.

mod attributes;
mod number;
mod path_data;
pub mod png;
pub mod svg;
mod xml;

pub use png::{PngOptions, Resolution};
pub use svg::{Grouping, SvgOptions};
