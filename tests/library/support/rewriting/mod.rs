//! Metamorphic tests: a random model gives the same drawing in every file format and encoding.
//!
//! 1. [`model`] makes a random scene of [`body`] values, built by [`shapes`]. Their coordinates are short, so
//!    the exact form is known.
//! 2. [`relations`] lists the ways to write the model. [`changes`] alters its faces.
//! 3. [`text_files`] and [`binary_files`] write files.
//! 4. [`trial`] reads both files with the library, draws them, and compares their lines by pen with [`pens`].
//! 5. [`table`] counts the drawings that differ; [`known`] lists the accepted differences.

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
