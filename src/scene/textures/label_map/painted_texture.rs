//! [`Painted`]: the texture of a material, to be painted in a few colours.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;

use crate::parallel::prelude::*;

use super::blend_removal;
use super::colour_labels::Labels;
use super::colour_map::{ColourMap, MapOf, Sight};
use super::soft_assignment::Guess;
use super::speck_removal;
use super::texel_assignments::Guesses;
use crate::colour::oklab::{self, Oklab, linear_table};
use crate::colour::srgb::Colour;
use crate::parallel::task_size::GRAIN;
use crate::scene::Filter;
use crate::scene::textures::result_cache::Kept;
use crate::scene::textures::texel_plane::Texels;

/// The texture of a material, to be painted in a few colours.
#[derive(Debug, Clone)]
pub(crate) struct Painted {
    pub(crate) texels: Texels,
    pub(crate) colours: Vec<Colour>,
    /// On how much of the surface each texel is seen.
    pub(crate) shown: Vec<f32>,
    /// The few colours.
    pub(crate) palette: Vec<Oklab>,
    /// How all of it looks from afar; the number of that is the one behind those of the few colours.
    pub(crate) mean: Oklab,
    pub(crate) filter: Filter,
    /// What was guessed of it, and the maps that were made, in views before.
    pub(crate) guesses: Kept<Sight, Guesses>,
    pub(crate) maps: Kept<MapOf, ColourMap>,
}

/// What is less wide than this many px is not drawn, and borders are rounded by about as much.
const BLUR_PX: f64 = 0.7;

/// However large texels are seen, borders are rounded by about this much of one: steps of texels are not drawn.
const BLUR_TEXELS: f64 = 0.8;

/// Specks smaller than a square with this side, px, go to a neighbour.
const SPECK_PX: f64 = 3.0;

/// Where more of a picture than this is specks, it has nothing to be drawn.
const MOST_LOST: f64 = 0.2;

/// A picture with nothing to be drawn is looked at from so many times farther away.
const AFAR: f64 = 8.0;

impl Painted {
    /// Texels in a row and rows, and how they are repeated.
    pub fn texels(&self) -> &Texels {
        &self.texels
    }

    /// How the few colours look.
    pub fn palette(&self) -> &[Oklab] {
        &self.palette
    }

    /// Which of the colours is where, as it can be seen where so many texels lie along a px; where hardly anything is as large
    /// as what is drawn, what it looks like in the mean.
    pub fn map_or_mean(&self, texels_per_px: f64) -> Arc<ColourMap> {
        let map = self.map_in(texels_per_px, false);
        if map.lost <= MOST_LOST { map } else { self.map_in(texels_per_px * AFAR, true) }
    }

    /// Which of the colours is where, as it can be seen where so many texels lie along a px.
    pub fn map(&self, texels_per_px: f64) -> Arc<ColourMap> {
        self.map_in(texels_per_px, false)
    }

    /// Which of the colours is where, or of these and the mean.
    fn map_in(&self, texels_per_px: f64, with_mean: bool) -> Arc<ColourMap> {
        let scale = if texels_per_px.is_finite() { texels_per_px.max(1e-3) } else { 1.0 };
        // As many as leave a px more than 0.7 texels, and less than 1.4.
        let halvings = (0..14).take_while(|k| scale / f64::from(1 << k) >= std::f64::consts::SQRT_2).count();
        let blocks = self.filter == Filter::Blocks && scale <= 1.0;
        let sight = Sight { halvings, with_mean, blocks };
        if blocks {
            let made = || ColourMap::new(Labels::blocks(&self.guesses(sight)), 0);
            return self.maps.get(MapOf { sight, blur: 0.0, least: 0.0 }, made);
        }
        let per_px = scale * self.size(halvings)[0] as f64 / self.texels.size[0] as f64;
        // Specks have whole numbers of texels.
        let least = (SPECK_PX * per_px).powi(2).ceil();
        let of = MapOf { sight, blur: (BLUR_PX * per_px).max(BLUR_TEXELS), least };
        self.maps.get(of, || {
            let guesses = self.guesses.get(sight, || self.guesses(sight));
            let mut labels = Labels::of(&guesses, of.blur, self.colours_of(sight).len());
            let lost = speck_removal::merge(&mut labels, of.least);
            ColourMap::new(labels, lost)
        })
    }

