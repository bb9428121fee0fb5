//! Marks that show pictures, painted on pixels: each piece from the picture, or from a smaller copy of it where it shrinks.
//!
//! Source: Williams, "Pyramidal parametrics", SIGGRAPH 1983.

use kurbo::{Affine, BezPath, PathEl};
use rustc_hash::FxHashMap;
use tiny_skia::{
    FillRule, FilterQuality, Mask, Path, PathBuilder, Pattern, Pixmap, PremultipliedColorU8, SpreadMode,
    Transform,
};

use super::pictures::address;
use crate::drawing::{ImagePaint, Shows};
use crate::math::colour::Colour;
use crate::math::picture::Picture;

/// A copy of half the size is taken where this many of its pixels still fall on one of the drawing's.
const LEAST_PIXELS: f64 = 0.75;

/// Paints the pieces of a picture inside an outline; `scale` leads from user units to pixels.
pub(super) fn paint(
    pixmap: &mut Pixmap,
    outline: &BezPath,
    image: &ImagePaint,
    scale: Transform,
    known: &mut KnownCopies,
) {
    let Some((outline, mut mask)) = path(outline).zip(Mask::new(pixmap.width(), pixmap.height())) else {
        return;
    };
    mask.fill_path(&outline, FillRule::Winding, true, scale);
    let copies = known.entry(address(&image.picture)).or_insert_with(|| Copies::new(&image.picture));
    for piece in &image.pieces {
        let Some(outline) = path(&piece.outline) else { continue };
        let mut ink = tiny_skia::Paint::default();
        match piece.shows {
            Shows::Colour(Colour { r, g, b, a }) => ink.set_color_rgba8(r, g, b, a),
            Shows::Pixels(transform) => {
                let area = transform.determinant().abs() * f64::from(scale.sx * scale.sy);
                let Some((copy, grown)) = copies.of_area(area) else { continue };
                let [a, b, c, d, e, f] = (transform * grown).as_coeffs().map(|value| value as f32);
                let to_page = Transform::from_row(a, b, c, d, e, f);
                let quality = FilterQuality::Bilinear;
                ink.shader = Pattern::new(copy.as_ref(), SpreadMode::Pad, quality, 1.0, to_page);
            }
        }
        pixmap.fill_path(&outline, &ink, FillRule::Winding, scale, Some(&mask));
    }
}

/// The copies of pictures that were painted before, by where the pictures lie in memory.
pub(super) type KnownCopies = FxHashMap<usize, Copies>;

/// A picture, and copies of it each half as wide and high as the one before.
pub(super) struct Copies(Vec<Pixmap>);

impl Copies {
    fn new(picture: &Picture) -> Self {
        let whole = Pixmap::new(picture.width as u32, picture.height as u32).map(|mut pixmap| {
            for (to, from) in pixmap.pixels_mut().iter_mut().zip(&picture.pixels) {
                *to = tiny_skia::ColorU8::from_rgba(from.r, from.g, from.b, from.a).premultiply();
            }
            pixmap
        });
        Self(whole.into_iter().collect())
    }

    /// The copy for pixels that are so large on the page, and what makes it as large as the whole.
    fn of_area(&mut self, area: f64) -> Option<(&Pixmap, Affine)> {
        let mut level = 0;
        // Each copy has a quarter of the pixels.
        while area * f64::from(1_u32 << (2 * level)) < LEAST_PIXELS * LEAST_PIXELS / 4.0 && level < 12 {
            level += 1;
        }
        while self.0.len() <= level {
            let last = self.0.last()?;
            if last.width() == 1 && last.height() == 1 {
                break;
            }
            let half = halved(last)?;
            self.0.push(half);
        }
        let (whole, copy) = (self.0.first()?, self.0.get(level).or(self.0.last())?);
        let [x, y] = [(whole.width(), copy.width()), (whole.height(), copy.height())]
            .map(|(whole, copy)| f64::from(whole) / f64::from(copy));
        Some((copy, Affine::scale_non_uniform(x, y)))
    }
}

/// A copy half as wide and high, the mean of four pixels each.
fn halved(pixmap: &Pixmap) -> Option<Pixmap> {
    let (width, height) = (pixmap.width(), pixmap.height());
    let mut half = Pixmap::new(width.div_ceil(2), height.div_ceil(2))?;
    let columns = half.width();
    for (k, to) in half.pixels_mut().iter_mut().enumerate() {
        let (column, row) = (k as u32 % columns * 2, k as u32 / columns * 2);
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(x, y)| pixmap.pixel((column + x).min(width - 1), (row + y).min(height - 1)));
        let mean = |channel: fn(PremultipliedColorU8) -> u8| {
            let sum: u32 = four.iter().flatten().map(|pixel| u32::from(channel(*pixel))).sum();
            ((sum + 2) / 4) as u8
        };
        let (r, g, b, a) = (
            mean(PremultipliedColorU8::red),
            mean(PremultipliedColorU8::green),
            mean(PremultipliedColorU8::blue),
            mean(PremultipliedColorU8::alpha),
        );
        if let Some(pixel) = PremultipliedColorU8::from_rgba(r.min(a), g.min(a), b.min(a), a) {
            *to = pixel;
        }
    }
    Some(half)
}

/// A path as the rasteriser has it; none if there is nothing of it.
pub(super) fn path(outline: &BezPath) -> Option<Path> {
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
