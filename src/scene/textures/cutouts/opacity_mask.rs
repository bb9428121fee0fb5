//! [`OpacityMask`]: which parts of a material's picture are transparent.

use glam::DVec2;

use crate::colour::pixel_picture::Picture;
use crate::scene::material::Alpha;
use crate::scene::textures;
use crate::scene::textures::texel_plane::TexelPlane;
use crate::scene::{Material, Scene};

/// Opacity of each texel of a picture, and the minimum opacity that counts as opaque.
///
/// Opacity is bilinear between the centres of four texels, as in a magnified texture.
pub(crate) struct OpacityMask {
    pub texels: TexelPlane,
    opacity: Vec<u8>,
    /// Halfway between two whole numbers, so that no texel is exactly on it.
    level: f64,
}

/// The transparent parts of a material.
pub(crate) enum CutExtent {
    /// Nothing is cut away.
    Nowhere,
    /// Everything is cut away.
    Everywhere,
    /// The mask decides.
    Where(OpacityMask),
}

impl CutExtent {
    /// Finds the transparent parts of a material; an error if its picture is needed and cannot be read.
    pub(crate) fn of(scene: &Scene, material: &Material) -> Result<Self, String> {
        let constant = f64::from(material.colour.a) / 255.0;
        let (picture, is_own) = match (&material.opacity_map, &material.alpha) {
            (Some(path), _) => (textures::picture_from_model_folder(scene, path).transpose()?, true),
            (None, Alpha::Opaque) => return Ok(Self::Nowhere),
            (None, _) if constant == 0.0 => return Ok(Self::Everywhere),
            (None, _) => (textures::picture_of(scene, material).transpose()?, false),
        };
        let Some(picture) = picture else { return Ok(Self::Nowhere) };
        let opacity = opacities(&picture, is_own);
        let (least, most) = opacity.iter().fold((255, 0), |(a, b), o| (a.min(*o), b.max(*o)));
        let level = match material.alpha {
            Alpha::Mask { cutoff } => f64::from(cutoff) * 255.0,
            // A picture without fully transparent texels is dirty glass, not a cut-out. Otherwise the edge is
            // at half the maximum opacity.
            Alpha::Blend if least > 0 => return Ok(Self::Nowhere),
            Alpha::Blend => f64::from(most) / 2.0,
            Alpha::Opaque => 127.5,
        };
        let level = level.ceil() - 0.5;
        if f64::from(least) > level {
            return Ok(Self::Nowhere);
        }
        if f64::from(most) < level || most == 0 {
            return Ok(Self::Everywhere);
        }
        Ok(Self::Where(OpacityMask { texels: TexelPlane::of(scene, material, &picture), opacity, level }))
    }
}

/// Opacity of each texel: its alpha, or the lightness in an opacity map without alpha.
fn opacities(picture: &Picture, is_own: bool) -> Vec<u8> {
    let pixels = &picture.pixels;
    if is_own && pixels.iter().all(|c| c.a == 255) {
        let grey = |c: &crate::colour::srgb::Colour| {
            ((2126 * u32::from(c.r) + 7152 * u32::from(c.g) + 722 * u32::from(c.b) + 5000) / 10_000) as u8
        };
        return pixels.iter().map(grey).collect();
    }
    pixels.iter().map(|c| c.a).collect()
}

impl OpacityMask {
    /// Opacity of a texel minus the level, never 0. Column and row may be outside the picture.
    pub(crate) fn texel(&self, column: i64, row: i64) -> f64 {
        let opacity = self.opacity.get(self.texels.index(column, row));
        opacity.map_or(-1.0, |o| f64::from(*o) - self.level)
    }

    /// Whether a point of the texel plane is opaque.
    pub(crate) fn is_opaque(&self, p: DVec2) -> bool {
        let (low, part) = (p.floor(), p - p.floor());
        let (i, j) = (low.x as i64, low.y as i64);
        let along = |row: i64| {
            let (left, right) = (self.texel(i, row), self.texel(i + 1, row));
            left + (right - left) * part.x
        };
        let (top, bottom) = (along(j), along(j + 1));
        top + (bottom - top) * part.y >= 0.0
    }
}

#[cfg(test)]
impl OpacityMask {
    /// Mask of given opacities, cut at half.
    pub(crate) fn of_opacities(width: usize, opacity: Vec<u8>, wrap: crate::scene::material::Wrap) -> Self {
        let texels = TexelPlane {
            size: [width, opacity.len() / width],
            wrap: [wrap; 2],
            upward: false,
            placing: crate::scene::material::Placing::default(),
        };
        Self { texels, opacity, level: 127.5 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::Wrap;

    #[test]
    fn opacity_mask_follows_its_wrap_mode() {
        let texels = |wrap| {
            let mask = OpacityMask::of_opacities(3, vec![0, 100, 200], wrap);
            (-3..6).map(|k| (mask.texel(k, 0) + 127.5) as u8).collect::<Vec<_>>()
        };
        assert_eq!(texels(Wrap::Repeat), [0, 100, 200, 0, 100, 200, 0, 100, 200]);
        assert_eq!(texels(Wrap::Clamp), [0, 0, 0, 0, 100, 200, 200, 200, 200]);
        assert_eq!(texels(Wrap::Mirror), [200, 100, 0, 0, 100, 200, 200, 100, 0]);
    }

    #[test]
    fn opacity_is_bilinear_between_texels() {
        let mask = OpacityMask::of_opacities(2, vec![255, 0, 255, 0], Wrap::Clamp);
        assert!(mask.is_opaque(DVec2::new(0.49, 0.7)) && !mask.is_opaque(DVec2::new(0.51, 0.7)));
    }
}
