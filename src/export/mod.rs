//! Bytes: a [`crate::drawing::Drawing`] as SVG, PDF, DXF or PNG.
//!
//! ```
//! use ligne::{Camera, Scene, Style, SvgOptions, render};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let drawing = render(&scene, &Camera::three_quarter().fit(&scene), &Style::default())?;
//! let coarse = drawing.to_svg(&SvgOptions::default().with_precision(0));
//! assert!(coarse.len() < drawing.to_svg(&SvgOptions::default()).len());
//! # #[cfg(feature = "pdf")]
//! assert!(drawing.to_pdf().starts_with(b"%PDF"));
//! # Ok::<(), ligne::Error>(())
//! ```

mod attributes;
pub(crate) mod canonical;
pub mod dxf;
#[cfg(feature = "film")]
pub mod film;
#[cfg(feature = "cli")]
pub(crate) mod gzip;
mod hotspots;
pub(crate) mod number;
pub(crate) mod order;
mod part_groups;
mod path_data;
#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "pdf")]
mod pdf_content;
#[cfg(feature = "pdf")]
mod pdf_document;
#[cfg(feature = "pdf")]
mod pdf_dots;
#[cfg(feature = "pdf")]
mod pdf_fonts;
#[cfg(feature = "pdf")]
mod pdf_inks;
#[cfg(feature = "pdf")]
mod pdf_masks;
#[cfg(feature = "pdf")]
pub mod pdf_options;
#[cfg(feature = "pdf")]
pub mod pdf_pages;
#[cfg(feature = "pdf")]
mod pdf_paints;
#[cfg(feature = "pdf")]
mod pdf_pictures;
#[cfg(feature = "pdf")]
mod pdf_resources;
#[cfg(feature = "pdf")]
pub mod pdf_screen;
#[cfg(feature = "pdf")]
mod pdf_sheet;
#[cfg(feature = "pdf")]
mod pdf_standard;
mod pictures;
pub(crate) mod piece;
#[cfg(feature = "png")]
pub mod png;
#[cfg(feature = "png")]
mod png_composition;
#[cfg(feature = "png")]
mod png_coverage;
#[cfg(feature = "png")]
mod png_image;
#[cfg(feature = "png")]
pub(crate) mod png_tree;
pub mod svg;
mod svg_composition;
mod svg_image;
mod svg_options;
mod touching;
pub(crate) mod xml;

pub use dxf::{DxfLength, DxfOptions, DxfVersion};
#[cfg(feature = "pdf")]
pub use pdf_options::{Inks, PdfOptions, Spot, Standard};
#[cfg(feature = "pdf")]
pub use pdf_pages::to_pdf;
#[cfg(feature = "pdf")]
pub use pdf_screen::Screen;
#[cfg(feature = "png")]
pub use png::{Pixels, PngOptions, Resolution};
pub use svg_options::{Grouping, SvgOptions};