    /// The few colours, and how all of it looks from afar where that is one of them.
    fn colours_of(&self, sight: Sight) -> Cow<'_, [Oklab]> {
        if sight.with_mean {
            self.palette.iter().copied().chain([self.mean]).collect()
        } else {
            Cow::Borrowed(&self.palette)
        }
    }

    /// Between which colours each texel lies.
    fn guesses(&self, sight: Sight) -> Guesses {
        let palette = self.colours_of(sight);
        let (texels, labs) = self.reduced(sight.halvings);
        let mut guesses = guesses(&texels, &palette, &labs);
        if !sight.blocks {
            guesses = blend_removal::settle(&texels, &palette, &labs, &guesses);
        }
        Guesses::new(texels, guesses)
    }

    /// Texels in a row and rows when they are halved so often.
    fn size(&self, halvings: usize) -> [usize; 2] {
        let times = 1 << halvings;
        self.texels.size.map(|count| ((count + times / 2) / times).max(1))
    }

    /// The picture with texels that are halved so often along each side: how they look in the mean where they are seen at all.
    fn reduced(&self, halvings: usize) -> (Texels, Vec<Option<Oklab>>) {
        let table = linear_table();
        let size = self.size(halvings);
        let range = |k: usize, axis: usize| {
            let [count, coarse] = [self.texels.size[axis], size[axis]];
            k * count / coarse..((k + 1) * count / coarse).max(k * count / coarse + 1)
        };
        let mean = |texel: usize| {
            let (mut sum, mut all) = ([0.0_f32; 3], 0.0_f32);
            for j in range(texel / size[0], 1) {
                for i in range(texel % size[0], 0) {
                    let at = j * self.texels.size[0] + i;
                    if self.shown[at] > 0.0 {
                        let Colour { r, g, b, .. } = self.colours[at];
                        sum.iter_mut().zip([r, g, b]).for_each(|(sum, c)| *sum += table[c as usize]);
                        all += 1.0;
                    }
                }
            }
            (all > 0.0).then(|| oklab::of_linear(sum.map(|sum| sum / all)))
        };
        let labs = (0..size[0] * size[1]).into_par_iter().with_min_len(1 << 10).map(mean).collect();
        (Texels { size, ..self.texels }, labs)
    }
}

/// For each texel the colour it is nearest to, the next nearest, and how far it lies on the way to that, 0 to 1/2. What is
/// seen nowhere is like what is seen beside it.
fn guesses(texels: &Texels, palette: &[Oklab], labs: &[Option<Oklab>]) -> Vec<Guess> {
    let of = |lab: &Option<Oklab>| Some(Guess::of((*lab)?, palette));
    let known: Vec<Option<Guess>> = labs.par_iter().with_min_len(GRAIN).map(of).collect();
    let is_seen_beside_unseen = |texel: &usize| {
        known[*texel].is_some() && texels.beside(*texel).iter().any(|next| known[*next].is_none())
    };
    let all = (0..known.len()).into_par_iter().with_min_len(GRAIN);
    let mut open: VecDeque<usize> = all.filter(is_seen_beside_unseen).collect::<Vec<_>>().into();
    let mut guesses: Vec<Guess> =
        known.iter().map(|guess| guess.unwrap_or(Guess { nearest: u8::MAX, second: 0, way: 0.0 })).collect();
    while let Some(k) = open.pop_front() {
        for next in texels.beside(k) {
            if guesses[next].nearest == u8::MAX {
                guesses[next] = Guess { way: 0.0, ..guesses[k] };
                open.push_back(next);
            }
        }
    }
    guesses
}
