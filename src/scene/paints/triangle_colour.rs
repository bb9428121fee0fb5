//! [`Coloured`]: what gives a triangle a colour other than its material's: a texture, or the colours of its corners.

use glam::Vec3;

use crate::colour::srgb::{Colour, linear};
use crate::scene::Geometry;
use crate::scene::textures::Texture;
use crate::scene::textures::palette::palette_clusters::{ALIKE, difference};

/// Corners whose colours differ by no more than this in any channel are of one colour.
const ONE: u32 = 2;

/// A triangle that has a colour other than its material's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coloured {
    pub geometry: usize,
    pub triangle: usize,
    /// What it shows of a texture.
    pub shown: Option<Colour>,
    /// How far colours within it differ in the texture.
    pub spread: u32,
    /// The linear light of the colours at its corners in the mean, where they are not white.
    pub painted: Option<Vec3>,
    /// How far the colours at its corners differ.
    pub tint_spread: u32,
}

impl Coloured {
    /// The colours of a triangle, where a texture or its corners give it one.
    pub fn of(geometry: &Geometry, index: usize, triangle: usize, texture: Option<&Texture>) -> Option<Self> {
        let uvs = geometry.corner_uvs.get(triangle).and_then(|corners| {
            let [a, b, c] = corners.map(|corner| geometry.uvs.get(corner as usize).copied());
            Some([a?, b?, c?])
        });
        let shown = texture.zip(uvs).map(|(texture, uvs)| texture.of_triangle(uvs));
        let corners = tints_of(geometry, triangle);
        let painted = corners.map(|[a, b, c]| {
            // Rounded once, so that it does not matter which corner comes first.
            ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3()
        });
        let tint_spread = corners.map_or(0, |corners| {
            let [a, b, c] = corners.map(|light| Colour::from_linear(light.extend(1.0).to_array()));
            difference(a, b).max(difference(b, c)).max(difference(c, a))
        });
        // White is no tint of a texture.
        let painted = painted.filter(|light| shown.is_none() || *light != Vec3::ONE || tint_spread > 0);
        if shown.is_none() && painted.is_none() {
            return None;
        }
        let (shown, spread) = shown.map_or((None, 0), |(colour, spread)| (Some(colour), spread));
        Some(Self { geometry: index, triangle, shown, spread, painted, tint_spread })
    }

    /// Whether the colours at its corners differ.
    pub fn varies(&self) -> bool {
        self.tint_spread > ONE
    }

    /// Whether it is of one colour.
    pub fn is_flat(&self) -> bool {
        self.spread < ALIKE && !self.varies()
    }
}

/// The linear light of the colours at the corners of a triangle.
pub(crate) fn tints_of(geometry: &Geometry, triangle: usize) -> Option<[Vec3; 3]> {
    let [a, b, c] = geometry.triangles.get(triangle)?.map(|corner| geometry.colour_of(corner));
    Some([a?, b?, c?].map(|[r, g, b, _]| Vec3::new(r, g, b)))
}

/// What the colour of a material does to those of its texture and its corners: in glTF it multiplies them, elsewhere they stand
/// in for it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Factor {
    pub base: Colour,
    pub multiplies: bool,
}

impl Factor {
    /// The colour of a triangle.
    pub fn of(&self, own: &Coloured) -> Colour {
        self.product([own.shown.map(light), own.painted])
    }

    /// The colour of what shows one of the colours of a texture.
    pub fn tint(&self, colour: Colour) -> Colour {
        self.product([Some(light(colour)), None])
    }

    /// The colour of light of these factors.
    pub fn product(&self, factors: [Option<Vec3>; 2]) -> Colour {
        let product = factors.into_iter().flatten().fold(Vec3::ONE, |product, factor| product * factor);
        let product = product * self.light();
        let opacity = f32::from(self.base.a) / 255.0;
        Colour::from_linear([product.x, product.y, product.z, opacity])
    }

    /// The linear light by which others are multiplied.
    pub fn light(&self) -> Vec3 {
        if self.multiplies { light(self.base) } else { Vec3::ONE }
    }
}

/// The linear light of a colour.
pub(crate) fn light(colour: Colour) -> Vec3 {
    let [r, g, b] = [colour.r, colour.g, colour.b].map(|c| linear(f32::from(c) / 255.0));
    Vec3::new(r, g, b)
}
