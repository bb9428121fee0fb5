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
//! [`render()`] runs the whole pipeline, and each stage can be called alone (see `examples/`):
//!
//! 1. [`load`] reads a [`scene::Scene`]; [`mesh`] welds it to one [`mesh::Mesh`]; [`surface`] finds creases
//!    and the smooth surface that the mesh approximates.
//! 2. [`view`] projects the mesh. [`light`] lights the surface, [`shadows`] finds the borders of cast
//!    shadows, and [`lines`] finds feature lines, tone borders (isophotes) among them.
//! 3. [`visibility`] decides which pieces of all lines are visible: the [`visibility::ViewMap`].
//! 4. [`chains`] joins visible pieces end to end, and [`strokes`] gives them ink. [`regions`] and
//!    [`hatching`] fill the areas between visible lines.
//! 5. The result is a [`drawing::Drawing`], a 2-D document. [`export`] writes it as SVG, PDF, DXF or PNG.
//!
//! [`pipeline`] connects the stages and shares work between views. [`style`] sets their options. [`edit`]
//! and [`animation`] change a scene before it is drawn. [`animate`] draws frames, [`page`] composes comic
//! pages with balloons and technical sheets, and [`diff`] compares drawings. [`text`] sets letters,
//! [`images`] places pictures of materials, and [`motion`] draws motion lines. `cli` is the program.
//! `error`, `parallel`, `geometry` and `colour` are the base of all areas.
//!
//! ```
//! use ligne::lines::{self, LineKind, LineOptions, Surface};
//! use ligne::mesh::Mesh;
//! use ligne::view::View;
//! use ligne::{Camera, Scene, visibility};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let camera = Camera::three_quarter_of(scene.up).fit(&scene);
//! let options = LineOptions::default();
//! let surface = Surface::new(Mesh::build(scene.to_soup()), &options).finer_for(&camera);
//! let view = View::new(&surface.mesh, &camera);
//! let lines = lines::extract(&surface, &view, &options);
//! let map = visibility::build(&surface.mesh, &view, &lines, &options);
//! let visible = map.edges.iter().filter(|edge| edge.invisibility == 0);
//! assert!(visible.clone().count() > 100 && visible.clone().any(|edge| edge.kind == LineKind::Crease));
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! # Deliberately absent
//!
//! - No trait for stages: a stage is a function `(&inputs, &options) -> output`, and each exists once.
//! - No plug-ins: styles are data (see [`style`]).
//! - No generic scalar: geometry is `f64`. `f32` may propose, but never decides.
//! - No scene graph: instances are flattened to one mesh that stores part and material of each face.
//! - No half-edge pointers: ids into arrays.
//! - No dynamic dispatch: closed sets are enums.
//! - No async.
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::unwrap_used)]
// Heads of modules list their files. Many are private.
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
