//! [`EmbeddedTexture`]: the texture of a material, for embedding in a drawing.

use glam::DVec2;

use super::texel_plane::TexelPlane;
use crate::colour::oklab::linear_table;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::{Colour, linear};
use crate::mesh::{MaterialId, PaintId};
use crate::scene::tolerances::MIN_TEXEL_SHARE;

/// The texture of a material, for embedding in a drawing.
#[derive(Debug, Clone)]
pub(crate) struct EmbeddedTexture {
    /// The material.
    pub material: MaterialId,
    /// Paint of the surfaces that show it, in its mean colour.
    pub paint: PaintId,
    /// Paints in a dark and in a light colour, used to derive the effect of tones.
    pub probes: [PaintId; 2],
    texels: TexelPlane,
    picture: Picture,
    /// For each channel, the table of values after multiplication by the material's colour.
    tint: [Vec<u8>; 3],
    /// Whether texels are weighted by their opacity.
    weighed: bool,
}

/// Maximum texels that are compared to find a single colour.
const MAX_TESTED_TEXELS: i64 = 4096;

impl EmbeddedTexture {
    /// Prepares a picture; `base` multiplies it, and with `weighed` texels are weighted by their opacity.
    pub(crate) fn new(
        (material, paint, probes): (MaterialId, PaintId, [PaintId; 2]),
        texels: TexelPlane,
        picture: Picture,
        base: Option<Colour>,
        weighed: bool,
    ) -> Self {
        let of = |c: u8| linear(f32::from(c) / 255.0);
        let factors = base.map_or([1.0; 3], |base| [base.r, base.g, base.b].map(of));
        let tint = factors.map(|factor| {
            let tinted = |c: u8| {
                if factor == 1.0 { c } else { Colour::from_linear([of(c) * factor, 0.0, 0.0, 1.0]).r }
            };
            (0..=255).map(tinted).collect()
        });
        Self { material, paint, probes, texels, picture, tint, weighed }
    }

    /// Layout of its texels in the plane.
    pub(crate) fn texels(&self) -> &TexelPlane {
        &self.texels
    }

    /// Single colour of everything in a box of the texel plane, if there is one.
    pub(crate) fn one_colour(&self, low: DVec2, high: DVec2) -> Option<Colour> {
        let ([left, top], [right, bottom]) = (low.floor().to_array(), (high + 1.0).floor().to_array());
        if (right - left + 1.0) * (bottom - top + 1.0) > MAX_TESTED_TEXELS as f64 {
            return None;
        }
        let first = self.texel(left as i64, top as i64);
        let alike = |c: Colour| {
            let far = |a: u8, b: u8| a.abs_diff(b) <= MAX_STORAGE_CHANNEL_ERROR;
            far(c.r, first.r) && far(c.g, first.g) && far(c.b, first.b)
        };
        let mut rows = top as i64..=bottom as i64;
        let whole = rows.all(|row| (left as i64..=right as i64).all(|column| alike(self.texel(column, row))));
        whole.then(|| self.tinted(first))
    }

