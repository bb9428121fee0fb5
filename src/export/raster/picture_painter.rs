//! Rasterisation of marks that show pictures: each piece is sampled from the picture, or from a smaller copy
//! where it is minified.
//!
//! Source of the copies that are smaller along one axis only: Larson and Shah, "Texture mapping with
//! ripmaps", 1990. Their pixels are area averages of the picture.

use std::collections::hash_map::Entry;

use kurbo::{Affine, BezPath, PathEl};
use rustc_hash::FxHashMap;
use tiny_skia::{
    BlendMode, FillRule, FilterQuality, IntRect, Mask, Path, PathBuilder, Pattern, Pixmap, PixmapPaint,
    PremultipliedColorU8, SpreadMode, Transform,
};

use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{ImagePaint, PieceContent};
use crate::export::encoding::embedded_pictures::address;

/// Ratio of sizes of consecutive copies. A pixel of the selected copy is 0.7 to 1 px of the drawing long.
const COPY_SCALE_STEP: f64 = std::f64::consts::SQRT_2;

/// Most steps: the square root of two to this power exceeds the size of any picture.
const MAX_STEPS: u32 = 30;

/// Largest minification without a smaller copy: rounding of a scale of one.
const SCALE_ROUNDING: f64 = 1.0001;

/// Paints the pieces of a picture inside an outline; `scale` transforms user units to pixels.
///
/// Where pieces overlap, the last one replaces those below, so that half-transparent ones do not add up.
pub(crate) fn paint(
    pixmap: &mut Pixmap,
    outline: &BezPath,
    image: &ImagePaint,
    scale: Transform,
    known: &mut CopyCache,
) {
    let Some((path, bounds)) = path(outline).and_then(|path| {
        let bounds = pixels_of(&path, scale, pixmap)?;
        Some((path, bounds))
    }) else {
        return;
    };
    let size = (bounds.width(), bounds.height());
    let Some((mut layer, mut mask)) = Pixmap::new(size.0, size.1).zip(Mask::new(size.0, size.1)) else {
        return;
    };
    let to_layer = scale.post_translate(-bounds.x() as f32, -bounds.y() as f32);
    mask.fill_path(&path, FillRule::Winding, true, to_layer);
    let copies = known.entry(address(&image.picture)).or_insert_with(|| PictureCopies::new(&image.picture));
    for piece in &image.pieces {
        let Some(outline) = self::path(&piece.outline) else { continue };
        let mut ink = tiny_skia::Paint { blend_mode: BlendMode::Source, ..tiny_skia::Paint::default() };
        match piece.shows {
            PieceContent::Colour(Colour { r, g, b, a }) => ink.set_color_rgba8(r, g, b, a),
            PieceContent::Pixels(transform) => {
                let Some((copy, grown)) = copies.for_pixels(page(scale) * transform) else { continue };
                let [a, b, c, d, e, f] = (transform * grown).as_coeffs().map(|value| value as f32);
                let to_page = Transform::from_row(a, b, c, d, e, f);
                let quality = FilterQuality::Bilinear;
                ink.shader = Pattern::new(copy.as_ref(), SpreadMode::Pad, quality, 1.0, to_page);
            }
        }
        layer.fill_path(&outline, &ink, FillRule::Winding, to_layer, None);
    }
    layer.apply_mask(&mask);
    let paint = PixmapPaint::default();
    pixmap.draw_pixmap(bounds.x(), bounds.y(), layer.as_ref(), &paint, Transform::identity(), None);
}

/// Bounding box of a path in pixels, clipped to the canvas.
fn pixels_of(path: &Path, scale: Transform, pixmap: &Pixmap) -> Option<IntRect> {
    let bounds = path.bounds().transform(scale)?;
    let whole = IntRect::from_xywh(0, 0, pixmap.width(), pixmap.height())?;
    let (left, top) = (bounds.left().floor() as i32, bounds.top().floor() as i32);
    let (right, bottom) = (bounds.right().ceil() as i32, bounds.bottom().ceil() as i32);
    IntRect::from_ltrb(left, top, right, bottom)?.intersect(&whole)
}

/// A transform of the rasteriser as an affine map.
fn page(scale: Transform) -> Affine {
    Affine::new([scale.sx, scale.ky, scale.kx, scale.sy, scale.tx, scale.ty].map(f64::from))
}

/// Copies of pictures painted so far, by the address of the picture.
pub(crate) type CopyCache = FxHashMap<usize, PictureCopies>;

/// A picture with copies that are smaller along one or both axes.
pub(crate) struct PictureCopies {
    whole: Option<Pixmap>,
    /// Copies by number of steps along each axis.
    smaller: FxHashMap<[u32; 2], Pixmap>,
}

