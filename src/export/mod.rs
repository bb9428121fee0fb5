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
mod pdf_pictures;
mod pictures;
pub(crate) mod piece;
#[cfg(feature = "png")]
pub mod png;
#[cfg(feature = "png")]
mod png_composition;
#[cfg(feature = "png")]
mod png_image;
pub mod svg;
mod svg_composition;
mod svg_image;
mod touching;
pub(crate) mod xml;

pub use dxf::{DxfLength, DxfOptions, DxfVersion};
#[cfg(feature = "png")]
pub use png::{Pixels, PngOptions, Resolution};
pub use svg::{Grouping, SvgOptions};
