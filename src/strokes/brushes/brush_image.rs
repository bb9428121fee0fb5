//! The picture of a brush stroke, mapped along a line in affine pieces.

use std::sync::{Arc, Mutex, PoisonError};

use kurbo::{Affine, BezPath, Point};
use rustc_hash::FxHashMap;

use super::brush_strip::BrushStrip;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{ImagePiece, PieceContent};
use crate::geometry::plane::planar_distance::length;

/// Greatest error of the affine map of a piece, px.
const WARP_TOLERANCE_PX: f64 = 0.2;

/// Overlap of a piece with the next, px.
const PIECE_OVERLAP_PX: f64 = 1.0;

/// Greatest number of halvings of a copy.
const MAX_HALVINGS: u32 = 10;

/// One copy of a picture along a line.
pub(crate) struct ImageCopy<'a> {
    /// Map from brush space to the page. Whole numbers of x count copies; y runs across from -0.5 to 0.5.
    pub at: &'a dyn Fn(Point) -> Point,
    /// Index of the copy.
    pub number: usize,
    /// Length and width, user units.
    pub size: [f64; 2],
    /// Pixels of the picture along and across.
    pub pixels: [usize; 2],
    pub px: f64,
}

impl ImageCopy<'_> {
    /// The pieces of the copy, each with one affine map.
    pub(crate) fn pieces(&self) -> Vec<ImagePiece> {
        let mut pieces = Vec::new();
        self.cut([0.0, 1.0], 0, &mut pieces);
        pieces
    }

    fn cut(&self, [from, to]: [f64; 2], depth: u32, pieces: &mut Vec<ImagePiece>) {
        let map = self.map([from, to]);
        let far = |x: f64, y: f64| length(map * Point::new(x, y) - self.at(x, y));
        // The quarter points detect bends that the middle misses.
        let places = (0..=4).map(|k| from + (to - from) * f64::from(k) / 4.0);
        let miss = places.flat_map(|x| [far(x, -0.5), far(x, 0.5)]).fold(0.0, f64::max);
        if miss > WARP_TOLERANCE_PX * self.px && depth < MAX_HALVINGS {
            let middle = f64::midpoint(from, to);
            self.cut([from, middle], depth + 1, pieces);
            self.cut([middle, to], depth + 1, pieces);
            return;
        }
        let [columns, rows] = self.pixels.map(|count| count as f64);
        let from_pixels = Affine::new([1.0 / columns, 0.0, 0.0, 1.0 / rows, 0.0, -0.5]);
        // The picture is transparent past its last pixel. The last piece is stretched by the overlap, so that
        // no gap shows before the next copy or at the end of a closed line.
        let long = (1.0 + self.more()[0] - from) / (1.0 - from);
        let longer = if to < 1.0 { Affine::IDENTITY } else { Affine::scale_non_uniform(long, 1.0) };
        let longer = Affine::translate((from, 0.0)) * longer * Affine::translate((-from, 0.0));
        let shows = PieceContent::Pixels(map * longer * from_pixels);
        if map.determinant().abs() > 0.0 && map.is_finite() {
            pieces.push(ImagePiece { outline: self.outline([from, to]), shows });
        }
    }

    /// The affine map that best fits the true map at the corners of a stretch.
    fn map(&self, [from, to]: [f64; 2]) -> Affine {
        let [a, b] = [from, to].map(|x| self.at(x, -0.5));
        let [c, d] = [from, to].map(|x| self.at(x, 0.5));
        let along = ((b - a) + (d - c)) / 2.0 / (to - from);
        let across = ((c - a) + (d - b)) / 2.0;
        let middle = (a.to_vec2() + b.to_vec2() + c.to_vec2() + d.to_vec2()) / 4.0;
        let origin = middle - along * f64::midpoint(from, to);
        Affine::new([along.x, along.y, across.x, across.y, origin.x, origin.y])
    }

    /// Overlap along and across, in lengths and widths of the copy.
    fn more(&self) -> [f64; 2] {
        self.size.map(|size| PIECE_OVERLAP_PX * self.px / size.max(self.px))
    }

    /// A stretch of the band, slightly longer and wider. The outline of the whole line clips it.
    fn outline(&self, [from, to]: [f64; 2]) -> BezPath {
        let [more, wider] = self.more();
        let side = 0.5 + wider;
        let mut path = BezPath::new();
        path.move_to(self.at(from, -side));
        [(to + more, -side), (to + more, side), (from, side)]
            .into_iter()
            .for_each(|(x, y)| path.line_to(self.at(x, y)));
        path.close_path();
        path
    }

    fn at(&self, x: f64, y: f64) -> Point {
        (self.at)(Point::new(x + self.number as f64, y))
    }
}

/// Pictures of strips in their inks, cached so that each is made once.
#[derive(Default)]
pub(crate) struct StripPictures(Mutex<FxHashMap<StripPictureKey, Arc<Picture>>>);

/// Address of a strip, pixels of its picture, and ink.
type StripPictureKey = (usize, [usize; 2], [u8; 4]);

impl StripPictures {
    /// The picture of a strip with the given pixels, in an ink.
    pub(crate) fn of(&self, strip: &Arc<BrushStrip>, pixels: [usize; 2], ink: Colour) -> Arc<Picture> {
        let key = (Arc::as_ptr(strip).addr(), pixels, [ink.r, ink.g, ink.b, ink.a]);
        // A poisoned lock is safe: entries are complete or absent.
        let mut made = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(made.entry(key).or_insert_with(|| Arc::new(strip.picture(pixels, ink))))
    }
}
