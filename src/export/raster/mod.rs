//! PNG and pixels, rasterised from the SVG text of a drawing.
//!
//! 1. `png_drawing` computes the size in pixels and paints the runs of marks between pictures as SVG.
//! 2. `tree_painter` walks the parsed SVG. Paths of one colour use exact coverage; resvg paints the rest.
//! 3. `area_coverage` computes the exact area of a path inside each pixel (cells and a sweep along rows, as
//!    in FreeType).
//! 4. `picture_painter` paints pictures from averaged smaller copies (ripmaps).
//!
//! Also: `png_composition` pages of several drawings.

#[cfg(feature = "png")]
mod area_coverage;
#[cfg(feature = "png")]
mod picture_painter;
#[cfg(feature = "png")]
mod png_composition;
#[cfg(feature = "png")]
pub(crate) mod png_drawing;
#[cfg(feature = "png")]
pub(crate) mod tree_painter;
