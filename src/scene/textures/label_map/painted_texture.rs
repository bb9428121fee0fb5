//! [`PaintedTexture`]: the texture of a material, prepared for painting in a few colours.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;

use crate::parallel::prelude::*;

use super::blend_removal;
use super::colour_labels::ColourLabels;
use super::colour_map::{ColourMap, MapKey, MapScale};
use super::soft_assignment::SoftAssignment;
use super::speck_removal;
use super::texel_assignments::TexelAssignments;
use crate::colour::oklab::{self, Oklab, linear_table};
use crate::colour::srgb::Colour;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::Filter;
use crate::scene::textures::cache::result_cache::ResultCache;
use crate::scene::textures::texel_plane::TexelPlane;
use crate::scene::tolerances;

/// The texture of a material, prepared for painting in a few colours.
#[derive(Debug, Clone)]
pub(crate) struct PaintedTexture {
    pub(crate) texels: TexelPlane,
    pub(crate) colours: Vec<Colour>,
    /// Visible surface area of each texel.
    pub(crate) shown: Vec<f32>,
    /// The few colours.
    pub(crate) palette: Vec<Oklab>,
    /// Mean of the picture; its label follows those of the few colours.
    pub(crate) mean: Oklab,
    pub(crate) filter: Filter,
    /// Assignments and maps of earlier views.
    pub(crate) guesses: ResultCache<MapScale, TexelAssignments>,
    pub(crate) maps: ResultCache<MapKey, ColourMap>,
}

/// Standard deviation of the blur of borders, px. Narrower details disappear, and borders are rounded by
/// about as much.
const MIN_BLUR_PX: f64 = 0.7;

/// Minimum standard deviation of the blur, texels. Hides the steps of magnified texels.
const MIN_BLUR_TEXELS: f64 = 0.8;

/// Side of a square, px. Smaller regions are specks and are merged with a neighbour.
const MIN_REGION_SIDE_PX: f64 = 3.0;

/// Maximum share of specks in a picture. With more, the picture has no visible detail at this scale.
const MAX_SPECK_SHARE: f64 = 0.2;

/// Reduction factor for such a picture.
const DISTANT_SCALE: f64 = 8.0;

impl PaintedTexture {
    /// Layout of its texels.
    pub(crate) fn texels(&self) -> &TexelPlane {
        &self.texels
    }

    /// The few colours, in Oklab.
    pub(crate) fn palette(&self) -> &[Oklab] {
        &self.palette
    }

    /// Map of the colours at a resolution. If most details are smaller than specks, a coarser map that
    /// includes the mean colour.
    pub(crate) fn map_or_mean(&self, texels_per_px: f64) -> Arc<ColourMap> {
        let map = self.map_in(texels_per_px, false);
        if map.lost <= MAX_SPECK_SHARE { map } else { self.map_in(texels_per_px * DISTANT_SCALE, true) }
    }

    /// Map of the colours at a resolution, in texels per px.
    pub(crate) fn map(&self, texels_per_px: f64) -> Arc<ColourMap> {
        self.map_in(texels_per_px, false)
    }

    /// Map of the colours, with or without the mean colour.
    fn map_in(&self, texels_per_px: f64, with_mean: bool) -> Arc<ColourMap> {
        let scale =
            if texels_per_px.is_finite() { texels_per_px.max(tolerances::MIN_TEXELS_PER_PX) } else { 1.0 };
        // Halve until a texel is between 0.7 and 1.4 px.
        let halvings = (0..14).take_while(|k| scale / f64::from(1 << k) >= std::f64::consts::SQRT_2).count();
        let blocks = self.filter == Filter::Blocks && scale <= 1.0;
        let sight = MapScale { halvings, with_mean, blocks };
        if blocks {
            let made = || ColourMap::new(ColourLabels::blocks(&self.guesses(sight)), 0);
            return self.maps.get(MapKey { sight, blur: 0.0, least: 0.0 }, made);
        }
        let per_px = scale * self.size(halvings)[0] as f64 / self.texels.size[0] as f64;
        // Rounded up, as specks have whole numbers of texels.
        let least = (MIN_REGION_SIDE_PX * per_px).powi(2).ceil();
        let of = MapKey { sight, blur: (MIN_BLUR_PX * per_px).max(MIN_BLUR_TEXELS), least };
        self.maps.get(of, || {
            let guesses = self.guesses.get(sight, || self.guesses(sight));
            let mut labels = ColourLabels::of(&guesses, of.blur, self.colours_of(sight).len());
            let lost = speck_removal::merge_specks(&mut labels, of.least);
            ColourMap::new(labels, lost)
        })
    }

    /// The few colours, and the mean if it is one of them.
    fn colours_of(&self, sight: MapScale) -> Cow<'_, [Oklab]> {
        if sight.with_mean {
            self.palette.iter().copied().chain([self.mean]).collect()
        } else {
            Cow::Borrowed(&self.palette)
        }
    }

    /// Assigns each texel of the reduced picture to palette colours.
    fn guesses(&self, sight: MapScale) -> TexelAssignments {
        let palette = self.colours_of(sight);
        let (texels, labs) = self.reduced(sight.halvings);
        let mut guesses = assign_texels(&texels, &palette, &labs);
        if !sight.blocks {
            guesses = blend_removal::remove_blends(&texels, &palette, &labs, &guesses);
        }
        TexelAssignments::new(texels, guesses)
    }

    /// Size of the picture after halving.
    fn size(&self, halvings: usize) -> [usize; 2] {
        let times = 1 << halvings;
        self.texels.size.map(|count| ((count + times / 2) / times).max(1))
    }

    /// The picture reduced by halving: the mean of visible texels, or `None` if none is visible.
    fn reduced(&self, halvings: usize) -> (TexelPlane, Vec<Option<Oklab>>) {
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
        (TexelPlane { size, ..self.texels }, labs)
    }
}

/// The two nearest palette colours of each texel. Invisible texels copy the nearest visible one.
fn assign_texels(texels: &TexelPlane, palette: &[Oklab], labs: &[Option<Oklab>]) -> Vec<SoftAssignment> {
    let of = |lab: &Option<Oklab>| Some(SoftAssignment::of((*lab)?, palette));
    let known: Vec<Option<SoftAssignment>> = labs.par_iter().with_min_len(MIN_TASK_ITEMS).map(of).collect();
    let is_seen_beside_unseen = |texel: &usize| {
        known[*texel].is_some() && texels.beside(*texel).iter().any(|next| known[*next].is_none())
    };
    let all = (0..known.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    let mut open: VecDeque<usize> = all.filter(is_seen_beside_unseen).collect::<Vec<_>>().into();
    let mut guesses: Vec<SoftAssignment> = known
        .iter()
        .map(|guess| guess.unwrap_or(SoftAssignment { nearest: u8::MAX, second: 0, way: 0.0 }))
        .collect();
    while let Some(k) = open.pop_front() {
        for next in texels.beside(k) {
            if guesses[next].nearest == u8::MAX {
                guesses[next] = SoftAssignment { way: 0.0, ..guesses[k] };
                open.push_back(next);
            }
        }
    }
    guesses
}
