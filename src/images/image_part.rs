//! [`ImagePart`]: the part of a picture that a view shows, resampled to the size it is shown in, and where its
//! pieces are on the page.

use glam::{DMat2, DVec2};
use kurbo::{Affine, BezPath, PathEl, Vec2};

use crate::colour::pixel_picture::Picture;
use crate::images::clusters::affine_fit::AffineFit;
use crate::scene::textures::EmbeddedTexture;

/// Largest number of pixels of a picture in a drawing.
const MAX_PIXELS: f64 = 4_194_304.0;

/// Margin around the shown part for interpolation between neighbours, pixels.
const MARGIN_PIXELS: f64 = 1.5;

/// Piece of the page that one affine map covers.
pub(crate) struct MappedPiece {
    pub outline: BezPath,
    map: AffineFit,
    /// Offset from the place it shows to the first repetition of the picture, texels.
    shift: DVec2,
    low: DVec2,
    high: DVec2,
}

impl MappedPiece {
    /// Piece with this outline on the page, with the frame shifted by `offset`. The picture repeats after
    /// `periods`.
    pub(crate) fn new(outline: BezPath, map: AffineFit, offset: Vec2, periods: [Option<f64>; 2]) -> Self {
        let points = outline.elements().iter().filter_map(PathEl::end_point);
        let places = points.map(|p| map.place(DVec2::new(p.x - offset.x, p.y - offset.y)));
        let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = places.fold(none, |(low, high), p| (low.min(p), high.max(p)));
        let shift =
            [0, 1].map(|axis| periods[axis].map_or(0.0, |period| -(low[axis] / period).floor() * period));
        Self { outline, map, shift: shift.into(), low, high }
    }
}

/// Part of a picture that a view shows.
pub(crate) struct ImagePart {
    pub picture: Picture,
    /// Origin in the plane of the texels, and pixels per texel.
    from: DVec2,
    scale: DVec2,
}

impl ImagePart {
    /// Resamples the shown part with `scale` pixels per texel, or fewer where the picture would be too large.
    /// Without repetition, it reaches at most one picture size past each edge. `None` if nothing is shown.
    pub(crate) fn of(
        imaged: &EmbeddedTexture,
        pieces: &[MappedPiece],
        scale: f64,
        periods: [Option<f64>; 2],
    ) -> Option<Self> {
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
        let pixels = (wide.x * scale + 2.0 * MARGIN_PIXELS) * (wide.y * scale + 2.0 * MARGIN_PIXELS);
        let scale = scale * (MAX_PIXELS / pixels).min(1.0).sqrt();
        // The bounds are borders of texels, which keeps texels unchanged at full scale.
        let margin = MARGIN_PIXELS / scale;
        let from = (low - margin + 0.5).floor() - 0.5;
        let to = (high + margin + 0.5).ceil() - 0.5;
        let count = ((to - from) * scale).round().max(DVec2::ONE).min(DVec2::splat(16_384.0));
        let picture = imaged.part(from, to, [count.x as usize, count.y as usize]);
        Some(Self { picture, from, scale: count / (to - from) })
    }

    /// Transform from pixels of the part to the page, for one piece.
    pub(crate) fn transform(&self, piece: &MappedPiece, offset: Vec2) -> Affine {
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
