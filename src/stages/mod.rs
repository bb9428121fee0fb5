//! The stages of the pipeline, each a function `(&inputs, &options) -> output` that can be called by itself.
//!
//! [`crate::render()`] calls them all. Whoever calls them alone gets what lies between a model and its drawing:
//!
//! ```
//! use ligne::stages::lines::{self, LineKind, LineOptions, Surface};
//! use ligne::stages::mesh::Mesh;
//! use ligne::stages::view::View;
//! use ligne::stages::viewmap;
//! use ligne::{Camera, Scene};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let camera = Camera::three_quarter_of(scene.up).fit(&scene);
//! let options = LineOptions::default();
//! let surface = Surface::new(Mesh::build(scene.to_soup()), &options).finer_for(&camera);
//! let view = View::new(&surface.mesh, &camera);
//! let lines = lines::extract(&surface, &view, &options);
//! let map = viewmap::build(&surface.mesh, &view, &lines, &options);
//! let seen = map.edges.iter().filter(|edge| edge.invisibility == 0);
//! assert!(seen.clone().count() > 100 && seen.clone().any(|edge| edge.kind == LineKind::Crease));
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! What these modules hold is the inside of the library: it changes more often than what stands outside.

pub mod chain;
pub mod field;
pub mod hatch;
pub mod lines;
pub mod mesh;
pub mod picture;
pub mod raster;
pub mod region;
pub mod shadow;
pub mod shape;
pub mod stroke;
pub mod trees;
pub mod view;
pub mod viewmap;
