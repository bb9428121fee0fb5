//! Random models written in many ways that must all give the same drawing.
//!
//! 1. [`model`] makes a random scene of [`body`] values with short coordinates, so its exact form is known, and places it in the
//!    world.
//! 2. [`relations`] lists the ways to write it; [`changes`] alters its faces, [`text_files`] and [`binary_files`] write it.
//! 3. [`trial`] reads both files with the library, draws them, and compares the lines [`pens`] by pen.
//! 4. [`table`] counts the drawings that differ.

mod binary_files;
pub mod body;
mod changes;
pub mod known;
pub mod model;
pub mod pens;
pub mod relations;
pub mod shapes;
pub mod table;
mod text_files;
pub mod trial;