impl PictureCopies {
    fn new(picture: &Picture) -> Self {
        let whole = Pixmap::new(picture.width as u32, picture.height as u32).map(|mut pixmap| {
            for (to, from) in pixmap.pixels_mut().iter_mut().zip(&picture.pixels) {
                *to = tiny_skia::ColorU8::from_rgba(from.r, from.g, from.b, from.a).premultiply();
            }
            pixmap
        });
        Self { whole, smaller: FxHashMap::default() }
    }

    /// The copy for a picture transformed to pixels by `to_pixels`, and the scale from the copy to the whole
    /// picture.
    fn for_pixels(&mut self, to_pixels: Affine) -> Option<(&Pixmap, Affine)> {
        let whole = self.whole.as_ref()?;
        // Length in picture pixels of one drawing pixel, along each axis of the picture.
        let [a, b, c, d, ..] = to_pixels.inverse().as_coeffs();
        let reaches = [(a * a + c * c).sqrt(), (b * b + d * d).sqrt()];
        let sides = [whole.width(), whole.height()];
        let steps = reaches.map(|mut reach| {
            let mut steps = 0;
            while reach > SCALE_ROUNDING && steps < MAX_STEPS {
                reach /= COPY_SCALE_STEP;
                steps += 1;
            }
            steps
        });
        if steps == [0, 0] {
            return Some((whole, Affine::IDENTITY));
        }
        let copy = match self.smaller.entry(steps) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                let size = [0, 1].map(|axis| {
                    let long =
                        (0..steps[axis]).fold(f64::from(sides[axis]), |long, _| long / COPY_SCALE_STEP);
                    (long.round() as u32).clamp(1, sides[axis])
                });
                new.insert(averaged(whole, size)?)
            }
        };
        let [x, y] = [(whole.width(), copy.width()), (whole.height(), copy.height())]
            .map(|(whole, copy)| f64::from(whole) / f64::from(copy));
        Some((copy, Affine::scale_non_uniform(x, y)))
    }
}

/// A smaller copy by area averages: first along rows, then along columns.
fn averaged(source: &Pixmap, [width, height]: [u32; 2]) -> Option<Pixmap> {
    let channels = |pixel: &PremultipliedColorU8| {
        [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()].map(f32::from)
    };
    let columns = shares(source.width(), width);
    let rows = shares(source.height(), height);
    let long = source.width() as usize;
    let mut copy = Pixmap::new(width, height)?;
    let mut sums = vec![[0.0_f32; 4]; long];
    for (line, row_weights) in copy.pixels_mut().chunks_exact_mut(width as usize).zip(&rows) {
        sums.fill([0.0; 4]);
        for (row, weight) in row_weights {
            let from = source.pixels().get(row * long..(row + 1) * long).unwrap_or_default();
            for (sum, pixel) in sums.iter_mut().zip(from) {
                sum.iter_mut().zip(channels(pixel)).for_each(|(sum, channel)| *sum += channel * weight);
            }
        }
        for (to, column_weights) in line.iter_mut().zip(&columns) {
            let mut mean = [0.0_f32; 4];
            for (column, weight) in column_weights {
                let from = sums.get(*column).copied().unwrap_or_default();
                mean.iter_mut().zip(from).for_each(|(mean, channel)| *mean += channel * weight);
            }
            let [r, g, b, a] = mean.map(|value| value.round() as u8);
            if let Some(pixel) = PremultipliedColorU8::from_rgba(r.min(a), g.min(a), b.min(a), a) {
                *to = pixel;
            }
        }
    }
    Some(copy)
}

/// For each of `to` longer intervals, the overlapping ones of `from` equal intervals with their weights.
fn shares(from: u32, to: u32) -> Vec<Vec<(usize, f32)>> {
    let long = f64::from(from) / f64::from(to);
    let of = |k: u32| {
        let (start, end) = (f64::from(k) * long, f64::from(k + 1) * long);
        let (first, last) = (start.floor() as u32, (end.ceil() as u32).min(from));
        let weight_of = |pixel_index: u32| {
            let overlap = end.min(f64::from(pixel_index + 1)) - start.max(f64::from(pixel_index));
            (pixel_index as usize, (overlap.max(0.0) / long) as f32)
        };
        (first..last).map(weight_of).collect()
    };
    (0..to).map(of).collect()
}

/// A path as a type of the rasteriser; `None` if it is empty.
pub(crate) fn path(outline: &BezPath) -> Option<Path> {
    let mut path = PathBuilder::new();
    for element in outline.elements() {
        let at = |p: kurbo::Point| (p.x as f32, p.y as f32);
        match *element {
            PathEl::MoveTo(p) => path.move_to(at(p).0, at(p).1),
            PathEl::LineTo(p) => path.line_to(at(p).0, at(p).1),
            PathEl::QuadTo(c, p) => path.quad_to(at(c).0, at(c).1, at(p).0, at(p).1),
            PathEl::CurveTo(c, d, p) => {
                path.cubic_to(at(c).0, at(c).1, at(d).0, at(d).1, at(p).0, at(p).1);
            }
            PathEl::ClosePath => path.close(),
        }
    }
    path.finish()
}
