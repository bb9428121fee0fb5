//! Pictures of a drawing as PDF objects: small ones whole, large ones in the parts that are shown.
//!
//! Many viewers decode a whole image object each time it is shown. A thousand pieces of one large picture
//! would take minutes.

use kurbo::{Affine, PathEl, Rect};
use rustc_hash::FxHashMap;

use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, ImagePaint, ImagePiece, PieceContent};
use crate::export::encoding::embedded_pictures::{EmbeddedPictures, marks};
use crate::geometry::space::morton_curve::spread;

/// Largest number of pixels of a picture written as a whole.
const MAX_WHOLE_PIXELS: usize = 1 << 18;

/// Longest side of a part in pixels, unless a single piece shows more.
const MAX_CROP_SIDE_PIXELS: f64 = 320.0;

/// Margin in pixels around a piece, for interpolation with neighbours.
const CROP_MARGIN_PIXELS: f64 = 2.0;

/// A part of a picture.
pub(crate) struct Crop<'a> {
    pub picture: &'a Picture,
    pub left: usize,
    pub top: usize,
    pub width: usize,
    pub height: usize,
    /// Whether the part is used in a mask; then only its opacity is written.
    pub is_mask: bool,
}

/// Parts of the pictures of a drawing.
#[derive(Default)]
pub(crate) struct Crops<'a> {
    pub list: Vec<Crop<'a>>,
    /// Contents of masks in the order of marks.
    pub masked: Vec<&'a ImagePaint>,
    /// Number and ink of the mask of a picture, by the address of its paint.
    inks: FxHashMap<usize, (usize, Colour)>,
    /// Number of the part shown by a piece, by the address of the piece.
    of_piece: FxHashMap<usize, usize>,
}

impl<'a> Crops<'a> {
    /// Divides the pictures of a drawing into parts.
    pub(crate) fn of(drawing: &'a Drawing) -> Self {
        let pictures = EmbeddedPictures::of(drawing);
        let mut shown: Vec<Vec<(usize, Rect)>> = vec![Vec::new(); pictures.list.len()];
        for (_, image) in marks(drawing) {
            let Some(list) = shown.get_mut(pictures.number(image)) else { continue };
            for piece in &image.pieces {
                if let PieceContent::Pixels(transform) = piece.shows {
                    list.push((address(piece), needed(piece, transform, &image.picture)));
                }
            }
        }
        let mut crops = Self::default();
        for (_, image) in marks(drawing) {
            if let Some(ink) = pictures.ink(image) {
                crops.inks.insert(std::ptr::from_ref(image).addr(), (crops.masked.len(), ink));
                crops.masked.push(image);
            }
        }
        for ((picture, mut pieces), ink) in pictures.list.iter().copied().zip(shown).zip(&pictures.inks) {
            let is_mask = ink.is_some();
            if picture.width * picture.height <= MAX_WHOLE_PIXELS {
                let full_rect = Rect::new(0.0, 0.0, picture.width as f64, picture.height as f64);
                crops.add((picture, is_mask), full_rect, &pieces);
                continue;
            }
            // Nearby parts of the picture follow each other. The sort is stable.
            pieces.sort_by_key(|(_, rect)| along_curve(rect));
            let mut rest = &pieces[..];
            while let Some(((_, first), later_pieces)) = rest.split_first() {
                let mut part = *first;
                let joins_crop = |(_, rect): &&(usize, Rect)| {
                    let wider = part.union(*rect);
                    let is_small =
                        wider.width() <= MAX_CROP_SIDE_PIXELS && wider.height() <= MAX_CROP_SIDE_PIXELS;
                    if is_small {
                        part = wider;
                    }
                    is_small
                };
                let count = 1 + later_pieces.iter().take_while(joins_crop).count();
                let (crop_pieces, remaining) = rest.split_at(count);
                crops.add((picture, is_mask), part, crop_pieces);
                rest = remaining;
            }
        }
        crops
    }

    /// Adds a part of a picture with the pieces that it contains.
    fn add(&mut self, (picture, is_mask): (&'a Picture, bool), part: Rect, pieces: &[(usize, Rect)]) {
        let [left, top] = [part.x0, part.y0].map(|low| low as usize);
        let (width, height) = ((part.width() as usize).max(1), (part.height() as usize).max(1));
        self.of_piece.extend(pieces.iter().map(|(piece, _)| (*piece, self.list.len())));
        self.list.push(Crop { picture, left, top, width, height, is_mask });
    }

    /// Number of the mask of a picture, and the ink it lets through; `None` without a mask.
    pub(crate) fn mask(&self, image: &ImagePaint) -> Option<(usize, Colour)> {
        self.inks.get(&std::ptr::from_ref(image).addr()).copied()
    }

    /// Number of the part that a piece shows, and the part.
    pub(crate) fn shown(&self, piece: &ImagePiece) -> Option<(usize, &Crop<'a>)> {
        let number = *self.of_piece.get(&address(piece))?;
        Some((number, self.list.get(number)?))
    }
}

impl Crop<'_> {
    /// Samples of each pixel, row by row.
    pub(crate) fn samples<T, const N: usize>(
        &self,
        of: impl Fn(crate::colour::srgb::Colour) -> [T; N],
    ) -> Vec<T> {
        let pixels = (0..self.width * self.height)
            .map(|k| self.picture.at(self.left + k % self.width, self.top + k / self.width));
        pixels.flat_map(of).collect()
    }

