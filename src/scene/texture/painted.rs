//! [`Painted`]: the texture of a material, to be painted in a few colours.

use std::collections::VecDeque;

use rayon::prelude::*;

use super::blends;
use super::guess::Guess;
use super::labels::Labels;
use super::specks;
use crate::math::colour::Colour;
use crate::math::grain::GRAIN;
use crate::math::oklab::{self, Oklab, linear_table};
use crate::scene::Filter;
use crate::scene::texels::Texels;

/// The texture of a material, to be painted in a few colours.
#[derive(Debug, Clone)]
pub(crate) struct Painted {
    pub(super) texels: Texels,
    pub(super) colours: Vec<Colour>,
    /// On how much of the surface each texel is seen.
    pub(super) shown: Vec<f32>,
    /// The few colours.
    pub(super) palette: Vec<Oklab>,
    /// How all of it looks from afar; the number of that is the one behind those of the few colours.
    pub(super) mean: Oklab,
    pub(super) filter: Filter,
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
    pub fn labels_or_mean(&self, texels_per_px: f64) -> Labels {
        let (labels, lost) = self.labels_and_lost(texels_per_px, &self.palette);
        if lost <= MOST_LOST {
            return labels;
        }
        let mut palette = self.palette.clone();
        palette.push(self.mean);
        self.labels_and_lost(texels_per_px * AFAR, &palette).0
    }

    /// Which of the colours is where, as it can be seen where so many texels lie along a px.
    pub fn labels(&self, texels_per_px: f64) -> Labels {
        self.labels_and_lost(texels_per_px, &self.palette).0
    }

    /// Which of some colours is where, and on how much of the picture specks were lost.
    fn labels_and_lost(&self, texels_per_px: f64, palette: &[Oklab]) -> (Labels, f64) {
        let scale = if texels_per_px.is_finite() { texels_per_px.max(1e-3) } else { 1.0 };
        // As many as leave a px more than 0.7 texels, and less than 1.4.
        let halvings = (0..14).take_while(|k| scale / f64::from(1 << k) >= std::f64::consts::SQRT_2).count();
        let (texels, lights) = self.reduced(1 << halvings);
        let per_px = scale * texels.size[0] as f64 / self.texels.size[0] as f64;
        let labs: Vec<Option<Oklab>> =
            lights.into_par_iter().with_min_len(GRAIN).map(|light| light.map(oklab::of_linear)).collect();
        let guesses = guesses(&texels, palette, &labs);
        if self.filter == Filter::Blocks && scale <= 1.0 {
            return (Labels::blocks(texels, &guesses), 0.0);
        }
        let guesses = blends::settle(&texels, palette, &labs, &guesses);
        let blur = (BLUR_PX * per_px).max(BLUR_TEXELS);
        let mut labels = Labels::of(texels, &guesses, blur, palette.len());
        let lost = specks::merge(&mut labels, (SPECK_PX * per_px).powi(2));
        (labels, lost as f64 / (texels.size[0] * texels.size[1]) as f64)
    }

    /// The picture with so many times fewer texels along each side: their mean light where they are seen at all.
    fn reduced(&self, times: usize) -> (Texels, Vec<Option<[f32; 3]>>) {
        let table = linear_table();
        let size = self.texels.size.map(|count| ((count + times / 2) / times).max(1));
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
            (all > 0.0).then(|| sum.map(|sum| sum / all))
        };
        let lights = (0..size[0] * size[1]).into_par_iter().with_min_len(1 << 10).map(mean).collect();
        (Texels { size, ..self.texels }, lights)
    }
}

/// For each texel the colour it is nearest to, the next nearest, and how far it lies on the way to that, 0 to 1/2. What is
/// seen nowhere is like what is seen beside it.
fn guesses(texels: &Texels, palette: &[Oklab], labs: &[Option<Oklab>]) -> Vec<Guess> {
    let of = |lab: &Option<Oklab>| Some(Guess::of((*lab)?, palette));
    let known: Vec<Option<Guess>> = labs.par_iter().with_min_len(GRAIN).map(of).collect();
    let mut open: VecDeque<usize> = (0..known.len()).filter(|k| known[*k].is_some()).collect();
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
