//! [`merge_specks`]: merges specks, small connected regions of one colour label, with a neighbouring region.
//!
//! Regions continue across the seams of repeated textures. Sizes are in texels.

use crate::parallel::prelude::*;

use super::colour_labels::ColourLabels;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Gives each connected region of fewer than `min_size` texels the label of the neighbour with the longest
/// common border, smallest regions first. Returns the number of texels that the first pass changes.
pub(crate) fn merge_specks(labels: &mut ColourLabels, min_size: f64) -> usize {
    let first = merge_once(labels, min_size);
    // A speck may have taken the label of another speck, so a merged region may still be too small.
    if first > 0 && merge_once(labels, min_size) > 0 {
        merge_once(labels, min_size);
    }
    first
}

/// One pass over all specks. Returns the number of texels whose label changes.
fn merge_once(labels: &mut ColourLabels, min_size: f64) -> usize {
    let texels = labels.texels;
    let mut small = small_components(labels, min_size);
    small.sort_by_key(|speck| (speck.len(), speck[0]));
    let mut changed = 0;
    for speck in small {
        let colour = labels.winner(speck[0]);
        let mut shared: Vec<(u8, usize)> = Vec::new();
        for next in speck.iter().flat_map(|texel| texels.beside(*texel)) {
            let neighbour_colour = labels.winner(next);
            if neighbour_colour == colour {
                continue;
            }
            match shared.iter_mut().find(|(counted_colour, _)| *counted_colour == neighbour_colour) {
                Some((_, length)) => *length += 1,
                None => shared.push((neighbour_colour, 1)),
            }
        }
        if let Some((other, _)) =
            shared.iter().max_by_key(|(other, length)| (*length, std::cmp::Reverse(*other)))
        {
            speck.iter().for_each(|texel| labels.repaint(*texel, *other));
            changed += speck.len();
        }
    }
    changed
}

/// Connected regions of fewer than `min_size` texels, each in ascending order.
///
/// The search starts at borders and stops when a region is large enough, so most texels are never visited.
fn small_components(labels: &ColourLabels, min_size: f64) -> Vec<Vec<usize>> {
    let texels = labels.texels;
    let count = texels.size[0] * texels.size[1];
    let at_border = |texel: &usize| {
        texels.beside(*texel).iter().any(|next| labels.winner(*next) != labels.winner(*texel))
    };
    let border: Vec<usize> =
        (0..count).into_par_iter().with_min_len(MIN_TASK_ITEMS).filter(at_border).collect();
    let mut states = vec![SpeckState::Not; count];
    let mut small: Vec<Vec<usize>> = Vec::new();
    let mut component: Vec<usize> = Vec::new();
    for first in border {
        if states[first] != SpeckState::Not {
            continue;
        }
        let colour = labels.winner(first);
        states[first] = SpeckState::Small;
        component.clear();
        component.push(first);
        let mut at = 0;
        let mut is_small = true;
        while is_small && at < component.len() && (component.len() as f64) < min_size {
            for next in texels.beside(component[at]) {
                if labels.winner(next) != colour {
                    continue;
                }
                match states[next] {
                    SpeckState::Not => {
                        states[next] = SpeckState::Small;
                        component.push(next);
                    }
                    SpeckState::Small => {}
                    SpeckState::Large => is_small = false,
                }
            }
            at += 1;
        }
        if is_small && (component.len() as f64) < min_size {
            component.sort_unstable();
            small.push(component.clone());
        } else {
            component.iter().for_each(|texel| states[*texel] = SpeckState::Large);
        }
    }
    small
}

/// State of a texel in the search: not visited, part of a small region so far, or part of a large one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SpeckState {
    Not,
    Small,
    Large,
}

#[cfg(test)]
mod tests {
    use super::super::soft_assignment::SoftAssignment;
    use super::super::texel_assignments::TexelAssignments;
    use super::*;
    use crate::scene::material::Wrap;
    use crate::scene::textures::texel_plane::TexelPlane;

    #[test]
    fn merge_specks_recolours_specks_across_wrapped_seams() {
        // A speck of four texels across the corners of the picture, one of two, and a patch of nine.
        let colour = |k: usize| match (k % 12, k / 12) {
            (0 | 11, 0 | 11) => 1,
            (5, 5 | 6) => 2,
            (8..=10, 2..=4) => 1,
            _ => 0,
        };
        let guesses: Vec<SoftAssignment> =
            (0..144).map(|k| SoftAssignment { nearest: colour(k), second: 0, way: 0.0 }).collect();
        let texels = TexelPlane {
            size: [12, 12],
            wrap: [Wrap::Repeat; 2],
            upward: false,
            placing: crate::scene::material::Placing::default(),
        };
        let guesses = TexelAssignments::new(texels, guesses);
        let merged = |least: f64| {
            let mut labels = ColourLabels::of(&guesses, 0.0, 3);
            merge_specks(&mut labels, least);
            [0, 5 * 12 + 5, 3 * 12 + 9].map(|texel| labels.winner(texel))
        };
        assert_eq!(merged(4.0), [1, 0, 1]);
        assert_eq!(merged(5.0), [0, 0, 1]);
        assert_eq!(merged(10.0), [0, 0, 0]);
    }

    /// Reference: follows every region completely.
    fn small_by_flood_fill(labels: &ColourLabels, least: f64) -> Vec<Vec<usize>> {
        let count = labels.texels.size[0] * labels.texels.size[1];
        let mut is_known = vec![false; count];
        let mut small = Vec::new();
        for first in 0..count {
            let (mut own, mut open) = (Vec::new(), vec![first]);
            while let Some(texel) = open.pop() {
                if !std::mem::replace(&mut is_known[texel], true) {
                    own.push(texel);
                    let beside = labels.texels.beside(texel);
                    open.extend(beside.iter().filter(|next| labels.winner(**next) == labels.winner(first)));
                }
            }
            own.sort_unstable();
            if !own.is_empty() && (own.len() as f64) < least {
                small.push(own);
            }
        }
        small
    }

    #[test]
    fn small_components_match_a_full_flood_fill() {
        let dice = |k: usize| {
            (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(31).wrapping_mul(0x94d0_49bb)
        };
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for [patch, least] in [[1, 2], [1, 5], [2, 9], [3, 18], [9, 60], [40, 7]] {
                let size = [31, 22];
                let guess = |k: usize| {
                    let colour = dice(k % size[0] / patch * 977 + k / size[0] / patch) >> 40;
                    SoftAssignment { nearest: (colour % 3) as u8, second: 0, way: 0.0 }
                };
                let texels = TexelPlane {
                    size,
                    wrap: [wrap; 2],
                    upward: false,
                    placing: crate::scene::material::Placing::default(),
                };
                let guesses = TexelAssignments::new(texels, (0..size[0] * size[1]).map(guess).collect());
                let labels = ColourLabels::of(&guesses, 0.0, 3);
                let mut found = small_components(&labels, least as f64);
                found.sort_unstable_by_key(|speck| speck[0]);
                assert_eq!(found, small_by_flood_fill(&labels, least as f64), "{wrap:?}, {patch}, {least}");
            }
        }
    }
}
