//! The base-colour texture of a material, reduced to a few flat colours or embedded unchanged.
//!
//! 1. The picture is decoded and placed in the texel plane ([`texel_plane`]).
//! 2. [`texel_coverage`] weighs each texel by the surface area on which it is visible.
//! 3. [`palette`] finds the flat colours of a palette texture, or else a few representative colours.
//! 4. [`label_map`] gives each texel one of these colours and traces the borders between them.
//! 5. With `fill = "image"` [`embedded_texture`] resamples the picture for the drawing instead.
//!
//! [`cutouts`] uses the same plane to cut transparent texels out of the triangles. [`texture_options`] has
//! the style keys; [`cache`] keeps assignments and maps between views.

mod cache;
pub(crate) mod cutouts;
mod embedded_texture;
mod label_map;
pub(crate) mod palette;
mod texel_coverage;
pub(crate) mod texel_plane;
pub(crate) mod texture_options;

use std::path::Path;

pub(crate) use embedded_texture::EmbeddedTexture;
pub(crate) use label_map::colour_map::ColourMap;
pub(crate) use label_map::painted_texture::PaintedTexture;
pub(crate) use palette::colour_kmeans::kmeans_colours;

use self::cache::result_cache::ResultCache;
use self::label_map::texel_assignments::TexelAssignments;
use self::palette::palette_clusters::{MIN_CHANNEL_DIFFERENCE, channel_difference};
use super::model_folder::read_from_model_folder;
use super::{Alpha, Filter, Material, Scene};
use crate::colour::oklab;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::mesh::{MaterialId, PaintId};
use texel_plane::TexelPlane;

/// The picture of a base colour, with its layout.
pub(crate) struct Texture {
    picture: Picture,
    texels: TexelPlane,
    filter: Filter,
}

/// Maximum samples along each side of a triangle in the test for a single colour.
const MAX_SAMPLES_PER_SIDE: f64 = 48.0;

impl Texture {
    /// Reads the texture of a material; `None` if it has none, an error if it cannot be read or decoded.
    pub(crate) fn of(scene: &Scene, material: &Material) -> Option<Result<Self, String>> {
        let picture = picture_of(scene, material)?;
        Some(picture.map(|picture| {
            let picture = picture.at_most(MAX_TEXELS);
            Self { texels: TexelPlane::of(scene, material, &picture), picture, filter: material.filter }
        }))
    }

    /// Representative colour of a triangle, and the maximum channel difference from it inside the triangle,
    /// up to [`MIN_CHANNEL_DIFFERENCE`].
    ///
    /// The colour is that of four samples which differs least from the others: the centroid and three points
    /// towards the corners. The outermost tenth of the triangle is not tested.
    pub(crate) fn of_triangle(&self, corners: [[f32; 2]; 3]) -> (Colour, u32) {
        let mut corners = corners;
        // Sorted, so that the samples do not depend on the first corner, to the last bit.
        corners.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then_with(|| a[1].total_cmp(&b[1])));
        let [a, b, c] = corners.map(|uv| self.texels.place(uv).unwrap_or_default());
        let at = |wa: f64, wb: f64, wc: f64| self.at(a * wa + b * wb + c * wc);
        let third = 1.0 / 3.0;
        let samples = [at(third, third, third), at(0.8, 0.1, 0.1), at(0.1, 0.8, 0.1), at(0.1, 0.1, 0.8)];
        let strange =
            |sample: &Colour| samples.iter().map(|other| channel_difference(*sample, *other)).sum::<u32>();
        let colour = samples.into_iter().min_by_key(strange).unwrap_or(samples[0]);
        let mut far =
            samples.iter().map(|sample| channel_difference(*sample, colour)).max().unwrap_or_default();
        // One sample per texel, up to `MAX_SAMPLES_PER_SIDE` along a side.
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        let steps = longest.min(MAX_SAMPLES_PER_SIDE).ceil().max(1.0);
        for i in 0..=steps as u32 {
            for j in 0..=steps as u32 - i {
                if far >= MIN_CHANNEL_DIFFERENCE {
                    return (colour, MIN_CHANNEL_DIFFERENCE);
                }
                let (wa, wb) = (0.1 + 0.7 * f64::from(i) / steps, 0.1 + 0.7 * f64::from(j) / steps);
                far = far.max(channel_difference(at(wa, wb, 1.0 - wa - wb), colour));
            }
        }
        (colour, far.min(MIN_CHANNEL_DIFFERENCE))
    }

    /// Colour of the nearest texel.
    fn at(&self, place: glam::DVec2) -> Colour {
        let nearest = (place + 0.5).floor();
        let texel = self.texels.index(nearest.x as i64, nearest.y as i64);
        self.picture.pixels[texel]
    }

    /// Texture of a picture that is laid on a material from outside, such as a style's.
    pub(crate) fn with_picture(scene: &Scene, material: &Material, picture: &Picture) -> Self {
        let picture = picture.clone().at_most(MAX_TEXELS);
        Self { texels: TexelPlane::of(scene, material, &picture), picture, filter: Filter::Smooth }
    }

    /// Visible surface area of each texel, transparent ones included; `triangles` as in [`Texture::shown`].
    pub(crate) fn unmasked_coverage(&self, scene: &Scene, triangles: &[[usize; 2]]) -> Vec<f32> {
        texel_coverage::texel_coverage(scene, triangles, &self.texels)
    }

    /// Visible surface area of each texel on a material; zero for transparent texels.
    ///
    /// `triangles` are those that show the picture, as pairs of geometry (ascending) and triangle.
    pub(crate) fn shown(&self, scene: &Scene, material: usize, triangles: &[[usize; 2]]) -> Vec<f32> {
        let mut shown = self.unmasked_coverage(scene, triangles);
        let least = match scene.materials.get(material).map(|material| material.alpha) {
            Some(Alpha::Mask { cutoff }) => cutoff * 255.0,
            Some(Alpha::Blend) => 127.5,
            Some(Alpha::Opaque) | None => return shown,
        };
        for (shown, colour) in shown.iter_mut().zip(&self.picture.pixels) {
            if f32::from(colour.a) < least {
                *shown = 0.0;
            }
        }
        shown
    }

    /// Mean light of the texture, weighted by visible area.
    pub(crate) fn mean_light(&self, shown: &[f32]) -> Option<Colour> {
        let table = oklab::linear_table();
        let (mut sum, mut all) = ([0.0_f64; 3], 0.0_f64);
        for (shown, Colour { r, g, b, .. }) in shown.iter().zip(&self.picture.pixels) {
            let light = [*r, *g, *b].map(|c| f64::from(table[usize::from(c)]) * f64::from(*shown));
            sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light);
            all += f64::from(*shown);
        }
        let [r, g, b] = sum.map(|sum| (sum / all) as f32);
        (all > 0.0).then(|| Colour::from_linear([r, g, b, 1.0]))
    }

    /// Prepares the texture for embedding: `base` multiplies it, and with `weighed` texels are weighted by
    /// their opacity.
    pub(crate) fn imaged(
        self,
        paints: (MaterialId, PaintId, [PaintId; 2]),
        base: Option<Colour>,
        weighed: bool,
    ) -> EmbeddedTexture {
        EmbeddedTexture::new(paints, self.texels, self.picture, base, weighed)
    }

    /// At most `count` representative colours, weighted by visible area.
    pub(crate) fn representative_colours(&self, shown: &[f32], count: usize) -> Vec<Colour> {
        palette::colour_kmeans::kmeans_colours(&self.picture.pixels, shown, count)
    }

    /// Mean colour, weighted by visible area.
    pub(crate) fn mean(&self, shown: &[f32]) -> Colour {
        palette::colour_kmeans::kmeans_colours(&self.picture.pixels, shown, 1)
            .first()
            .copied()
            .unwrap_or(Colour::WHITE)
    }

    /// Prepares the texture for painting in a few colours, and in their mean.
    pub(crate) fn painted(self, shown: Vec<f32>, colours: &[Colour], mean: Colour) -> PaintedTexture {
        let most = MAX_CACHED_PICTURES * shown.len();
        PaintedTexture {
            texels: self.texels,
            colours: self.picture.pixels,
            shown,
            palette: colours.iter().map(|colour| oklab::of(*colour)).collect(),
            mean: oklab::of(mean),
            filter: self.filter,
            guesses: ResultCache::new(most, |guesses: &TexelAssignments| guesses.list.len()),
            maps: ResultCache::new(most, ColourMap::texels),
        }
    }
}

