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
use kurbo::{Point, Rect};
use rustc_hash::FxHashMap;

use super::interval_cover::ChainCover;
use crate::diff::curves::chain::OutlineChain;
use crate::diff::curves::chain_alignment::{Alignment, align};
use crate::diff::curves::hausdorff_distance::evenly_spaced_points;
use crate::diff::curves::segment::nearest_on;
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

/// The chains of one drawing and their covers by the other drawing.
#[derive(Debug)]
pub(crate) struct CoveredChains {
    pub chains: Vec<OutlineChain>,
    /// For each chain, the index of its first copy.
    pub firsts: Vec<usize>,
    pub covers: Vec<ChainCover>,
}

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
    let bare: [Vec<usize>; 2] = [0, 1].map(|side: usize| {
        let covers = &sides[side].covers;
        (0..covers.len())
            .filter(|index| !covers[*index].is_whole() && sides[side].firsts[*index] == *index)
            .collect()
    });
    if bare.iter().any(Vec::is_empty) {
        return Vec::new();
    }
    let mut near: Vec<(usize, usize)> = Vec::new();
    for side in 0..2 {
        let other = 1 - side;
        let targets: Vec<OutlineChain> =
            bare[other].iter().map(|index| sides[other].chains[*index].clone()).collect();
        let grid = SegmentGrid::new(&targets);
        let of = |index: &usize| {
            let mut near = candidates(&sides[side], *index, &bare[other], &grid, page * MAX_SHIFT_PAGE_SHARE);
            let chain = &sides[side].chains[*index];
            near.sort_by_cached_key(|there| {
                squared_end_distance(chain, &sides[other].chains[*there]).to_bits()
            });
            near.truncate(MAX_CANDIDATES);
            let index = *index;
            near.into_iter().map(move |there| if side == 0 { (index, there) } else { (there, index) })
        };
        near.par_extend(bare[side].par_iter().flat_map_iter(of));
    }
    near.par_sort_unstable();
    near.dedup();
    let mut found: Vec<ChainPair> =
        near.into_par_iter().filter_map(|(old, new)| score_pair(sides, old, new, groups, page)).collect();
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost).then_with(|| tie(sides, a, b)));
    let mut free = [vec![true; sides[0].chains.len()], vec![true; sides[1].chains.len()]];
    found.retain(|pair| {
        let both = free[0][pair.old] && free[1][pair.new];
        if both {
            (free[0][pair.old], free[1][pair.new]) = (false, false);
        }
        both
    });
    found.extend(congruent(sides, groups, &bare, &mut free));
    let copies = |pair: &ChainPair| {
        let is_copy = |side: usize, of: usize, copy: usize| sides[side].firsts.get(copy) == Some(&of);
        let (old, new, pair) = (pair.old, pair.new, *pair);
        (1..)
            .take_while(move |rank| is_copy(0, old, old + rank) && is_copy(1, new, new + rank))
            .map(move |rank| ChainPair { old: old + rank, new: new + rank, ..pair })
    };
    let more: Vec<ChainPair> = found.iter().flat_map(copies).collect();
    found.extend(more);
    found
}

