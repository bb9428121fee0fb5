//! Drawings as files: a [`crate::drawing::Drawing`] as SVG, PDF, DXF, PNG or an animation.
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
//!
//! Folders, in reading order: `encoding` numbers, XML text, embedded pictures; `paths` canonical path
//! data; `svg`; `pdf`; `dxf`; `raster` PNG from the SVG text; `film` animations. PDF, PNG and animations
//! build on SVG, never the other way round.

pub(crate) mod dxf;
pub(crate) mod encoding;
#[cfg(feature = "film")]
pub(crate) mod film;
pub(crate) mod paths;
pub(crate) mod pdf;
pub(crate) mod raster;
pub(crate) mod svg;
mod tolerances;

#[cfg(feature = "pdf")]
pub use self::pdf::composition_pages::to_pdf;
#[cfg(feature = "pdf")]
pub use self::pdf::press::halftone_screen::Screen;
#[cfg(feature = "pdf")]
pub use self::pdf::press::pdf_options::{Inks, PdfOptions, Spot, Standard};
pub use dxf::{DxfLength, DxfOptions, DxfVersion};
#[cfg(feature = "film")]
pub use film::{ApngFilm, GifFilm, SvgFilm, WebpFilm};
#[cfg(feature = "png")]
pub use raster::png_drawing::{Pixels, PngOptions, Resolution};
pub use svg::svg_options::{Grouping, SvgOptions};
