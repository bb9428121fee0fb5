//! The files that a style sheet names: brushes, tiles, pictures.
//!
//! Each file has a `place_…` function, which makes paths relative to the folder of the sheet, and a reader.
//!
//! Files, in reading order:
//!
//! - `picture_file`: reads a picture, with errors that name its use.
//! - `artist_file`: pictures of artist lines.
//! - `svg_file`: the paths of an SVG file.
//! - `brush_file`: brushes from SVG files or pictures.
//! - `tile_file`: tiles of patterns from path data, SVG files or pictures.

pub(crate) mod artist_file;
pub(crate) mod brush_file;
pub(crate) mod picture_file;
mod svg_file;
pub(crate) mod tile_file;