    /// Transform from the unit square of the image object, whose last row is at y = 0, to pixels of the
    /// picture.
    pub(crate) fn pixels_from_object(&self) -> Affine {
        let [width, height] = [self.width, self.height].map(|count| count as f64);
        let (left, bottom) = (self.left as f64, (self.top + self.height) as f64);
        Affine::new([width, 0.0, 0.0, -height, left, bottom])
    }
}

/// Address of a piece.
fn address(piece: &ImagePiece) -> usize {
    std::ptr::from_ref(piece).addr()
}

/// Bounding box of the pixels that a piece shows.
fn needed(piece: &ImagePiece, transform: Affine, picture: &Picture) -> Rect {
    let back = transform.inverse();
    let points = piece.outline.elements().iter().filter_map(PathEl::end_point).map(|p| back * p);
    let none = (f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
    let (x0, y0, x1, y1) =
        points.fold(none, |(x0, y0, x1, y1), p| (p.x.min(x0), p.y.min(y0), p.x.max(x1), p.y.max(y1)));
    let [width, height] = [picture.width, picture.height].map(|count| count as f64);
    let within = |low: f64, high: f64, most: f64| {
        let low = (low - CROP_MARGIN_PIXELS).floor().clamp(0.0, most - 1.0);
        (low, (high + CROP_MARGIN_PIXELS).ceil().clamp(low + 1.0, most))
    };
    if [x0, y0, x1, y1].iter().any(|x| !x.is_finite()) {
        return Rect::new(0.0, 0.0, width, height);
    }
    let ((left, right), (top, bottom)) = (within(x0, x1, width), within(y0, y1, height));
    Rect::new(left, top, right, bottom)
}

/// Position of a part's centre along a Z-order curve (Morton 1966), which keeps nearby parts together.
fn along_curve(part: &Rect) -> u64 {
    let middle = part.center();
    let place = |x: f64| spread(x as u64 & 0xffff);
    place(middle.x) | place(middle.y) << 1
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::drawing::{Layer, LayerKind, Mark, Page, Paint, Provenance, Unit};

    /// A drawing of a picture with `side` pixels per side, in squares of ten px.
    fn drawing_of_picture(side: usize) -> Drawing {
        let picture =
            Arc::new(Picture { width: side, height: side, pixels: vec![Colour::WHITE; side * side] });
        let square = |k: usize| {
            let (x, y) = ((k % 100) as f64 * 10.0, (k / 100) as f64 * 10.0);
            let outline = kurbo::Shape::to_path(&Rect::new(x, y, x + 10.0, y + 10.0), 0.1);
            ImagePiece { outline, shows: PieceContent::Pixels(Affine::scale(1000.0 / side as f64)) }
        };
        let paint = Paint::Image(ImagePaint { picture, pieces: (0..10_000).map(square).collect() });
        let mark = Mark { path: kurbo::BezPath::new(), paint, provenance: Provenance::default() };
        let layer = Layer { kind: LayerKind::Fills, pen: None, ordered: false, marks: vec![mark] };
        let page = Page { width: 1000.0, height: 1000.0, unit: Unit::Px, background: None };
        Drawing::new("", page, vec![layer])
    }

    #[test]
    fn large_pictures_are_split_into_crops_that_cover_their_pieces() {
        let small = drawing_of_picture(500);
        assert_eq!(Crops::of(&small).list.len(), 1);
        let large = drawing_of_picture(2000);
        let crops = Crops::of(&large);
        let all: usize = crops.list.iter().map(|crop| crop.width * crop.height).sum();
        assert!(crops.list.len() > 20 && all < 3 * 2000 * 2000, "{} parts of {all} pixels", crops.list.len());
        for (_, image) in marks(&large) {
            for piece in &image.pieces {
                let (_, crop) = crops.shown(piece).unwrap();
                let PieceContent::Pixels(transform) = piece.shows else { unreachable!() };
                let need = needed(piece, transform, &image.picture);
                let [left, top] = [crop.left as f64, crop.top as f64];
                let has = Rect::new(left, top, left + crop.width as f64, top + crop.height as f64);
                assert_eq!(has.union(need), has);
            }
        }
    }
}
