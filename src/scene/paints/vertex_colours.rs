//! [`Tints`]: the few colours in which the colours of vertices are painted, as they pass into each other on triangles.

use glam::{DVec3, Vec3};

use super::triangle_colour::{Coloured, Factor, tints_of};
use crate::colour::oklab::{self, Oklab, distance2};
use crate::colour::srgb::Colour;
use crate::scene::Scene;

/// The few colours in which the colours of vertices are painted.
#[derive(Debug, Clone)]
pub(crate) struct Tints {
    /// By what the colours of vertices are multiplied before they are looked at.
    factor: Vec3,
    palette: Vec<Oklab>,
}

impl Tints {
    /// Those that are painted in these colours.
    pub(crate) fn new(factor: Vec3, palette: &[Colour]) -> Self {
        Self { factor, palette: palette.iter().map(|colour| oklab::of(*colour)).collect() }
    }

    /// How the few colours look.
    pub fn palette(&self) -> &[Oklab] {
        &self.palette
    }

    /// How light of a vertex, or between some, looks.
    pub fn looks(&self, light: [f64; 3]) -> Oklab {
        let light = Vec3::from_array(light.map(|c| c as f32)) * self.factor;
        oklab::of_linear(light.clamp(Vec3::ZERO, Vec3::ONE).to_array())
    }

    /// The number of the colour in which light is painted: the nearest; of equally near ones the first.
    pub fn at(&self, light: [f64; 3]) -> u8 {
        let look = self.looks(light);
        let mut best = (0, f32::INFINITY);
        for (k, colour) in self.palette.iter().enumerate() {
            let far = distance2(*colour, look);
            if far < best.1 {
                best = (k, far);
            }
        }
        best.0 as u8
    }
}

/// Triangles whose corners differ by less than this in any channel count as their mean.
const NEARLY_ONE: u32 = 24;

/// A triangle is looked at in the middles of the pieces that this many cuts along each side make.
const CUTS: usize = 5;

/// Colours that are seen on triangles, and on how much of the surface, in world units. `triangles` are in ascending order of their
/// geometries.
pub(crate) fn samples(scene: &Scene, triangles: &[Coloured], factor: &Factor) -> (Vec<Colour>, Vec<f32>) {
    let (mut colours, mut weights) = (Vec::new(), Vec::new());
    for part in &scene.parts {
        let Some(geometry) = scene.geometry_of(part) else { continue };
        let position = |corner: u32| {
            geometry.positions.get(corner as usize).map(|p| part.world_from_part.transform_point3(*p))
        };
        let first = triangles.partition_point(|own| own.geometry < part.geometry);
        for own in triangles[first..].iter().take_while(|own| own.geometry == part.geometry) {
            let [p, q, r] = geometry.triangles[own.triangle].map(position);
            let (Some(p), Some(q), Some(r)) = (p, q, r) else { continue };
            let area = DVec3::cross(q - p, r - p).length() / 2.0;
            let mut put = |light: Vec3, share: f64| {
                colours.push(Colour { a: 255, ..factor.product([Some(light), None]) });
                weights.push((area * share) as f32);
            };
            match tints_of(geometry, own.triangle) {
                Some(corners) if own.tint_spread >= NEARLY_ONE => {
                    middles().for_each(|at| {
                        let light = corners[0] * at[0] + corners[1] * at[1] + corners[2] * at[2];
                        put(light, 1.0 / (CUTS * CUTS) as f64);
                    });
                }
                _ => put(own.painted.unwrap_or(Vec3::ONE), 1.0),
            }
        }
    }
    (colours, weights)
}

/// The middles of equal pieces of a triangle, in shares of its corners.
fn middles() -> impl Iterator<Item = [f32; 3]> {
    let place = |i: usize, j: usize, off: f32| {
        let [x, y] = [i, j].map(|k| (k as f32 + off) / CUTS as f32);
        [1.0 - x - y, x, y]
    };
    let upright = (0..CUTS).flat_map(move |i| (0..CUTS - i).map(move |j| place(i, j, 1.0 / 3.0)));
    let turned = (0..CUTS).flat_map(move |i| (0..CUTS - 1 - i).map(move |j| place(i, j, 2.0 / 3.0)));
    upright.chain(turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_a_triangle_are_all_there_and_within_it() {
        let all: Vec<[f32; 3]> = middles().collect();
        assert_eq!(all.len(), CUTS * CUTS);
        assert!(all.iter().flatten().all(|share| *share > 0.0));
        let sums = [0, 1, 2].map(|k| all.iter().map(|at| at[k]).sum::<f32>() / all.len() as f32);
        assert!(sums.iter().all(|sum| (sum - 1.0 / 3.0).abs() < 1e-5), "{sums:?}");
    }

    #[test]
    fn light_is_painted_in_the_colour_that_looks_nearest() {
        let tints = Tints::new(Vec3::ONE, &[Colour::WHITE, Colour::rgb(255, 0, 0), Colour::BLACK]);
        assert_eq!(tints.at([0.9, 0.1, 0.1]), 1);
        assert_eq!(tints.at([0.7, 0.7, 0.7]), 0);
        // In linear light a tenth looks nearly half as light as white.
        let even = Tints::new(Vec3::ONE, &[Colour::WHITE, Colour::BLACK]);
        assert_eq!([0.1, 0.2].map(|c| even.at([c; 3])), [1, 0]);
        let dim = Tints::new(Vec3::splat(0.1), &[Colour::WHITE, Colour::BLACK]);
        assert_eq!(dim.at([1.0; 3]), 1);
    }
}
