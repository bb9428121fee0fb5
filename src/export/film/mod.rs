//! Films: frames as one file, an animated SVG, GIF, PNG or WebP.
//!
//! Each writer is given the frames one by one, each with the number of ticks for which it is shown; a film has so many ticks
//! a second. All films begin again when they are over.
//!
//! ```
//! use ligne::export::film::{GifFilm, SvgFilm};
//! use ligne::export::{PngOptions, SvgOptions};
//! use ligne::scene::NamedView;
//! use ligne::{Camera, Scene, Style, render};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let mut moving = SvgFilm::new(12.0, &SvgOptions::default());
//! let mut pixels = GifFilm::new(Vec::new(), 12.0);
//! for view in [NamedView::Front, NamedView::Iso] {
//!     let camera = Camera::named(view, scene.up).with_frame(200.0, 200.0).fit(&scene);
//!     let drawing = render(&scene, &camera, &Style::default())?;
//!     moving.push(&drawing, 6);
//!     pixels.push(&drawing.to_pixels(&PngOptions::default())?, 6)?;
//! }
//! assert!(moving.finish().contains("<animate "));
//! assert!(pixels.finish()?.starts_with(b"GIF89a"));
//! # Ok::<(), ligne::Error>(())
//! ```

mod apng;
mod changed;
mod gif;
mod pace;
mod palette;
mod runs;
mod svg;
mod tokens;
mod webp;

pub use apng::ApngFilm;
pub use gif::GifFilm;
pub use svg::SvgFilm;
pub use webp::WebpFilm;