    /// Resamples a rectangle of the texel plane to `width` by `height` pixels, by the mean light over each
    /// pixel.
    pub(crate) fn part(&self, from: DVec2, to: DVec2, [width, height]: [usize; 2]) -> Picture {
        let table = linear_table();
        let per_pixel = (to - from) / DVec2::new(width as f64, height as f64);
        // Texels under a pixel and their overlap; a texel extends half a texel around its centre.
        let covered = |k: usize, axis: usize| {
            let (low, high) = (
                from[axis] + 0.5 + k as f64 * per_pixel[axis],
                from[axis] + 0.5 + (k + 1) as f64 * per_pixel[axis],
            );
            let range = (low + MIN_TEXEL_SHARE).floor() as i64
                ..=((high - MIN_TEXEL_SHARE).floor() as i64).max(low.floor() as i64);
            range.map(move |t| (t, (high.min((t + 1) as f64) - low.max(t as f64)).max(0.0) as f32))
        };
        let columns: Vec<Vec<(i64, f32)>> = (0..width).map(|k| covered(k, 0).collect()).collect();
        let mut pixels = Vec::with_capacity(width * height);
        for row in 0..height {
            let rows: Vec<(i64, f32)> = covered(row, 1).collect();
            for columns in &columns {
                if let ([(column, _)], [(row, _)]) = (&columns[..], &rows[..]) {
                    pixels.push(self.tinted(self.texel(*column, *row)));
                    continue;
                }
                let (mut sum, mut all) = ([0.0_f32; 3], 0.0_f32);
                for (row, tall) in &rows {
                    for (column, wide) in columns {
                        let colour = self.texel(*column, *row);
                        let clear = if self.weighed { f32::from(colour.a.max(1)) / 255.0 } else { 1.0 };
                        let weight = tall * wide * clear;
                        let light = [colour.r, colour.g, colour.b].map(|c| table[usize::from(c)]);
                        sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light * weight);
                        all += weight;
                    }
                }
                let [r, g, b] = sum.map(|sum| sum / all.max(f32::MIN_POSITIVE));
                pixels.push(self.tinted(Colour::from_linear([r, g, b, 1.0])));
            }
        }
        Picture { width, height, pixels }
    }

    fn texel(&self, column: i64, row: i64) -> Colour {
        self.picture.pixels.get(self.texels.index(column, row)).copied().unwrap_or(Colour::BLACK)
    }

    fn tinted(&self, colour: Colour) -> Colour {
        let [r, g, b] = &self.tint;
        let of = |table: &[u8], c: u8| table.get(usize::from(c)).copied().unwrap_or(c);
        Colour::rgb(of(r, colour.r), of(g, colour.g), of(b, colour.b))
    }
}

/// Maximum channel difference between equal colours that were stored differently.
const MAX_STORAGE_CHANNEL_ERROR: u8 = 3;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::{Placing, Wrap};

    fn sample_texture(base: Option<Colour>) -> EmbeddedTexture {
        let grey = |v: u8| Colour::rgb(v, v, v);
        let picture = Picture { width: 4, height: 1, pixels: [0, 255, 9, 10].map(grey).to_vec() };
        let texels = TexelPlane {
            size: [4, 1],
            wrap: [Wrap::Repeat, Wrap::Clamp],
            upward: false,
            placing: Placing::default(),
        };
        EmbeddedTexture::new(
            (MaterialId(0), PaintId(0), [PaintId(1), PaintId(2)]),
            texels,
            picture,
            base,
            false,
        )
    }

    #[test]
    fn texture_part_wraps_and_averages_in_linear_light() {
        let grey = |part: Picture| part.pixels.iter().map(|c| c.r).collect::<Vec<_>>();
        let whole = sample_texture(None);
        let from = DVec2::new(-1.5, -0.5);
        assert_eq!(grey(whole.part(from, DVec2::new(5.5, 0.5), [7, 1])), [10, 0, 255, 9, 10, 0, 255]);
        // Half black, half white: half the light.
        let half = whole.part(DVec2::new(-0.5, -0.5), DVec2::new(1.5, 0.5), [1, 1]);
        assert_eq!(grey(half), [188]);
        let tinted = sample_texture(Some(Colour::from_linear([0.5, 1.0, 1.0, 1.0])));
        let one = DVec2::new(5.0, 7.0);
        assert_eq!(tinted.one_colour(one, one), None);
        assert_eq!(tinted.part(one - 0.5, one + 0.5, [1, 1]).at(0, 0), Colour::rgb(188, 255, 255));
    }

    #[test]
    fn one_colour_is_found_only_in_uniform_areas() {
        let whole = sample_texture(None);
        assert_eq!(whole.one_colour(DVec2::new(2.1, 0.0), DVec2::new(2.9, 0.0)), Some(Colour::rgb(9, 9, 9)));
        assert_eq!(whole.one_colour(DVec2::new(2.1, 0.0), DVec2::new(3.1, 0.0)), None);
    }
}
