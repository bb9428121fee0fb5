//! [`PictureLevels`]: a picture as a view shows it, reduced to a few colours, at one scale or at several.

use std::sync::Arc;

use crate::parallel::prelude::*;
use glam::DVec2;

use super::texel_scale::{Density, Scale, density_of};
use crate::scene::textures::texel_plane::texel_borders::{BorderIndex, BorderSegment};
use crate::scene::textures::{ColourMap, PaintedTexture};

/// Picture as a view shows it.
#[derive(Debug)]
pub(crate) struct PictureLevels {
    /// Levels, the finest first.
    levels: Vec<PictureLevel>,
    /// Texel densities where the next level starts.
    ends: Vec<Density>,
    /// Texel densities at the corners of each face; empty if there is one level.
    densities: Vec<[Density; 3]>,
}

/// Picture at one scale.
#[derive(Debug)]
struct PictureLevel {
    map: Arc<ColourMap>,
    borders: BorderIndex,
}

/// Largest error of borders, px.
const MAX_BORDER_ERROR_PX: f64 = 0.15;

impl PictureLevels {
    /// Reduces a picture at the given scale; `smooth` makes its detail coarser by that factor. None if there
    /// is too much detail.
    ///
    /// With several levels, `densities` is evaluated.
    pub(crate) fn new(
        painted: &PaintedTexture,
        scale: &Scale,
        smooth: f64,
        densities: impl FnOnce() -> Vec<[Density; 3]>,
    ) -> Option<Self> {
        let of_one = |map: Arc<ColourMap>, texels_per_px: f64| {
            let per_px = texels_per_px * map.labels.texels.size[0] as f64 / painted.texels().size[0] as f64;
            let near =
                if per_px.is_finite() { (MAX_BORDER_ERROR_PX * per_px).clamp(0.005, 0.5) } else { 0.1 };
            Some(PictureLevel { borders: BorderIndex::new(map.borders()?, near), map })
        };
        let Some([first, last]) = scale.range.filter(|[first, last]| first < last) else {
            let level = of_one(painted.map(scale.mean * smooth), scale.mean)?;
            return Some(Self { levels: vec![level], ends: Vec::new(), densities: Vec::new() });
        };
        let texels_per_px = |power: i32| if power < 0 { 0.5_f64.powi(-power) } else { 2.0_f64.powi(power) };
        let powers: Vec<i32> = (first..=last).collect();
        let levels: Option<Vec<PictureLevel>> = powers
            .into_par_iter()
            .map(|power| {
                let texels_per_px = texels_per_px(power);
                of_one(painted.map_or_mean(texels_per_px * smooth), texels_per_px)
            })
            .collect();
        let ends = (first..last).map(|power| density_of(texels_per_px(power) * std::f64::consts::SQRT_2));
        Some(Self { levels: levels?, ends: ends.collect(), densities: densities() })
    }

    /// A face on the picture, with the given texture coordinates; none if these are invalid.
    pub(crate) fn on(&self, face: u32, uvs: [[f32; 2]; 3]) -> Option<PictureFace<'_>> {
        let densities = self.densities.get(face as usize).copied().unwrap_or_default();
        let on = PictureFace { drawn: self, uvs, densities };
        self.levels.iter().enumerate().all(|(level, _)| on.corners(level).is_some()).then_some(on)
    }
}

/// Position of a face on its picture.
#[derive(Clone, Copy)]
pub(crate) struct PictureFace<'a> {
    drawn: &'a PictureLevels,
    uvs: [[f32; 2]; 3],
    /// Texel densities at its corners.
    densities: [Density; 3],
}

impl PictureFace<'_> {
    /// Corners of the face in texel coordinates of a level.
    pub(crate) fn corners(&self, level: usize) -> Option<[DVec2; 3]> {
        let [a, b, c] = self.uvs.map(|uv| self.drawn.levels[level].map.labels.texels.place(uv));
        Some([a?, b?, c?])
    }

    /// Level at a point of the face: the coarser one of those that the two densities select.
    pub(crate) fn level(&self, weights: [f64; 3]) -> usize {
        let of = |which: usize| {
            let density = self.density(which, weights);
            self.drawn.ends.partition_point(|end| end[which] <= density)
        };
        of(0).max(of(1))
    }

    /// One of the two densities at a point of the face.
    fn density(&self, which: usize, weights: [f64; 3]) -> f64 {
        (0..3).map(|k| self.densities[k][which] * weights[k]).sum()
    }

    /// Range of levels that may occur on the face.
    pub(crate) fn levels(&self) -> std::ops::RangeInclusive<usize> {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|at| self.level(at));
        // The largest level occurs at a corner. The smallest may occur between corners, so the two densities
        // are bounded separately.
        let least = |which: usize| {
            let low = (0..3).map(|k| self.densities[k][which]).fold(f64::INFINITY, f64::min);
            self.drawn.ends.partition_point(|end| end[which] <= low)
        };
        least(0).max(least(1))..=corners.into_iter().max().unwrap_or_default()
    }

    /// Parameters between two points of the face where the level may change.
    pub(crate) fn level_ends(&self, ends: [[f64; 3]; 2]) -> Vec<f64> {
        let mut found = Vec::new();
        for which in 0..2 {
            let [a, b] = ends.map(|end| self.density(which, end));
            let crossed = self.drawn.ends.iter().filter(|end| (a >= end[which]) != (b >= end[which]));
            found.extend(crossed.map(|end| (end[which] - a) / (b - a)));
        }
        found.sort_by(f64::total_cmp);
        found
    }

    /// Lines on the face along which the level may change. Each runs between two of the given sides: the
    /// side's index, and the parameter on it.
    pub(crate) fn level_lines(&self, sides: &[[usize; 2]; 3]) -> Vec<[(usize, f64); 2]> {
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

    /// Palette index at a point of the face.
    pub(crate) fn colour(&self, weights: [f64; 3]) -> Option<u8> {
        let level = self.level(weights);
        let [a, b, c] = self.corners(level)?;
        Some(self.drawn.levels[level].map.labels.at(a * weights[0] + b * weights[1] + c * weights[2]))
    }

    /// Palette index at the centre of the face on a given level.
    pub(crate) fn middle_colour(&self, level: usize) -> Option<u8> {
        let [a, b, c] = self.corners(level)?;
        Some(self.drawn.levels[level].map.labels.at((a + b + c) / 3.0))
    }

    /// Colour borders of a level that may lie on the face, and the palette indices on both sides.
    pub(crate) fn borders(&self, level: usize) -> Vec<(BorderSegment, [u8; 2])> {
        let Some([a, b, c]) = self.corners(level) else { return Vec::new() };
        let make = |segment: BorderSegment, parted: [u8; 2]| (segment, parted);
        let borders = &self.drawn.levels[level].borders;
        borders.map_segments_in_box(a.min(b).min(c), a.max(b).max(c), make).unwrap_or_default()
    }
}
