//! [`Drawn`]: a picture as a view shows it, in a few colours, in one scale or in several.

use glam::DVec2;

use super::texture_scale::{Scale, density_of};
use crate::scene::texels::outline::{Outline, Segment};
use crate::scene::texture::{Labels, Painted, trace};

/// A picture as a view shows it.
#[derive(Debug)]
pub(super) struct Drawn {
    /// With the finest first.
    levels: Vec<Level>,
    /// The densities of texels at which the next level begins.
    ends: Vec<f64>,
    /// How dense texels are at the corners of each face, or empty where there is one level.
    densities: Vec<[f64; 3]>,
}

/// A picture in one scale.
#[derive(Debug)]
struct Level {
    labels: Labels,
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
        densities: impl FnOnce() -> Vec<[f64; 3]>,
    ) -> Option<Self> {
        let of_one = |labels: Labels, texels_per_px: f64| {
            let per_px = texels_per_px * labels.texels.size[0] as f64 / painted.texels().size[0] as f64;
            let near = if per_px.is_finite() { (NEAR_PX * per_px).clamp(0.005, 0.5) } else { 0.1 };
            Some(Level { borders: Outline::new(&trace(&labels)?, near), labels })
        };
        let Some([first, last]) = scale.range.filter(|[first, last]| first < last) else {
            let level = of_one(painted.labels(scale.mean * smooth), scale.mean)?;
            return Some(Self { levels: vec![level], ends: Vec::new(), densities: Vec::new() });
        };
        let texels_per_px = |power: i32| if power < 0 { 0.5_f64.powi(-power) } else { 2.0_f64.powi(power) };
        let levels: Option<Vec<Level>> = (first..=last)
            .map(|power| {
                let texels_per_px = texels_per_px(power);
                of_one(painted.labels_or_mean(texels_per_px * smooth), texels_per_px)
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
pub(super) struct OnPicture<'a> {
    drawn: &'a Drawn,
    uvs: [[f32; 2]; 3],
    /// How dense texels lie at its corners.
    densities: [f64; 3],
}

impl OnPicture<'_> {
    /// The corners of the face in the plane of the texels of a level.
    pub fn corners(&self, level: usize) -> Option<[DVec2; 3]> {
        let [a, b, c] = self.uvs.map(|uv| self.drawn.levels[level].labels.texels.place(uv));
        Some([a?, b?, c?])
    }

    /// The level at a point of the face.
    fn level(&self, weights: [f64; 3]) -> usize {
        let density = self.density(weights);
        self.drawn.ends.partition_point(|end| *end <= density)
    }

    /// How dense texels lie at a point of the face.
    pub fn density(&self, weights: [f64; 3]) -> f64 {
        let [a, b, c] = self.densities;
        a * weights[0] + b * weights[1] + c * weights[2]
    }

    /// The densities at the corners.
    pub fn densities(&self) -> [f64; 3] {
        self.densities
    }

    /// The levels that the face shows, each with the densities at which it begins and ends.
    pub fn levels(&self) -> impl Iterator<Item = (usize, [f64; 2])> {
        let Drawn { levels, ends, .. } = self.drawn;
        let [a, b, c] = self.densities;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let within = move |level: usize| {
            let begins = level.checked_sub(1).map_or(f64::NEG_INFINITY, |before| ends[before]);
            (level, [begins, ends.get(level).copied().unwrap_or(f64::INFINITY)])
        };
        (0..levels.len()).map(within).filter(move |(_, [begins, ends])| high >= *begins && low < *ends)
    }

    /// The number of the colour at a point of the face.
    pub fn colour(&self, weights: [f64; 3]) -> Option<u8> {
        let level = self.level(weights);
        let [a, b, c] = self.corners(level)?;
        Some(self.drawn.levels[level].labels.at(a * weights[0] + b * weights[1] + c * weights[2]))
    }

    /// The number of the colour in the middle of the face, were it all of one level.
    pub fn middle_colour(&self, level: usize) -> Option<u8> {
        let [a, b, c] = self.corners(level)?;
        Some(self.drawn.levels[level].labels.at((a + b + c) / 3.0))
    }

    /// The borders between the colours of a level that may lie on the face, and the numbers of the colours that each parts.
    pub fn borders(&self, level: usize) -> Vec<(Segment, [u8; 2])> {
        let Some([a, b, c]) = self.corners(level) else { return Vec::new() };
        let make = |segment: Segment, parted: [u8; 2]| (segment, parted);
        let borders = &self.drawn.levels[level].borders;
        borders.near_as(a.min(b).min(c), a.max(b).max(c), make).unwrap_or_default()
    }
}
