//! The picture of a stroke itself, laid along a line in pieces.

use std::sync::{Arc, Mutex, PoisonError};

use kurbo::{Affine, BezPath, Point};
use rustc_hash::FxHashMap;

use super::brush_strip::Strip;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{ImagePiece, Shows};
use crate::geometry::plane::planar_distance::length;

/// How far a piece may show the picture beside its place, px.
const TOLERANCE_PX: f64 = 0.2;

/// How far pieces reach under those after them, px.
const REACH_PX: f64 = 1.0;

/// No copy of a picture is halved more often than this.
const MOST_HALVINGS: u32 = 10;

/// A copy of a picture on its way along a line.
pub(crate) struct Copy<'a> {
    /// From a brush to the page; x counts copies, y runs across from -0.5 to 0.5.
    pub at: &'a dyn Fn(Point) -> Point,
    /// Which copy it is.
    pub number: usize,
    /// How long and wide it is, user units.
    pub size: [f64; 2],
    /// The pixels of the picture along and across.
    pub pixels: [usize; 2],
    pub px: f64,
}

impl Copy<'_> {
    /// The pieces in which one affine map each brings the picture to the line.
    pub fn pieces(&self) -> Vec<ImagePiece> {
        let mut pieces = Vec::new();
        self.cut([0.0, 1.0], 0, &mut pieces);
        pieces
    }

    fn cut(&self, [from, to]: [f64; 2], depth: u32, pieces: &mut Vec<ImagePiece>) {
        let map = self.map([from, to]);
        let far = |x: f64, y: f64| length(map * Point::new(x, y) - self.at(x, y));
        // Quarters tell bends that the middle does not.
        let places = (0..=4).map(|k| from + (to - from) * f64::from(k) / 4.0);
        let miss = places.flat_map(|x| [far(x, -0.5), far(x, 0.5)]).fold(0.0, f64::max);
        if miss > TOLERANCE_PX * self.px && depth < MOST_HALVINGS {
            let middle = f64::midpoint(from, to);
            self.cut([from, middle], depth + 1, pieces);
            self.cut([middle, to], depth + 1, pieces);
            return;
        }
        let [columns, rows] = self.pixels.map(|count| count as f64);
        let from_pixels = Affine::new([1.0 / columns, 0.0, 0.0, 1.0 / rows, 0.0, -0.5]);
        // Past its last pixel a picture is clear: in the last piece it is as much longer as the piece is, so that no gap shows where
        // the next copy begins, or a closed line ends.
        let long = (1.0 + self.more()[0] - from) / (1.0 - from);
        let longer = if to < 1.0 { Affine::IDENTITY } else { Affine::scale_non_uniform(long, 1.0) };
        let longer = Affine::translate((from, 0.0)) * longer * Affine::translate((-from, 0.0));
        let shows = Shows::Pixels(map * longer * from_pixels);
        if map.determinant().abs() > 0.0 && map.is_finite() {
            pieces.push(ImagePiece { outline: self.outline([from, to]), shows });
        }
    }

    /// The affine map that is nearest to the true one at the corners of a stretch.
    fn map(&self, [from, to]: [f64; 2]) -> Affine {
        let [a, b] = [from, to].map(|x| self.at(x, -0.5));
        let [c, d] = [from, to].map(|x| self.at(x, 0.5));
        let along = ((b - a) + (d - c)) / 2.0 / (to - from);
        let across = ((c - a) + (d - b)) / 2.0;
        let middle = (a.to_vec2() + b.to_vec2() + c.to_vec2() + d.to_vec2()) / 4.0;
        let origin = middle - along * f64::midpoint(from, to);
        Affine::new([along.x, along.y, across.x, across.y, origin.x, origin.y])
    }

    /// How far pieces reach along and across, in lengths and widths of the copy.
    fn more(&self) -> [f64; 2] {
        self.size.map(|size| REACH_PX * self.px / size.max(self.px))
    }

    /// A stretch of the band, a little longer and wider: the outline of the whole line tells where its edges are.
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

/// The pictures of strokes in their inks, each made once.
#[derive(Default)]
pub(crate) struct StripPictures(Mutex<FxHashMap<Key, Arc<Picture>>>);

/// Where a strip lies in memory, the pixels of its picture, and its ink.
type Key = (usize, [usize; 2], [u8; 4]);

impl StripPictures {
    /// The picture of a strip of so many pixels in an ink.
    pub fn of(&self, strip: &Arc<Strip>, pixels: [usize; 2], ink: Colour) -> Arc<Picture> {
        let key = (Arc::as_ptr(strip).addr(), pixels, [ink.r, ink.g, ink.b, ink.a]);
        // Whoever panicked while it held the lock left nothing half done.
        let mut made = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(made.entry(key).or_insert_with(|| Arc::new(strip.picture(pixels, ink))))
    }
}
