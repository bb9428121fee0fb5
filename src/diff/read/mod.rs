//! SVG files to shapes in px, with usvg.
//!
//! 1. `markup` parses the file and checks its limits.
//! 2. [`tagged_svg`] writes the file again: each shape gets an id, styles move to their elements, and texts
//!    and pictures become rectangles with their description.
//! 3. usvg resolves transforms, units, references and styles.
//! 4. [`svg_reader`] turns the tree into shapes, and finds each shape's label by its id.
//!
//! Also: [`inherited_context`] layer and part of an element; [`paint_description`] gradients and patterns as
//! text; [`unsupported_features`] contents of a file that are not compared.

mod inherited_context;
mod paint_description;
mod svg_reader;
pub(crate) mod tagged_svg;
mod unsupported_features;
