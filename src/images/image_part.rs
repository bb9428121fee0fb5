//! [`Part`]: the part of a picture that a view shows, as large as it is shown, and where its pieces lie on the page.

use glam::{DMat2, DVec2};
use kurbo::{Affine, BezPath, PathEl, Vec2};

use crate::colour::pixel_picture::Picture;
use crate::images::clusters::affine_fit::Affinity;
use crate::scene::textures::Imaged;

/// No more pixels of a picture are put into a drawing.
const MOST_PIXELS: f64 = 4_194_304.0;

/// Pixels around what is shown, for those that are mixed with their neighbours.
const MARGIN: f64 = 1.5;

/// A piece of the page on which one map brings the picture.
pub(crate) struct Mapped {
    pub outline: BezPath,
    map: Affinity,
    /// From the place where it shows the picture to where the same is seen first.
    shift: DVec2,
    low: DVec2,
    high: DVec2,
}

impl Mapped {
    /// A piece with this outline on the page, whose frame is moved by `offset`; the picture comes again after `periods`.
    pub fn new(outline: BezPath, map: Affinity, offset: Vec2, periods: [Option<f64>; 2]) -> Self {
        let points = outline.elements().iter().filter_map(PathEl::end_point);
        let places = points.map(|p| map.place(DVec2::new(p.x - offset.x, p.y - offset.y)));
        let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = places.fold(none, |(low, high), p| (low.min(p), high.max(p)));
        let shift =
            [0, 1].map(|axis| periods[axis].map_or(0.0, |period| -(low[axis] / period).floor() * period));
        Self { outline, map, shift: shift.into(), low, high }
    }
}

/// The part of a picture that a view shows.
pub(crate) struct Part {
    pub picture: Picture,
    /// In the plane of the texels, and pixels of the part in a texel.
    from: DVec2,
    scale: DVec2,
}

impl Part {
    /// With so many pixels in a texel, or fewer if there were too many; no farther than `reach` beyond the picture where
    /// that is not repeated. None if nothing is shown.
    pub fn of(imaged: &Imaged, pieces: &[Mapped], scale: f64, periods: [Option<f64>; 2]) -> Option<Self> {
        let mut low = DVec2::INFINITY;
        let mut high = DVec2::NEG_INFINITY;
        for piece in pieces {
            low = low.min(piece.low + piece.shift);
            high = high.max(piece.high + piece.shift);
        }
        let size = imaged.texels().size.map(|count| count as f64);
        for axis in 0..2 {
            if periods[axis].is_none() {
                low[axis] = low[axis].clamp(-size[axis] - 1.0, 2.0 * size[axis]);
                high[axis] = high[axis].clamp(-size[axis] - 1.0, 2.0 * size[axis]);
            }
        }
        let wide = high - low;
        if !wide.is_finite() {
            return None;
        }
        let pixels = (wide.x * scale + 2.0 * MARGIN) * (wide.y * scale + 2.0 * MARGIN);
        let scale = scale * (MOST_PIXELS / pixels).min(1.0).sqrt();
        // From the side of one texel to that of another one, which keeps them as they are.
        let margin = MARGIN / scale;
        let from = (low - margin + 0.5).floor() - 0.5;
        let to = (high + margin + 0.5).ceil() - 0.5;
        let count = ((to - from) * scale).round().max(DVec2::ONE).min(DVec2::splat(16_384.0));
        let picture = imaged.part(from, to, [count.x as usize, count.y as usize]);
        Some(Self { picture, from, scale: count / (to - from) })
    }

    /// What brings the pixels of the part to where a piece shows them.
    pub fn transform(&self, piece: &Mapped, offset: Vec2) -> Affine {
        let (page_from_place, origin) = piece.map.to_page();
        let matrix = page_from_place * DMat2::from_diagonal(DVec2::ONE / self.scale);
        let moved = page_from_place * (self.from - piece.shift) + origin;
        Affine::new([
            matrix.x_axis.x,
            matrix.x_axis.y,
            matrix.y_axis.x,
            matrix.y_axis.y,
            moved.x + offset.x,
            moved.y + offset.y,
        ])
    }
}
