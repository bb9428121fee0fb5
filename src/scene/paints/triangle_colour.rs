//! [`TriangleColour`]: the colour of a triangle from a texture or from its vertices, if it has one.

use glam::Vec3;

use crate::colour::srgb::{Colour, linear};
use crate::scene::Geometry;
use crate::scene::textures::Texture;
use crate::scene::textures::palette::palette_clusters::{MIN_CHANNEL_DIFFERENCE, channel_difference};

/// Maximum channel difference of corner colours that count as equal.
const MAX_EQUAL_CHANNEL_DIFFERENCE: u32 = 2;

/// A triangle with a colour other than its material's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TriangleColour {
    pub geometry: usize,
    pub triangle: usize,
    /// Representative colour in the texture.
    pub shown: Option<Colour>,
    /// Maximum channel difference within its part of the texture.
    pub spread: u32,
    /// Mean of the corner colours in linear light, unless they are white.
    pub painted: Option<Vec3>,
    /// Maximum channel difference between the corner colours.
    pub tint_spread: u32,
}

impl TriangleColour {
    /// Samples the colours of a triangle; `None` if neither a texture nor its corners give it one.
    pub(crate) fn of(
        geometry: &Geometry,
        index: usize,
        triangle: usize,
        texture: Option<&Texture>,
    ) -> Option<Self> {
        let uvs = geometry.corner_uvs.get(triangle).and_then(|corners| {
            let [a, b, c] = corners.map(|corner| geometry.uvs.get(corner as usize).copied());
            Some([a?, b?, c?])
        });
        let shown = texture.zip(uvs).map(|(texture, uvs)| texture.of_triangle(uvs));
        let corners = corner_light(geometry, triangle);
        let painted = corners.map(|[a, b, c]| {
            // Rounded once, so that the order of the corners does not matter.
            ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3()
        });
        let tint_spread = corners.map_or(0, |corners| {
            let [a, b, c] = corners.map(|light| Colour::from_linear(light.extend(1.0).to_array()));
            channel_difference(a, b).max(channel_difference(b, c)).max(channel_difference(c, a))
        });
        // White does not change a texture.
        let painted = painted.filter(|light| shown.is_none() || *light != Vec3::ONE || tint_spread > 0);
        if shown.is_none() && painted.is_none() {
            return None;
        }
        let (shown, spread) = shown.map_or((None, 0), |(colour, spread)| (Some(colour), spread));
        Some(Self { geometry: index, triangle, shown, spread, painted, tint_spread })
    }

    /// Whether the corner colours differ.
    pub(crate) fn varies(&self) -> bool {
        self.tint_spread > MAX_EQUAL_CHANNEL_DIFFERENCE
    }

    /// Whether the triangle has a single colour.
    pub(crate) fn is_flat(&self) -> bool {
        self.spread < MIN_CHANNEL_DIFFERENCE && !self.varies()
    }
}

/// Corner colours of a triangle, in linear light.
pub(crate) fn corner_light(geometry: &Geometry, triangle: usize) -> Option<[Vec3; 3]> {
    let [a, b, c] = geometry.triangles.get(triangle)?.map(|corner| geometry.colour_of(corner));
    Some([a?, b?, c?].map(|[r, g, b, _]| Vec3::new(r, g, b)))
}

/// Effect of the material's colour on texture and vertex colours: glTF multiplies them, other formats replace
/// it by them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MaterialFactor {
    pub base: Colour,
    pub multiplies: bool,
}

impl MaterialFactor {
    /// Colour of a triangle.
    pub(crate) fn of(&self, own: &TriangleColour) -> Colour {
        self.product([own.shown.map(light), own.painted])
    }

    /// Colour of a surface that shows `colour` of the texture.
    pub(crate) fn tint(&self, colour: Colour) -> Colour {
        self.product([Some(light(colour)), None])
    }

    /// Product of linear-light factors with the material, as a colour.
    pub(crate) fn product(&self, factors: [Option<Vec3>; 2]) -> Colour {
        let product = factors.into_iter().flatten().fold(Vec3::ONE, |product, factor| product * factor);
        let product = product * self.light();
        let opacity = f32::from(self.base.a) / 255.0;
        Colour::from_linear([product.x, product.y, product.z, opacity])
    }

    /// Linear-light factor of the material.
    pub(crate) fn light(&self) -> Vec3 {
        if self.multiplies { light(self.base) } else { Vec3::ONE }
    }
}

/// Linear light of a colour.
pub(crate) fn light(colour: Colour) -> Vec3 {
    let [r, g, b] = [colour.r, colour.g, colour.b].map(|c| linear(f32::from(c) / 255.0));
    Vec3::new(r, g, b)
}
