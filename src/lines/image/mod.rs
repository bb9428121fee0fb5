//! Image-space lines: where maps of normals and depth jump from pixel to pixel, for any mesh.
//!
//! 1. One of two tests marks the pixels that are edges (`edge_tests`, one file for each paper).
//! 2. Lines run along the cracks between pixels with the largest jump, by non-maximum suppression (`cracks`).
//! 3. Each line is the shortest curve that keeps its pixels on their two sides (`image_lines`).
//!
//! Files, in reading order: [`image_options`] the `[lines.image]` table; [`soup_normals`] normals of
//! unconnected faces; [`edge_tests`]; [`cracks`]; [`image_lines`]; [`ink_dilation`] wider lines in
//! `edges.png`.

mod cracks;
pub(crate) mod edge_tests;
mod image_lines;
pub(crate) mod image_options;
pub(crate) mod ink_dilation;
pub(crate) mod soup_normals;

pub(crate) use image_lines::{ImageLinePiece, ImageLines, ImagePoint, trace};
pub(crate) use image_options::{Dilation, EdgeTest, ImageOptions, Source};
pub(crate) use soup_normals::SoupNormals;

use crate::view::raster::NormalDepthMaps;

/// Edge flags of the maps' pixels by the test in the options, row by row.
#[must_use]
pub(crate) fn edges(maps: &NormalDepthMaps, options: &ImageOptions) -> Vec<bool> {
    match options.test {
        EdgeTest::Gradient => edge_tests::gradient_test::edges(maps, options),
        EdgeTest::Opposite => edge_tests::opposite_test::edges(maps, options),
    }
}
