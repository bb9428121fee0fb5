//! **ligne** turns a 3D model into a vector drawing: ink lines with exact hidden-line removal, flat
//! colour under them, and hatching.
//!
#![doc = include_str!("../docs/pictures/gear.svg")]
//!
//! Five lines draw a model:
//!
//! ```
//! use ligne::{Camera, Scene, Style, SvgOptions, render};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let camera = Camera::three_quarter_of(scene.up).fit(&scene);
//! let style = Style::load("ink")?;
//! let drawing = render(&scene, &camera, &style)?;
//! let svg = drawing.to_svg(&SvgOptions::default());
//! # assert!(svg.contains("class=\"contour silhouette\""));
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! # Modules
//!
//! | module | for |
//! | --- | --- |
//! | [`scene`], [`load`] | models: read from files, or built from parts; cameras |
//! | [`edit`] | sections, exploded views, simplification |
//! | [`style`] | built-in styles, style sheets, pens chosen by a function |
//! | [`pipeline`] | many views of one scene, progress; mesh, lines, visibility and chains on their own |
//! | [`drawing`], [`export`] | the 2-D result; SVG, PDF, DXF, PNG and films |
//! | [`animation`], [`animate`] | clips of the model, frames, turntables |
//! | `page`, `text` | comic pages and technical sheets from a file; letters |
//! | `diff`, `testing` | comparison of drawings; approved drawings in tests |
//!
//! # Features
//!
//! All are on by default. Without any, the library reads OBJ, glTF, STL and PLY, writes SVG and DXF, and runs in
//! WebAssembly.
//!
//! | feature | adds |
//! | --- | --- |
//! | `png`, `pdf` | these formats; brushes that are SVG files need `png` |
//! | `film` | animated SVG, GIF, PNG and WebP |
//! | `diff` | [`diff`] and [`testing`] |
//! | `page` | [`page`] and [`text`] |
//! | `draco` | glTF files with Draco compression |
//! | `cli` | the program `ligne`; with `diff`, `film` and `page` |
//!
//! Geometry is `f64`. The same input gives the same bytes on every machine and any number of threads.
#![forbid(unsafe_code)]
#![warn(missing_docs, unreachable_pub, clippy::unwrap_used)]
// Without all features, some private items have no user.
#![cfg_attr(
    not(all(feature = "cli", feature = "png", feature = "pdf", feature = "draco")),
    allow(dead_code, unreachable_pub, unused_imports)
)]
// Heads of modules list their files. Many are private.
#![allow(rustdoc::private_intra_doc_links)]

pub mod animate;
pub mod animation;
mod chains;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
mod colour;
#[cfg(feature = "diff")]
pub mod diff;
pub mod drawing;
pub mod edit;
mod error;
pub mod export;
mod geometry;
mod hatching;
mod images;
#[doc(hidden)]
pub mod internals;
mod light;
mod lines;
pub mod load;
mod mesh;
mod motion;
#[cfg(feature = "page")]
pub mod page;
mod parallel;
pub mod pipeline;
mod regions;
pub mod scene;
mod shadows;
mod strokes;
pub mod style;
mod surface;
#[cfg(feature = "diff")]
pub mod testing;
#[cfg(feature = "page")]
pub mod text;
mod view;
mod visibility;

pub use colour::srgb::Colour;
pub use drawing::Drawing;
pub use error::{Error, ErrorKind};
#[cfg(feature = "png")]
pub use export::PngOptions;
pub use export::SvgOptions;
pub use pipeline::render;
pub use scene::{Camera, Scene};
pub use style::Style;

/// Vectors and matrices of models, used in the types of this library.
pub use glam;
/// Curves of drawings, used in the types of this library.
pub use kurbo;

/// The README's code, compiled and run with the doc tests.
#[cfg(all(doctest, feature = "cli"))]
#[doc = include_str!("../README.md")]
struct Readme;

/// The code of the guide to the library, compiled and run with the doc tests.
#[cfg(all(doctest, feature = "cli", feature = "pdf"))]
#[doc = include_str!("../docs/how-to/library.md")]
struct LibraryGuide;

/// Lets tests name the crate as users do.
#[cfg(test)]
extern crate self as ligne;

/// The tests of the library, compiled into the crate so that they reach private stages.
#[cfg(all(test, feature = "cli", feature = "pdf", feature = "draco"))]
#[allow(clippy::unwrap_used)]
#[path = "../tests/library/mod.rs"]
mod library;
