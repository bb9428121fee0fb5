//! [`remove_blends`]: removes false colours from texels that blend two neighbouring colours.
//!
//! Between two areas of a picture, texels have intermediate colours. Some of these are closest to an
//! unrelated palette colour, which would surround every area with a thin rim.

use crate::parallel::prelude::*;

use super::soft_assignment::SoftAssignment;
use crate::colour::oklab::{Oklab, distance2};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::textures::texel_plane::TexelPlane;

/// Maximum distance in Oklab between a blended colour and the segment of the two colours that it blends.
const MAX_BLEND_DISTANCE: f32 = 0.07;

/// Assigns blended texels to one of the two colours that they blend, with the position between them.
pub(crate) fn remove_blends(
    texels: &TexelPlane,
    palette: &[Oklab],
    labs: &[Option<Oklab>],
    guesses: &[SoftAssignment],
) -> Vec<SoftAssignment> {
    let width = texels.size[0];
    let at =
        |texel: usize, i: i64, j: i64| texels.index((texel % width) as i64 + i, (texel / width) as i64 + j);
    // A core texel has the colour of a 2 x 2 square that contains it.
    let is_core = |texel: usize| {
        let own = guesses[texel].nearest;
        let is_own = |i: i64, j: i64| guesses[at(texel, i, j)].nearest == own;
        [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            .iter()
            .any(|(i, j)| is_own(*i, 0) && is_own(0, *j) && is_own(*i, *j))
    };
    let is_even = |texel: usize| {
        let own = guesses[texel];
        own.way == 0.0 && texels.beside(texel).iter().all(|next| guesses[*next].nearest == own.nearest)
    };
    let cores: Vec<bool> = (0..guesses.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|texel| is_even(texel) || is_core(texel))
        .collect();
    let of = |texel: usize| {
        let own = guesses[texel];
        let Some(lab) = labs[texel].filter(|_| !is_even(texel)) else { return own };
        let around = RING_OFFSETS.map(|(i, j)| at(texel, i, j));
        let around = || around.into_iter().filter(|next| cores[*next]).map(|next| guesses[next].nearest);
        let is_own = cores[texel];
        let mut best: Option<(f32, SoftAssignment)> = None;
        for first in around().chain([own.nearest]).filter(|first| is_own == (*first == own.nearest)) {
            for second in around().filter(|second| *second != first && (is_own || *second != own.nearest)) {
                let (beside, way) =
                    distance_to_segment(lab, palette[first as usize], palette[second as usize]);
                if way <= 0.5 && best.as_ref().is_none_or(|(least, _)| beside < *least) {
                    best = Some((beside, SoftAssignment { nearest: first, second, way }));
                }
            }
        }
        match best {
            Some((far, guess)) if far < MAX_BLEND_DISTANCE => guess,
            _ => SoftAssignment { way: 0.0, ..own },
        }
    };
    (0..guesses.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).map(of).collect()
}

/// Offsets of the eight surrounding texels.
const RING_OFFSETS: [(i64, i64); 8] = [(-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0)];

/// Distance of a colour from the segment between two others, and the position along it, 0 to 1.
fn distance_to_segment(lab: Oklab, a: Oklab, b: Oklab) -> (f32, f32) {
    let along: f32 = (0..3).map(|c| (lab[c] - a[c]) * (b[c] - a[c])).sum();
    let way = (along / distance2(a, b).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    let foot: Oklab = std::array::from_fn(|c| a[c] + (b[c] - a[c]) * way);
    (distance2(lab, foot).sqrt(), way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::Wrap;

    #[test]
    fn remove_blends_clears_a_grey_rim_between_black_and_white() {
        let palette = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]];
        let texels = TexelPlane {
            size: [7, 4],
            wrap: [Wrap::Clamp; 2],
            upward: false,
            placing: crate::scene::material::Placing::default(),
        };
        let row = [0.0, 0.0, 0.0, 0.6, 1.0, 1.0, 1.0];
        let labs: Vec<Option<Oklab>> = (0..28).map(|k| Some([row[k % 7], 0.0, 0.0])).collect();
        let guess = |k: usize| match row[k % 7] {
            0.0 => SoftAssignment { nearest: 0, second: 2, way: 0.0 },
            1.0 => SoftAssignment { nearest: 1, second: 2, way: 0.0 },
            _ => SoftAssignment { nearest: 2, second: 1, way: 0.2 },
        };
        let guesses: Vec<SoftAssignment> = (0..28).map(guess).collect();
        let settled = remove_blends(&texels, &palette, &labs, &guesses);
        assert_eq!((settled[10].nearest, settled[10].second), (1, 0));
        assert!((settled[10].way - 0.4).abs() < 1e-6);
        // A stripe two texels wide is kept.
        let wide: Vec<SoftAssignment> = (0..28)
            .map(|k| SoftAssignment { nearest: [0, 0, 2, 2, 1, 1, 1][k % 7], second: 0, way: 0.0 })
            .collect();
        let settled = remove_blends(&texels, &palette, &labs, &wide);
        assert_eq!((settled[9].nearest, settled[10].nearest), (2, 2));
    }
}
