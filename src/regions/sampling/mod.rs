//! Lattice: facet, light and stroke direction at evenly spaced points of the page.
//!
//! 1. The face in front and its light are sampled at each lattice point (`page_lattice`).
//! 2. Directions follow the largest principal curvature or the light's gradient (`direction_field`).
//! 3. Wide flat faces get a fixed direction instead, since neighbours say nothing about them (`flat_faces`).
//!
//! Source of the principal directions: do Carmo, Differential Geometry of Curves and Surfaces, section 3.3.
//!
//! Files, in reading order: [`page_lattice`]; [`direction_field`]; [`flat_faces`].

pub(crate) mod direction_field;
mod flat_faces;
pub(crate) mod page_lattice;
