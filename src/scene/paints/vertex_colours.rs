//! [`VertexColourPalette`]: a few colours that represent vertex colours blended across triangles.

use glam::Vec3;

use super::triangle_colour::{MaterialFactor, TriangleColour, corner_light};
use crate::colour::oklab::{self, Oklab};
use crate::colour::srgb::Colour;
use crate::scene::Scene;
use crate::scene::textures::palette::colour_kmeans::nearest_centre_index;

/// A few colours that represent vertex colours.
#[derive(Debug, Clone)]
pub(crate) struct VertexColourPalette {
    /// Factor of the vertex colours, linear light.
    factor: Vec3,
    palette: Vec<Oklab>,
}

impl VertexColourPalette {
    /// Makes a palette from colours.
    pub(crate) fn new(factor: Vec3, palette: &[Colour]) -> Self {
        Self { factor, palette: palette.iter().map(|colour| oklab::of(*colour)).collect() }
    }

    /// The few colours, in Oklab.
    pub(crate) fn palette(&self) -> &[Oklab] {
        &self.palette
    }

    /// Oklab coordinates of interpolated vertex light.
    pub(crate) fn looks(&self, light: [f64; 3]) -> Oklab {
        let light = Vec3::from_array(light.map(|c| c as f32)) * self.factor;
        oklab::of_linear(light.clamp(Vec3::ZERO, Vec3::ONE).to_array())
    }

    /// Index of the nearest colour; the first of equally near ones.
    pub(crate) fn at(&self, light: [f64; 3]) -> u8 {
        nearest_centre_index(&self.palette, self.looks(light)) as u8
    }
}

/// Triangles with a smaller channel difference between corners are represented by their mean.
const MIN_BLEND_CHANNEL_DIFFERENCE: u32 = 24;

/// Number of cuts along each side that divide a triangle into equal pieces for sampling.
const CUTS_PER_SIDE: usize = 5;

/// Samples of the vertex colours, and their surface areas in world units. `triangles` are in ascending order
/// of geometry.
pub(crate) fn sample_vertex_colours(
    scene: &Scene,
    triangles: &[TriangleColour],
    factor: &MaterialFactor,
) -> (Vec<Colour>, Vec<f32>) {
    let (mut colours, mut weights) = (Vec::new(), Vec::new());
    for part in &scene.parts {
        let Some(geometry) = scene.geometry_of(part) else { continue };
        let first = triangles.partition_point(|own| own.geometry < part.geometry);
        for own in triangles[first..].iter().take_while(|own| own.geometry == part.geometry) {
            let Some(area) = part.area_of(geometry, own.triangle) else { continue };
            let mut put = |light: Vec3, share: f64| {
                colours.push(Colour { a: 255, ..factor.product([Some(light), None]) });
                weights.push((area * share) as f32);
            };
            match corner_light(geometry, own.triangle) {
                Some(corners) if own.tint_spread >= MIN_BLEND_CHANNEL_DIFFERENCE => {
                    piece_centres().for_each(|at| {
                        let light = corners[0] * at[0] + corners[1] * at[1] + corners[2] * at[2];
                        put(light, 1.0 / (CUTS_PER_SIDE * CUTS_PER_SIDE) as f64);
                    });
                }
                _ => put(own.painted.unwrap_or(Vec3::ONE), 1.0),
            }
        }
    }
    (colours, weights)
}

/// Centres of equal pieces of a triangle, in barycentric coordinates.
fn piece_centres() -> impl Iterator<Item = [f32; 3]> {
    let place = |i: usize, j: usize, off: f32| {
        let [x, y] = [i, j].map(|k| (k as f32 + off) / CUTS_PER_SIDE as f32);
        [1.0 - x - y, x, y]
    };
    let upright =
        (0..CUTS_PER_SIDE).flat_map(move |i| (0..CUTS_PER_SIDE - i).map(move |j| place(i, j, 1.0 / 3.0)));
    let turned =
        (0..CUTS_PER_SIDE).flat_map(move |i| (0..CUTS_PER_SIDE - 1 - i).map(move |j| place(i, j, 2.0 / 3.0)));
    upright.chain(turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn piece_centres_lie_inside_the_triangle_and_average_to_its_centre() {
        let all: Vec<[f32; 3]> = piece_centres().collect();
        assert_eq!(all.len(), CUTS_PER_SIDE * CUTS_PER_SIDE);
        assert!(all.iter().flatten().all(|share| *share > 0.0));
        let sums = [0, 1, 2].map(|k| all.iter().map(|at| at[k]).sum::<f32>() / all.len() as f32);
        assert!(sums.iter().all(|sum| (sum - 1.0 / 3.0).abs() < 1e-5), "{sums:?}");
    }

    #[test]
    fn vertex_colour_palette_picks_the_perceptually_nearest_colour() {
        let tints =
            VertexColourPalette::new(Vec3::ONE, &[Colour::WHITE, Colour::rgb(255, 0, 0), Colour::BLACK]);
        assert_eq!(tints.at([0.9, 0.1, 0.1]), 1);
        assert_eq!(tints.at([0.7, 0.7, 0.7]), 0);
        // In linear light, a tenth looks nearly half as light as white.
        let even = VertexColourPalette::new(Vec3::ONE, &[Colour::WHITE, Colour::BLACK]);
        assert_eq!([0.1, 0.2].map(|c| even.at([c; 3])), [1, 0]);
        let dim = VertexColourPalette::new(Vec3::splat(0.1), &[Colour::WHITE, Colour::BLACK]);
        assert_eq!(dim.at([1.0; 3]), 1);
    }
}