/// Pairs remaining closed chains with the only congruent one in the other drawing, at any distance.
fn congruent(
    sides: &[CoveredChains; 2],
    groups: &MarkGroups,
    bare: &[Vec<usize>; 2],
    free: &mut [Vec<bool>; 2],
) -> Vec<ChainPair> {
    let left = [0, 1].map(|side: usize| -> Vec<(f64, usize)> {
        let chains = &sides[side].chains;
        let whole = |index: &&usize| {
            let closed = chains[**index].points.first() == chains[**index].points.last();
            closed && free[side][**index] && sides[side].covers[**index].partners.is_empty()
        };
        let mut left: Vec<(f64, usize)> =
            bare[side].iter().filter(whole).map(|index| (chains[*index].length(), *index)).collect();
        left.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        left
    });
    let tolerance =
        |index: usize| groups.groups.get(sides[0].chains[index].group).map_or(0.0, |g| g.tolerance);
    let mut of: [BTreeMap<usize, Vec<usize>>; 2] = Default::default();
    let mut pairs = Vec::new();
    for (length, old) in &left[0] {
        // If every point moves by up to the tolerance, the length changes little.
        let off = 4.0 * tolerance(*old) + tolerances::MAX_CONGRUENT_OFFSET_OF_LENGTH * length;
        let from = left[1].partition_point(|(other, _)| *other < length - off);
        for (_, new) in
            left[1].iter().skip(from).take(MAX_CONGRUENT).take_while(|(other, _)| *other <= length + off)
        {
            let (a, b) = (&sides[0].chains[*old], &sides[1].chains[*new]);
            if groups.likeness(a.group, b.group) != Some(Likeness::Same) {
                continue;
            }
            let alignment = align(a, b);
            if alignment.after_shift
                <= 2.0 * tolerance(*old) + tolerances::MAX_CONGRUENT_OFFSET_OF_LENGTH * length
            {
                of[0].entry(*old).or_default().push(*new);
                of[1].entry(*new).or_default().push(*old);
                pairs.push(ChainPair { old: *old, new: *new, alignment, cost: alignment.largest });
            }
        }
    }
    let only = |side: usize, index: usize| of[side].get(&index).is_some_and(|list| list.len() == 1);
    pairs.retain(|pair| only(0, pair.old) && only(1, pair.new));
    for pair in &pairs {
        (free[0][pair.old], free[1][pair.new]) = (false, false);
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
/// uncovered ones in `bare`. `reach` is the largest distance in px.
fn candidates(
    side: &CoveredChains,
    index: usize,
    bare: &[usize],
    grid: &SegmentGrid,
    reach: f64,
) -> Vec<usize> {
    let chain = &side.chains[index];
    let partners = side.covers[index].partners.iter().map(|(partner, ..)| *partner as usize);
    let mut found: Vec<usize> = partners.filter(|partner| bare.binary_search(partner).is_ok()).collect();
    let known: RefCell<FxHashMap<u32, usize>> = RefCell::default();
    for place in evenly_spaced_points(chain, (chain.points.len() + 1).min(SAMPLES_PER_CHAIN)) {
        // Nearby chains with their distances.
        let near: RefCell<Vec<(f64, u32)>> = RefCell::default();
        known.borrow_mut().clear();
        let see = |item: u32| {
            let segment = grid.segments[item as usize];
            let distance = place.distance(nearest_on(segment.from, segment.to, place));
            if distance > reach {
                return;
            }
            let mut near = near.borrow_mut();
            let at = *known.borrow_mut().entry(segment.chain).or_insert(near.len());
            match near.get_mut(at) {
                Some(entry) => entry.0 = entry.0.min(distance),
                None => near.push((distance, segment.chain)),
            }
        };
        let enough = |seen: f64| {
            near.borrow().iter().filter(|(distance, _)| *distance <= seen).count() >= NEIGHBOURS_PER_SAMPLE
        };
        grid.visit_rings(place, (reach, MAX_SEGMENTS_PER_SAMPLE), see, enough);
        let mut near = near.into_inner();
        let nearest = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        if near.len() > 2 * NEIGHBOURS_PER_SAMPLE {
            near.select_nth_unstable_by(2 * NEIGHBOURS_PER_SAMPLE, nearest);
            near.truncate(2 * NEIGHBOURS_PER_SAMPLE);
        }
        found.extend(near.iter().map(|(_, chain)| bare[*chain as usize]));
    }
    found.sort_unstable();
    found.dedup();
    found
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
    let forth = a0.distance_squared(b0) + a1.distance_squared(b1);
    forth.min(a0.distance_squared(b1) + a1.distance_squared(b0))
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
    let of = |cover: &ChainCover, partner: usize| {
        cover.partners.iter().find(|(p, ..)| *p as usize == partner).map_or(0.0, |(.., length)| *length)
    };
    let both = cover_a.length + cover_b.length;
    let common = if both > 0.0 { (of(cover_a, new) + of(cover_b, old)) / both } else { 0.0 };
    let alignment = align(a, b);
    let size = |chain: &OutlineChain| {
        let bounds = bounds(&chain.points);
        bounds.size().to_vec2().hypot()
    };
    let limit = (MAX_SHIFT_MARK_SHARE * size(a).max(size(b)))
        .max(MIN_SHIFT_PAGE_SHARE * page)
        .min(MAX_SHIFT_PAGE_SHARE * page);
    // A mark of another part in another place is another mark: a removed bolt did not become the washer below
    // it.
    if common < MIN_COMMON_SHARE && (alignment.largest > limit || !groups.same_part(a.group, b.group)) {
        return None;
    }
    let strangeness = match likeness {
        Likeness::Same => 1.0,
        Likeness::Ink => 1.5,
        Likeness::Label => 2.0,
        Likeness::Both => 4.0,
    };
    let cost = alignment.largest * strangeness * (1.0 - 0.9 * common);
    Some(ChainPair { old, new, alignment, cost })
}

/// Bounding box of points.
pub(crate) fn bounds(points: &[Point]) -> Rect {
    let Some(first) = points.first() else { return Rect::ZERO };
    points.iter().fold(Rect::from_points(*first, *first), |rect, p| rect.union_pt(*p))
}
