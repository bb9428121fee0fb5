//! Shapes and meshes that the models are built from.
//!
//! Files, in reading order:
//! - [`solid`]: points and polygons of a shape.
//! - [`part`]: a named solid with a material.
//! - [`outline`]: 2-D outlines.
//! - [`polygon`]: triangulation of polygons with holes.
//! - [`sweep`]: prisms, turned solids and tubes.
//! - [`patches`]: Bézier patches.
//! - [`toothed_wheel`]: wheels with straight teeth.
//! - [`smooth_normals`]: normals split at sharp edges.

pub mod outline;
pub mod part;
pub mod patches;
mod polygon;
pub mod smooth_normals;
pub mod solid;
pub mod sweep;
pub mod toothed_wheel;
