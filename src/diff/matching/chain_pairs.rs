//! Pairs polylines (chains) of the old and the new drawing that are the same mark, moved or reshaped.
//!
//! Input: the chains of both drawings in px, with the stretches that the other drawing already covers.
//! Output: one-to-one pairs of chains that are not completely covered.
//!
//! 1. Candidates: for each chain, the nearest chains of the other drawing around a few sample points, and the
//!    chains that cover a part of it. The ones with the nearest ends are kept.
//! 2. Each candidate pair is aligned. Its cost is the largest distance of corresponding points, increased if
//!    label or ink differ, and reduced by the share that coincides.
//! 3. Pairs are taken greedily, lowest cost first.
//! 4. Each closed chain that is left is paired with the only congruent one in the other drawing, at any
//!    distance.
//! 5. The n-th copies of a chain are paired like the first ones.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::diff::tolerances;
use crate::parallel::prelude::*;
use kurbo::Point;
use rustc_hash::FxHashMap;

use super::interval_cover::{ChainCover, CoveredChains};
use crate::diff::curves::chain::OutlineChain;
use crate::diff::curves::chain_alignment::{Alignment, align};
use crate::diff::curves::hausdorff_distance::evenly_spaced_points;
use crate::diff::curves::segment::{bounds, nearest_on};
use crate::diff::curves::segment_grid::SegmentGrid;
use crate::diff::shapes::mark_groups::{Likeness, MarkGroups};

/// Largest distance between an old and a new mark, as a share of the page's longer side.
const MAX_SHIFT_PAGE_SHARE: f64 = 0.03;
/// Distance that is always allowed, even for tiny marks, as a share of the page's longer side.
const MIN_SHIFT_PAGE_SHARE: f64 = 0.006;
/// Largest distance as a share of the mark's own size.
const MAX_SHIFT_MARK_SHARE: f64 = 0.5;
/// Two chains that coincide over this share of their length are the same mark, however far apart the rest is.
const MIN_COMMON_SHARE: f64 = 0.2;
/// Maximum number of sample points per chain when searching for candidates.
const SAMPLES_PER_CHAIN: usize = 5;
/// Neighbours searched per sample point.
const NEIGHBOURS_PER_SAMPLE: usize = 4;
/// Maximum number of candidates aligned per chain.
const MAX_CANDIDATES: usize = 6;
/// Maximum number of closed chains of similar length compared with each chain.
const MAX_CONGRUENT: usize = 64;
/// Maximum number of segments visited per sample point. Where thousands coincide, any of them will do.
const MAX_SEGMENTS_PER_SAMPLE: usize = 512;

/// Two chains that are the same mark: indices in the old and the new drawing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChainPair {
    pub old: usize,
    pub new: usize,
    pub alignment: Alignment,
    cost: f64,
}

/// Pairs chains with uncovered runs one to one, lowest cost first. `page` is the page's longer side in px.
pub(crate) fn pairs(sides: &[CoveredChains; 2], groups: &MarkGroups, page: f64) -> Vec<ChainPair> {
    let uncovered: [Vec<usize>; 2] = [0, 1].map(|side: usize| {
        let covers = &sides[side].covers;
        (0..covers.len())
            .filter(|index| !covers[*index].is_whole() && sides[side].firsts[*index] == *index)
            .collect()
    });
    if uncovered.iter().any(Vec::is_empty) {
        return Vec::new();
    }
    let mut candidate_pairs: Vec<(usize, usize)> = Vec::new();
    for side in 0..2 {
        let other_side = 1 - side;
        let targets: Vec<OutlineChain> =
            uncovered[other_side].iter().map(|index| sides[other_side].chains[*index].clone()).collect();
        let grid = SegmentGrid::new(&targets);
        let pairs_of_chain = |index: &usize| {
            let mut partner_indices =
                candidates(&sides[side], *index, &uncovered[other_side], &grid, page * MAX_SHIFT_PAGE_SHARE);
            let chain = &sides[side].chains[*index];
            partner_indices.sort_by_cached_key(|partner| {
                squared_end_distance(chain, &sides[other_side].chains[*partner]).to_bits()
            });
            partner_indices.truncate(MAX_CANDIDATES);
            let index = *index;
            partner_indices.into_iter().map(move |partner_index| {
                if side == 0 { (index, partner_index) } else { (partner_index, index) }
            })
        };
        candidate_pairs.par_extend(uncovered[side].par_iter().flat_map_iter(pairs_of_chain));
    }
    candidate_pairs.par_sort_unstable();
    candidate_pairs.dedup();
    let mut chosen_pairs: Vec<ChainPair> = candidate_pairs
        .into_par_iter()
        .filter_map(|(old, new)| score_pair(sides, old, new, groups, page))
        .collect();
    chosen_pairs.sort_by(|a, b| a.cost.total_cmp(&b.cost).then_with(|| tie(sides, a, b)));
    let mut is_unpaired = [vec![true; sides[0].chains.len()], vec![true; sides[1].chains.len()]];
    chosen_pairs.retain(|pair| {
        let are_both_unpaired = is_unpaired[0][pair.old] && is_unpaired[1][pair.new];
        if are_both_unpaired {
            (is_unpaired[0][pair.old], is_unpaired[1][pair.new]) = (false, false);
        }
        are_both_unpaired
    });
    chosen_pairs.extend(congruent(sides, groups, &uncovered, &mut is_unpaired));
    let copies = |pair: &ChainPair| {
        let is_copy =
            |side: usize, original: usize, copy: usize| sides[side].firsts.get(copy) == Some(&original);
        let (old, new, pair) = (pair.old, pair.new, *pair);
        (1..)
            .take_while(move |rank| is_copy(0, old, old + rank) && is_copy(1, new, new + rank))
            .map(move |rank| ChainPair { old: old + rank, new: new + rank, ..pair })
    };
    let copied_pairs: Vec<ChainPair> = chosen_pairs.iter().flat_map(copies).collect();
    chosen_pairs.extend(copied_pairs);
    chosen_pairs
}

