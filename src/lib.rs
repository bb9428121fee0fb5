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
//! let style = Style::load("ink", &[])?;
//! let drawing = render(&scene, &camera, &style)?;
//! let svg = drawing.to_svg(&SvgOptions::default());
//! # assert!(svg.contains("class=\"contour silhouette\""));
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! The pipeline is one function, [`render()`]: a [`scene::Scene`] is flattened to one
//! welded [`mesh::Mesh`]; a [`view::View`] projects it; [`lines`] finds the feature lines; the
//! [`visibility::ViewMap`] decides what is visible; [`chains`] links the pieces to long chains;
//! [`strokes`] gives them ink; and the result is a [`drawing::Drawing`], a 2-D document that
//! [`export`] writes as SVG, PDF or PNG. Where a style paints surfaces, [`light`] lights them, their
//! tone borders join the lines, and [`regions`] gathers what lies between those that are seen; [`hatching`] shades
//! it with strokes. Many views
//! of one scene share a [`pipeline::Prepared`]. Each stage can be called by itself; the programs in
//! `examples/` show how.
//!
//! # Decisions not taken
//!
//! - No trait for stages: a stage is a function `(&inputs, &options) -> output`; there is one of each.
//! - No plug-ins: styles are data (see [`style`]).
//! - No generic scalar: geometry is `f64` throughout, `f32` only where it may propose, never decide.
//! - No scene graph: instances are flattened to one mesh that remembers part and material.
//! - No half-edge pointers: ids into arrays.
//! - No dynamic dispatch: closed sets are enums.
//! - No async.
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::unwrap_used)]
// Heads of modules list their files, of which many are private.
#![allow(rustdoc::private_intra_doc_links)]

pub mod animate;
pub mod animation;
pub mod chains;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
pub mod colour;
#[cfg(feature = "diff")]
pub mod diff;
pub mod drawing;
pub mod edit;
mod error;
pub mod export;
#[doc(hidden)]
pub mod geometry;
pub mod hatching;
pub mod images;
pub mod light;
pub mod lines;
pub mod load;
pub mod mesh;
pub mod motion;
#[cfg(feature = "page")]
pub mod page;
mod parallel;
pub mod pipeline;
pub mod regions;
pub mod scene;
pub mod shadows;
pub mod strokes;
pub mod style;
pub mod surface;
#[cfg(feature = "diff")]
pub mod testing;
#[cfg(feature = "page")]
pub mod text;
pub mod view;
pub mod visibility;

pub use colour::srgb::Colour;
pub use drawing::Drawing;
pub use error::{Error, ErrorKind};
#[cfg(feature = "png")]
pub use export::PngOptions;
pub use export::SvgOptions;
pub use pipeline::render;
pub use scene::{Camera, Scene};
pub use style::Style;

/// Vectors and matrices of models, as they stand in this library's types.
pub use glam;
/// Curves of drawings, as they stand in this library's types.
pub use kurbo;

/// The README's code, compiled and run with the doc tests.
#[cfg(all(doctest, feature = "cli"))]
#[doc = include_str!("../README.md")]
struct Readme;

/// The code of the guide to the library, compiled and run with the doc tests.
#[cfg(all(doctest, feature = "cli", feature = "pdf"))]
#[doc = include_str!("../docs/how-to/library.md")]
struct LibraryGuide;
