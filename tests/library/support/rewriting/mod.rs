//! Metamorphic tests: a random model gives the same drawing in every file format and encoding.
//!
//! 1. [`model`] makes a random scene of [`body`] values, built by [`shapes`]. Their coordinates are short, so
//!    the exact form is known.
//! 2. [`relations`] lists the ways to write the model. [`changes`] alters its faces.
//! 3. [`text_files`] and [`binary_files`] write files.
//! 4. [`trial`] reads both files with the library, draws them, and compares their lines by pen with [`pens`].
//! 5. [`table`] counts the drawings that differ; [`known`] lists the accepted differences.

mod binary_files;
pub(crate) mod body;
mod changes;
pub(crate) mod known;
pub(crate) mod model;
pub(crate) mod pens;
pub(crate) mod relations;
pub(crate) mod shapes;
pub(crate) mod table;
mod text_files;
pub(crate) mod trial;
