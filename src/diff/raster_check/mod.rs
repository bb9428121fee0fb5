//! Comparison of two drawings by their pixels.
//!
//! 1. [`raster_cost`] chooses a scale that keeps the work within bounds.
//! 2. [`canvas`] rasterises both drawings with exact coverage, without the aspects to be ignored.
//! 3. [`pixel_comparison`] compares each pixel. The threshold is the colour that an edge shifted by less than
//!    the tolerance adds to a pixel.
//! 4. [`explained_pixels`] marks the pixels near findings of geometry. The other pixels that differ are
//!    candidates.
//! 5. Each candidate is rasterised again without anti-aliasing, at four pixels per tolerance. It differs if a
//!    spot as wide as the tolerance has no pixel of similar colour within the tolerance in the other drawing.
//! 6. Candidates that differ become findings with place, area and colours.
//! 7. Without such candidates, the pixels near findings are checked the same way. If none differs, the
//!    drawings look the same, and only findings that no picture shows are kept ([`invisible_findings`]).
//!
//! [`window_extremes`] computes sliding minima and maxima in linear time.

mod canvas;
mod explained_pixels;
mod invisible_findings;
mod pixel_comparison;
pub(crate) mod raster_cost;
mod window_extremes;

use self::canvas::{Canvas, CanvasWindow};
use self::explained_pixels::ExplainedPixels;
pub(crate) use self::invisible_findings::without_picture;
use self::pixel_comparison::FineComparison;
use super::tolerances::{MAX_PICTURE_MATCH_PX, MIN_PICTURE_DIFFERENCE_PX};
use crate::diff::findings::finding::Finding;
use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::mark_groups::MarkGroups;
use crate::diff::shapes::picture::Picture;

/// Most pixels rasterised in close inspection, for each of its two uses.
const MAX_CLOSE_PIXELS: usize = 64_000_000;
/// After this many differing tiles, the other candidates are accepted without inspection.
const MAX_PROVEN_TILES: usize = 48;

/// Result of comparing the pixels.
pub(crate) enum RasterVerdict {
    /// The pictures look the same.
    Same,
    /// The pictures differ, with findings for differences that geometry did not explain.
    Differs(Vec<Finding>),
    /// The pictures cannot be compared, because one takes too long to rasterise.
    Unknown,
}

/// Compares the pixels of two drawings, given the findings of geometry.
pub(crate) fn decide(
    pictures: [&Picture; 2],
    findings: &[Finding],
    groups: &MarkGroups,
    ignore: Ignore,
) -> RasterVerdict {
    let [width, height] =
        [pictures[0].width.min(pictures[1].width), pictures[0].height.min(pictures[1].height)];
    let outlined = pictures.iter().any(|picture| picture.shapes.iter().any(|shape| shape.ink.outlined));
    if ignore.widths && outlined {
        // The outline of a line of varying width cannot be drawn without its width.
        return RasterVerdict::Unknown;
    }
    let Some(scale) = raster_cost::scale(pictures, [width, height]) else { return RasterVerdict::Unknown };
    let canvases = pictures.map(|picture| Canvas::new(picture, ignore));
    let (columns, rows) = ((width * scale).ceil() as usize, (height * scale).ceil() as usize);
    let (a, b) = crate::parallel::join(
        || canvases[0].coarse(columns, rows, scale),
        || canvases[1].coarse(columns, rows, scale),
    );
    let (Some(a), Some(b)) = (a, b) else { return RasterVerdict::Unknown };
    // Marks with their own tolerances may have moved by the largest of these.
    let tolerances = || groups.groups.iter().map(|group| group.tolerance);
    let widest = tolerances().fold(MIN_PICTURE_DIFFERENCE_PX, f64::max);
    let finest = tolerances().fold(MAX_PICTURE_MATCH_PX, f64::min);
    let coarse = pixel_comparison::coarse([&a, &b], columns, widest * scale);
    // A flat colour that changed at all is another colour.
    let faint = explained_pixels::is_recoloured(findings, &coarse, columns, scale);
    if !coarse.has_any() {
        return if faint { RasterVerdict::Differs(Vec::new()) } else { RasterVerdict::Same };
    }
    let places = ExplainedPixels::new(findings, pictures, columns, rows, scale);
    let mut unexplained = Vec::new();
    let mut close = CloseInspection { canvases: &canvases, scale, pixels: 0 };
    for tile in places.candidates(&coarse, false) {
        let believed = unexplained.len() >= MAX_PROVEN_TILES;
        if believed || tile.pixels.iter().any(|at| close.differs(*at, widest, true).unwrap_or(true)) {
            unexplained.push(tile);
        }
    }
    if !unexplained.is_empty() {
        return RasterVerdict::Differs(places.findings(&unexplained, [&a, &b]));
    }
    if faint {
        return RasterVerdict::Differs(Vec::new());
    }
    if !places.has_claims() {
        return RasterVerdict::Same;
    }
    close.pixels = 0;
    let claimed = places.candidates(&coarse, true);
    let differs = |tile: &explained_pixels::CandidateTile, close: &mut CloseInspection| {
        tile.pixels.iter().any(|at| close.differs(*at, finest, false).unwrap_or(true))
    };
    match claimed.iter().any(|tile| differs(tile, &mut close)) {
        true => RasterVerdict::Differs(Vec::new()),
        false => RasterVerdict::Same,
    }
}

/// Close inspection of pixels of the coarse pictures.
struct CloseInspection<'a> {
    canvases: &'a [Canvas<'a>; 2],
    scale: f64,
    /// Number of pixels rasterised so far.
    pixels: usize,
}

impl CloseInspection<'_> {
    /// Whether a pixel differs; `None` if the pixel budget is used up. `spots`: whether only spots as wide as
    /// the tolerance count.
    fn differs(&mut self, [column, row]: [usize; 2], tolerance: f64, spots: bool) -> Option<bool> {
        let fine = FineComparison::new(self.scale, tolerance);
        let size = fine.core + 2 * fine.reach;
        self.pixels += size * size * 2;
        if self.pixels > MAX_CLOSE_PIXELS {
            return None;
        }
        let margin = fine.reach as f64 / fine.scale;
        let spot = CanvasWindow {
            x: column as f64 / self.scale - margin,
            y: row as f64 / self.scale - margin,
            size,
            scale: fine.scale,
        };
        let [a, b] = [0, 1].map(|side: usize| self.canvases[side].spot(spot));
        let (a, b) = (a?, b?);
        Some(fine.differs([&a, &b], spots))
    }
}
