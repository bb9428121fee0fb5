//! [`Drawn`]: a picture as a view shows it, in a few colours, in one scale or in several.

use std::sync::Arc;

use crate::parallel::prelude::*;
use glam::DVec2;

use super::texel_scale::{Density, Scale, density_of};
use crate::scene::textures::texel_plane::texel_borders::{Outline, Segment};
use crate::scene::textures::{ColourMap, Painted};

/// A picture as a view shows it.
#[derive(Debug)]
pub(crate) struct Drawn {
    /// With the finest first.
    levels: Vec<Level>,
    /// The densities of texels at which the next level begins.
    ends: Vec<Density>,
    /// How dense texels are at the corners of each face, or empty where there is one level.
    densities: Vec<[Density; 3]>,
}

/// A picture in one scale.
#[derive(Debug)]
struct Level {
    map: Arc<ColourMap>,
    borders: Outline,
}

/// How far borders may lie beside their place, px.
const NEAR_PX: f64 = 0.15;

impl Drawn {
    /// A picture whose texels are seen so large; `smooth` makes its detail that much coarser. None if there is too much of it.
    pub fn new(
        painted: &Painted,
        scale: &Scale,
        smooth: f64,
        densities: impl FnOnce() -> Vec<[Density; 3]>,
    ) -> Option<Self> {
        let of_one = |map: Arc<ColourMap>, texels_per_px: f64| {
            let per_px = texels_per_px * map.labels.texels.size[0] as f64 / painted.texels().size[0] as f64;
            let near = if per_px.is_finite() { (NEAR_PX * per_px).clamp(0.005, 0.5) } else { 0.1 };
            Some(Level { borders: Outline::new(map.borders()?, near), map })
        };
        let Some([first, last]) = scale.range.filter(|[first, last]| first < last) else {
            let level = of_one(painted.map(scale.mean * smooth), scale.mean)?;
            return Some(Self { levels: vec![level], ends: Vec::new(), densities: Vec::new() });
        };
        let texels_per_px = |power: i32| if power < 0 { 0.5_f64.powi(-power) } else { 2.0_f64.powi(power) };
        let powers: Vec<i32> = (first..=last).collect();
        let levels: Option<Vec<Level>> = powers
            .into_par_iter()
            .map(|power| {
                let texels_per_px = texels_per_px(power);
                of_one(painted.map_or_mean(texels_per_px * smooth), texels_per_px)
            })
            .collect();
        let ends = (first..last).map(|power| density_of(texels_per_px(power) * std::f64::consts::SQRT_2));
        Some(Self { levels: levels?, ends: ends.collect(), densities: densities() })
    }

    /// A face on the picture, with these texture coordinates at its corners; none if they are no places.
    pub fn on(&self, face: u32, uvs: [[f32; 2]; 3]) -> Option<OnPicture<'_>> {
        let densities = self.densities.get(face as usize).copied().unwrap_or_default();
        let on = OnPicture { drawn: self, uvs, densities };
        self.levels.iter().enumerate().all(|(level, _)| on.corners(level).is_some()).then_some(on)
    }
}

/// Where a face lies on its picture.
#[derive(Clone, Copy)]
pub(crate) struct OnPicture<'a> {
    drawn: &'a Drawn,
    uvs: [[f32; 2]; 3],
    /// How dense texels lie at its corners.
    densities: [Density; 3],
}

impl OnPicture<'_> {
    /// The corners of the face in the plane of the texels of a level.
    pub fn corners(&self, level: usize) -> Option<[DVec2; 3]> {
        let [a, b, c] = self.uvs.map(|uv| self.drawn.levels[level].map.labels.texels.place(uv));
        Some([a?, b?, c?])
    }

    /// The level at a point of the face: the coarser one that either density asks for.
    pub fn level(&self, weights: [f64; 3]) -> usize {
        let of = |which: usize| {
            let density = self.density(which, weights);
            self.drawn.ends.partition_point(|end| end[which] <= density)
        };
        of(0).max(of(1))
    }

    /// One of the densities at a point of the face.
    fn density(&self, which: usize, weights: [f64; 3]) -> f64 {
        (0..3).map(|k| self.densities[k][which] * weights[k]).sum()
    }

    /// The levels that the face may show.
    pub fn levels(&self) -> std::ops::RangeInclusive<usize> {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|at| self.level(at));
        // Between corners of different levels there is none that neither reaches: what is greatest somewhere is so at a corner,
        // but the least may lie between two.
        let least = |which: usize| {
            let low = (0..3).map(|k| self.densities[k][which]).fold(f64::INFINITY, f64::min);
            self.drawn.ends.partition_point(|end| end[which] <= low)
        };
        least(0).max(least(1))..=corners.into_iter().max().unwrap_or_default()
    }

    /// The parts of the way between two points of the face at which a level may end.
    pub fn level_ends(&self, ends: [[f64; 3]; 2]) -> Vec<f64> {
        let mut found = Vec::new();
        for which in 0..2 {
            let [a, b] = ends.map(|end| self.density(which, end));
            let crossed = self.drawn.ends.iter().filter(|end| (a >= end[which]) != (b >= end[which]));
            found.extend(crossed.map(|end| (end[which] - a) / (b - a)));
        }
        found.sort_by(f64::total_cmp);
        found
    }

    /// The lines on the face along which a level may end, each between the sides `sides` (from a corner to another) that it crosses:
    /// the numbers of the sides and how far along them.
    pub fn level_lines(&self, sides: &[[usize; 2]; 3]) -> Vec<[(usize, f64); 2]> {
        let levels = self.levels();
        let mut found = Vec::new();
        for end in self.drawn.ends.get(*levels.start()..*levels.end()).unwrap_or_default() {
            for (which, limit) in end.iter().enumerate() {
                let crossing = |(number, [from, to]): (usize, &[usize; 2])| {
                    let [a, b] = [from, to].map(|k| self.densities[*k][which]);
                    let is_crossed = (a >= *limit) != (b >= *limit);
                    is_crossed.then(|| (number, (*limit - a) / (b - a)))
                };
                let mut crossed = sides.iter().enumerate().filter_map(crossing);
                found.extend(crossed.next().zip(crossed.next()).map(|(a, b)| [a, b]));
            }
        }
        found
    }

    /// The number of the colour at a point of the face.
    pub fn colour(&self, weights: [f64; 3]) -> Option<u8> {
        let level = self.level(weights);
        let [a, b, c] = self.corners(level)?;
        Some(self.drawn.levels[level].map.labels.at(a * weights[0] + b * weights[1] + c * weights[2]))
    }

    /// The number of the colour in the middle of the face, were it all of one level.
    pub fn middle_colour(&self, level: usize) -> Option<u8> {
        let [a, b, c] = self.corners(level)?;
        Some(self.drawn.levels[level].map.labels.at((a + b + c) / 3.0))
    }

    /// The borders between the colours of a level that may lie on the face, and the numbers of the colours that each parts.
    pub fn borders(&self, level: usize) -> Vec<(Segment, [u8; 2])> {
        let Some([a, b, c]) = self.corners(level) else { return Vec::new() };
        let make = |segment: Segment, parted: [u8; 2]| (segment, parted);
        let borders = &self.drawn.levels[level].borders;
        borders.near_as(a.min(b).min(c), a.max(b).max(c), make).unwrap_or_default()
    }
}