/// Maximum size of a cache, in multiples of the picture: enough for all of its scales together.
const MAX_CACHED_PICTURES: usize = 2;

/// Maximum texels of a picture; larger ones are downsampled, as no drawing shows more.
const MAX_TEXELS: usize = 1 << 22;

/// Decodes the picture of a material's base colour; `None` if it has none, an error if it cannot be read.
pub(crate) fn picture_of(scene: &Scene, material: &Material) -> Option<Result<Picture, String>> {
    match (&material.picture, &material.texture) {
        (Some(bytes), _) => Some(Picture::decode(bytes)),
        (None, Some(path)) => picture_from_model_folder(scene, path),
        (None, None) => None,
    }
}

/// Decodes a picture next to the model; `None` if the model is not a file.
pub(crate) fn picture_from_model_folder(scene: &Scene, path: &str) -> Option<Result<Picture, String>> {
    scene.file.as_ref().map(|file| from_file(file, path))
}

fn from_file(model: &Path, path: &str) -> Result<Picture, String> {
    let bytes = read_from_model_folder(model, path).map_err(|error| error.message)?;
    Picture::decode(&bytes).map_err(|message| format!("{path} {message}"))
}

#[cfg(test)]
mod tests {
    use super::super::material::Wrap;
    use super::*;

    #[test]
    fn texture_lookup_repeats_and_respects_orientation() {
        let (a, b, c, d) =
            (Colour::rgb(1, 0, 0), Colour::rgb(2, 0, 0), Colour::rgb(3, 0, 0), Colour::rgb(4, 0, 0));
        let picture = Picture { width: 2, height: 2, pixels: vec![a, b, c, d] };
        let texels = TexelPlane {
            size: [2, 2],
            wrap: [Wrap::Repeat; 2],
            upward: false,
            placing: super::super::material::Placing::default(),
        };
        let mut texture = Texture { picture, texels, filter: Filter::Smooth };
        let at = |texture: &Texture, uv| texture.at(texture.texels.place(uv).unwrap());
        assert_eq!([[0.1, 0.1], [0.9, 0.1], [1.1, -0.1]].map(|uv| at(&texture, uv)), [a, b, c]);
        assert_eq!(texture.of_triangle([[f32::NAN; 2]; 3]), (a, 0));
        texture.texels.upward = true;
        assert_eq!([[0.1, 0.1], [0.9, 0.9]].map(|uv| at(&texture, uv)), [c, b]);
        assert_eq!(texture.of_triangle([[0.6, 0.6], [0.9, 0.6], [0.6, 0.9]]), (b, 0));
        // One corner across the border does not count.
        assert_eq!(texture.of_triangle([[0.2, 0.6], [0.9, 0.6], [0.9, 0.9]]).0, b);
    }
}