/// Pairs remaining closed chains with the only congruent one in the other drawing, at any distance.
fn congruent(
    sides: &[CoveredChains; 2],
    groups: &MarkGroups,
    uncovered: &[Vec<usize>; 2],
    is_unpaired: &mut [Vec<bool>; 2],
) -> Vec<ChainPair> {
    let chains_by_length = [0, 1].map(|side: usize| -> Vec<(f64, usize)> {
        let chains = &sides[side].chains;
        let is_candidate = |index: &&usize| {
            let is_closed = chains[**index].points.first() == chains[**index].points.last();
            is_closed && is_unpaired[side][**index] && sides[side].covers[**index].partners.is_empty()
        };
        let mut lengths_and_indices: Vec<(f64, usize)> = uncovered[side]
            .iter()
            .filter(is_candidate)
            .map(|index| (chains[*index].length(), *index))
            .collect();
        lengths_and_indices.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        lengths_and_indices
    });
    let tolerance = |index: usize| groups.tolerance(sides[0].chains[index].group);
    let mut partners_by_chain: [BTreeMap<usize, Vec<usize>>; 2] = Default::default();
    let mut pairs = Vec::new();
    for (length, old) in &chains_by_length[0] {
        // If every point moves by up to the tolerance, the length changes little.
        let max_difference = 4.0 * tolerance(*old) + tolerances::MAX_CONGRUENT_OFFSET_OF_LENGTH * length;
        let first_candidate = chains_by_length[1]
            .partition_point(|(candidate_length, _)| *candidate_length < length - max_difference);
        for (_, new) in chains_by_length[1]
            .iter()
            .skip(first_candidate)
            .take(MAX_CONGRUENT)
            .take_while(|(next_length, _)| *next_length <= length + max_difference)
        {
            let (a, b) = (&sides[0].chains[*old], &sides[1].chains[*new]);
            if groups.likeness(a.group, b.group) != Some(Likeness::Same) {
                continue;
            }
            let alignment = align(a, b);
            if alignment.after_shift
                <= 2.0 * tolerance(*old) + tolerances::MAX_CONGRUENT_OFFSET_OF_LENGTH * length
            {
                partners_by_chain[0].entry(*old).or_default().push(*new);
                partners_by_chain[1].entry(*new).or_default().push(*old);
                pairs.push(ChainPair { old: *old, new: *new, alignment, cost: alignment.largest });
            }
        }
    }
    let has_single_partner =
        |side: usize, index: usize| partners_by_chain[side].get(&index).is_some_and(|list| list.len() == 1);
    pairs.retain(|pair| has_single_partner(0, pair.old) && has_single_partner(1, pair.new));
    for pair in &pairs {
        (is_unpaired[0][pair.old], is_unpaired[1][pair.new]) = (false, false);
    }
    pairs
}

/// Order of pairs with equal cost: by the lesser start point of both chains, then by the greater one. It is
/// the same if the drawings are swapped.
fn tie(sides: &[CoveredChains; 2], a: &ChainPair, b: &ChainPair) -> Ordering {
    let key = |pair: &ChainPair| {
        let start = |side: usize, index: usize| {
            let p = sides[side].chains[index].points.first().copied().unwrap_or(Point::ZERO);
            (p.x.to_bits(), p.y.to_bits())
        };
        let (old, new) = (start(0, pair.old), start(1, pair.new));
        (old.min(new), old.max(new))
    };
    key(a).cmp(&key(b)).then((a.old, a.new).cmp(&(b.old, b.new)))
}

