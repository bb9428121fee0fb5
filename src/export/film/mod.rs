//! Animations: frames as one file, an animated SVG, GIF, PNG or WebP.
//!
//! Each writer receives the frames one by one, each with the number of ticks for which it is shown. The
//! number of ticks per second is a property of the film. All films repeat forever.
//!
//! ```
//! use ligne::export::{GifFilm, PngOptions, SvgFilm, SvgOptions};
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
//!
//! Files, in reading order: `frame_clock` frame times without accumulated rounding; `frame_difference`
//! the changed rectangle of a frame; `gif_film` with `palette`; `apng_film`; `webp_film`;
//! `svg_film` with `frame_tokens` (lines of text as numbers) and `path_runs` (paths that always follow
//! each other).

mod apng_film;
mod frame_clock;
mod frame_difference;
mod frame_tokens;
mod gif_film;
mod palette;
mod path_runs;
mod svg_film;
mod webp_film;

pub use apng_film::ApngFilm;
pub use gif_film::GifFilm;
pub use svg_film::SvgFilm;
pub use webp_film::WebpFilm;
