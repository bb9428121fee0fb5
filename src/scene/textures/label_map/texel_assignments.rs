//! [`TexelAssignments`]: the two nearest palette colours of each texel of a picture.

use crate::parallel::prelude::*;

use super::soft_assignment::SoftAssignment;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::textures::texel_plane::TexelPlane;

/// The two nearest palette colours of each texel, with the distance of each texel to a border.
#[derive(Debug)]
pub(crate) struct TexelAssignments {
    pub texels: TexelPlane,
    pub list: Vec<SoftAssignment>,
    /// For each texel, the number of steps to a texel of another colour, less one; at most [`OUT_OF_BLUR_STEPS`].
    to_border: Vec<u8>,
}

/// Maximum reach of the blur of borders, texels.
pub(crate) const MAX_BLUR_TEXELS: u8 = 4;

/// Value for texels out of reach of any blur.
const OUT_OF_BLUR_STEPS: u8 = MAX_BLUR_TEXELS + 1;

impl TexelAssignments {
    pub(crate) fn new(texels: TexelPlane, list: Vec<SoftAssignment>) -> Self {
        let differs =
            |texel: usize| texels.beside(texel).iter().any(|next| list[*next].nearest != list[texel].nearest);
        let all = || (0..list.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        let mut to_border: Vec<u8> =
            all().map(|texel| if differs(texel) { 0 } else { OUT_OF_BLUR_STEPS }).collect();
        let mut ring: Vec<usize> = all().filter(|texel| to_border[*texel] == 0).collect();
        for steps in 1..OUT_OF_BLUR_STEPS {
            let mut next = Vec::new();
            for texel in ring.iter().flat_map(|texel| texels.beside(*texel)) {
                if to_border[texel] == OUT_OF_BLUR_STEPS {
                    to_border[texel] = steps;
                    next.push(texel);
                }
            }
            ring = next;
        }
        Self { texels, list, to_border }
    }

    /// Texels, in order, that a blur of the given reach mixes with another colour. Without a blur, those that
    /// are mixed already.
    pub(crate) fn mixed(&self, reach: u8) -> Vec<usize> {
        let is_mixed =
            |texel: &usize| self.to_border[*texel] <= reach || (reach == 0 && self.list[*texel].way != 0.0);
        (0..self.list.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).filter(is_mixed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::{Placing, Wrap};

    #[test]
    fn mixed_texels_are_those_within_the_blur_of_a_border() {
        // Patches of three colours over 23 x 17 texels; some texels are mixed already.
        let guess = |k: usize| {
            let dice = (k % 23 / 6 * 7919 + k / 23 / 5 * 104_729).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 33;
            SoftAssignment { nearest: (dice % 3) as u8, second: 0, way: if k % 7 == 3 { 0.2 } else { 0.0 } }
        };
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let texels =
                TexelPlane { size: [23, 17], wrap: [wrap; 2], upward: false, placing: Placing::default() };
            let list: Vec<SoftAssignment> = (0..23 * 17).map(guess).collect();
            let guesses = TexelAssignments::new(texels, list.clone());
            // The reference grows the set of border texels step by step.
            let mut near: Vec<bool> = (0..list.len())
                .map(|k| texels.beside(k).iter().any(|next| list[*next].nearest != list[k].nearest))
                .collect();
            for reach in 0..=MAX_BLUR_TEXELS {
                let expected: Vec<usize> =
                    (0..list.len()).filter(|k| near[*k] || (reach == 0 && list[*k].way != 0.0)).collect();
                assert_eq!(guesses.mixed(reach), expected, "{wrap:?}, {reach}");
                near = (0..near.len())
                    .map(|k| near[k] || texels.beside(k).iter().any(|next| near[*next]))
                    .collect();
            }
        }
    }
}
