//! The finished results of a view: drawing, hotspots and maps.
//!
//! 1. Paper, fills, lines and tooth are stacked into layers, and the report is filled in ([`view_drawing`]).
//! 2. [`hotspots`] gives the visible outline of each part.
//! 3. [`map_files`] writes the maps for finding image lines as PNG files.
//!
//! Files, in reading order: [`view_drawing`]; [`hotspots`]; [`map_files`].

pub(crate) mod hotspots;
pub(crate) mod map_files;
mod view_drawing;
