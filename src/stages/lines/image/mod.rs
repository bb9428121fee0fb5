//! Lines that are found in the image: where maps of normals and depth jump from pixel to pixel, whatever the mesh is like.
//!
//! Two tests say which pixels are edges, one file a paper: [`gradient`] and [`opposite`]. Lines run between pixels, where most
//! jumps; each is then the shortest curve that has the pixels on its two sides there.

mod around;
mod crest;
pub mod dilate;
pub mod gradient;
mod jump_map;
mod jumps;
mod lattice;
pub mod loose;
mod mend;
pub mod opposite;
pub mod options;
mod paths;
mod sides;
mod taut;
mod trace;

pub use loose::Loose;
pub use options::{Dilation, EdgeTest, ImageOptions, Source};
pub use trace::{ImageLines, ImagePiece, ImagePoint, trace};

use crate::raster::Maps;

/// Which pixels of the maps are edges by the test that the options name, row after row.
#[must_use]
pub fn edges(maps: &Maps, options: &ImageOptions) -> Vec<bool> {
    match options.test {
        EdgeTest::Gradient => gradient::edges(maps, options),
        EdgeTest::Opposite => opposite::edges(maps, options),
    }
}