/// Indices of the chains of the other drawing that are near a chain or cover a part of it, among the
/// uncovered ones in `uncovered`. `max_distance` is the largest distance in px.
fn candidates(
    side: &CoveredChains,
    index: usize,
    uncovered: &[usize],
    grid: &SegmentGrid,
    max_distance: f64,
) -> Vec<usize> {
    let chain = &side.chains[index];
    let partners = side.covers[index].partners.iter().map(|(partner, ..)| *partner as usize);
    let mut candidate_indices: Vec<usize> =
        partners.filter(|partner| uncovered.binary_search(partner).is_ok()).collect();
    let index_by_chain: RefCell<FxHashMap<u32, usize>> = RefCell::default();
    for sample_point in evenly_spaced_points(chain, (chain.points.len() + 1).min(SAMPLES_PER_CHAIN)) {
        // Nearby chains with their distances.
        let neighbours: RefCell<Vec<(f64, u32)>> = RefCell::default();
        index_by_chain.borrow_mut().clear();
        let visit_segment = |item: u32| {
            let segment = grid.segments[item as usize];
            let distance = sample_point.distance(nearest_on(segment.from, segment.to, sample_point));
            if distance > max_distance {
                return;
            }
            let mut neighbour_list = neighbours.borrow_mut();
            let neighbour_index =
                *index_by_chain.borrow_mut().entry(segment.chain).or_insert(neighbour_list.len());
            match neighbour_list.get_mut(neighbour_index) {
                Some(entry) => entry.0 = entry.0.min(distance),
                None => neighbour_list.push((distance, segment.chain)),
            }
        };
        let has_enough_neighbours = |searched_radius: f64| {
            neighbours.borrow().iter().filter(|(distance, _)| *distance <= searched_radius).count()
                >= NEIGHBOURS_PER_SAMPLE
        };
        grid.visit_rings(
            sample_point,
            (max_distance, MAX_SEGMENTS_PER_SAMPLE),
            visit_segment,
            has_enough_neighbours,
        );
        let mut nearest_chains = neighbours.into_inner();
        let nearest = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        if nearest_chains.len() > 2 * NEIGHBOURS_PER_SAMPLE {
            nearest_chains.select_nth_unstable_by(2 * NEIGHBOURS_PER_SAMPLE, nearest);
            nearest_chains.truncate(2 * NEIGHBOURS_PER_SAMPLE);
        }
        candidate_indices.extend(nearest_chains.iter().map(|(_, chain)| uncovered[*chain as usize]));
    }
    candidate_indices.sort_unstable();
    candidate_indices.dedup();
    candidate_indices
}

/// Sum of the squared distances between the ends of two chains: a cheap estimate for ranking candidates. The
/// second end of a closed chain is its middle point.
fn squared_end_distance(a: &OutlineChain, b: &OutlineChain) -> f64 {
    let ends = |chain: &OutlineChain| {
        let start = chain.points.first().copied().unwrap_or(Point::ZERO);
        let end = if chain.closed { chain.points.get(chain.points.len() / 2) } else { chain.points.last() };
        (start, end.copied().unwrap_or(start))
    };
    let ((a0, a1), (b0, b1)) = (ends(a), ends(b));
    let same_direction_distance = a0.distance_squared(b0) + a1.distance_squared(b1);
    same_direction_distance.min(a0.distance_squared(b1) + a1.distance_squared(b0))
}

/// Aligns two chains and computes the cost of the pair; `None` if they cannot be the same mark.
fn score_pair(
    sides: &[CoveredChains; 2],
    old: usize,
    new: usize,
    groups: &MarkGroups,
    page: f64,
) -> Option<ChainPair> {
    let (a, b) = (&sides[0].chains[old], &sides[1].chains[new]);
    let likeness = groups.likeness(a.group, b.group)?;
    let (cover_a, cover_b) = (&sides[0].covers[old], &sides[1].covers[new]);
    let covered_length = |cover: &ChainCover, partner: usize| {
        cover.partners.iter().find(|(p, ..)| *p as usize == partner).map_or(0.0, |(.., length)| *length)
    };
    let total_length = cover_a.length + cover_b.length;
    let common_share = if total_length > 0.0 {
        (covered_length(cover_a, new) + covered_length(cover_b, old)) / total_length
    } else {
        0.0
    };
    let alignment = align(a, b);
    let size = |chain: &OutlineChain| bounds(&chain.points).size().to_vec2().hypot();
    let max_offset = (MAX_SHIFT_MARK_SHARE * size(a).max(size(b)))
        .max(MIN_SHIFT_PAGE_SHARE * page)
        .min(MAX_SHIFT_PAGE_SHARE * page);
    // A mark of another part in another place is another mark: a removed bolt did not become the washer below
    // it.
    if common_share < MIN_COMMON_SHARE
        && (alignment.largest > max_offset || !groups.same_part(a.group, b.group))
    {
        return None;
    }
    let unlikeness_factor = match likeness {
        Likeness::Same => 1.0,
        Likeness::Ink => 1.5,
        Likeness::Label => 2.0,
        Likeness::Both => 4.0,
    };
    let cost = alignment.largest * unlikeness_factor * (1.0 - 0.9 * common_share);
    Some(ChainPair { old, new, alignment, cost })
}
