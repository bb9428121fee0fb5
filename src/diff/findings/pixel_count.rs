//! Count of the pixels that differ between two drawings on white, for `--pixels`.

use resvg::tiny_skia::{Pixmap, Transform};
use serde::Serialize;

use crate::diff::markup::input_limits;
use crate::diff::raster_check::raster_cost;
use crate::diff::read::tagged_svg;
use crate::diff::shapes::picture::Picture;
use crate::export::raster::tree_painter;

/// Channel differences above this are visible. Borders are blended slightly differently.
const MIN_VISIBLE_DIFFERENCE: u8 = 24;
/// Most pixels of the longer side; larger drawings are scaled down.
const MAX_SIDE_PIXELS: f64 = 4000.0;

/// Number of pixels that look different.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct PixelDiff {
    /// Width of both rasters in pixels.
    pub width: u32,
    /// Height of both rasters in pixels.
    pub height: u32,
    /// Number of pixels that look different.
    pub differing: u64,
    /// Largest difference of a channel, 0 to 255.
    pub largest: u8,
}

impl PixelDiff {
    /// Whether no pixel looks different.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.differing == 0
    }

    /// The count in words.
    pub(crate) fn words(&self) -> String {
        match self.differing {
            0 => "no pixel differs".to_owned(),
            1 => "1 pixel differs".to_owned(),
            count => format!("{count} pixels differ"),
        }
    }
}

/// Compares the pixels of two drawings; `None` if one would take too long to rasterise.
pub(crate) fn compare(before: &Picture, after: &Picture) -> Option<PixelDiff> {
    let (width, height) = (before.width.max(after.width), before.height.max(after.height));
    raster_cost::scale([before, after], [width, height])?;
    let scale = (MAX_SIDE_PIXELS / width.max(height)).min(1.0);
    let (columns, rows) = ((width * scale).ceil() as u32, (height * scale).ceil() as u32);
    let a = rasterise(before, columns, rows, scale)?;
    let b = rasterise(after, columns, rows, scale)?;
    let mut found = PixelDiff { width: columns, height: rows, differing: 0, largest: 0 };
    for (a, b) in a.data().chunks_exact(4).zip(b.data().chunks_exact(4)) {
        let largest = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
        found.largest = found.largest.max(largest);
        found.differing += u64::from(largest > MIN_VISIBLE_DIFFERENCE);
    }
    Some(found)
}

/// The drawing on white.
fn rasterise(picture: &Picture, columns: u32, rows: u32, scale: f64) -> Option<Pixmap> {
    let options = usvg::Options {
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: usvg::ImageHrefResolver::default_data_resolver(),
            // Do not read files.
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    };
    let markup = tagged_svg::rewrite(&input_limits::parse(&picture.svg).ok()?, false).ok()?;
    let tree = usvg::Tree::from_str(&markup.svg, &options).ok()?;
    let mut pixmap = Pixmap::new(columns, rows)?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    let scale = scale as f32;
    tree_painter::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Some(pixmap)
}
