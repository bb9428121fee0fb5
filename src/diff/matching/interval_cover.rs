//! Finds which stretches of each polyline (chain) of one drawing coincide with lines of the other drawing.
//!
//! Input: the chains of both drawings, in px. Output: a [`ChainCover`] per chain, a partition of its arc
//! length into covered and uncovered runs. Uncovered runs become findings of `ligne diff`.
//!
//! 1. Each pair of near segments gives one exact interval within the tolerance (`capsule_interval`). No
//!    sampling is needed.
//! 2. Where intervals overlap, the one with the best likeness counts: same label and ink before others.
//! 3. Short runs where another line merely crosses the chain are absorbed by the runs around them.

use crate::diff::tolerances;
use crate::parallel::prelude::*;

use super::capsule_interval::within;
use crate::diff::curves::chain::{OutlineChain, first_copies};
use crate::diff::curves::segment_clusters::ClusterVisit;
use crate::diff::curves::segment_grid::SegmentGrid;
use crate::diff::shapes::mark_groups::{Likeness, MarkGroups};

/// Largest length of a run between two runs of equal likeness that counts as a mere crossing, in tolerances.
const MAX_CROSSING_TOLERANCES: f64 = 6.0;
/// Number of segments tested for an identical mark in a dense place. After that, any mark counts.
const MAX_SEGMENT_QUERIES: usize = 4096;
/// Most runs stored for all copies of a line. Covers of lines with more are reduced to one run.
const MAX_COPIED_RUNS: usize = 4_000_000;

/// A run of a chain, by arc length in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CoverRun {
    pub from: f64,
    pub to: f64,
    /// Best likeness of the marks there in the other drawing; `None` where there is none.
    pub likeness: Option<Likeness>,
    /// Index of that chain in the other drawing; 0 if uncovered.
    pub partner: u32,
}

impl CoverRun {
    pub(crate) fn length(&self) -> f64 {
        self.to - self.from
    }
}

/// Cover of one chain by the chains of the other drawing.
#[derive(Debug, Clone, Default)]
pub(crate) struct ChainCover {
    /// Runs from start to end, without gaps.
    pub runs: Vec<CoverRun>,
    /// The covering chains, the one with the greatest covered length first: index, best likeness, and covered
    /// length in px.
    pub partners: Vec<(u32, Likeness, f64)>,
    /// Length of the chain in px.
    pub length: f64,
}

impl ChainCover {
    /// Uncovered length in px.
    pub(crate) fn uncovered_length(&self) -> f64 {
        self.runs.iter().filter(|run| run.likeness.is_none()).map(CoverRun::length).sum()
    }

    /// Whether the chain is completely covered.
    pub(crate) fn is_whole(&self) -> bool {
        self.runs.iter().all(|run| run.likeness.is_some())
    }

    /// Whether the chain is completely covered by identical marks.
    pub(crate) fn is_same(&self) -> bool {
        self.runs.iter().all(|run| run.likeness == Some(Likeness::Same))
    }

    /// Covered share of the length.
    pub(crate) fn share(&self) -> f64 {
        match self.length == 0.0 {
            true => f64::from(u8::from(self.is_whole())),
            false => 1.0 - self.uncovered_length() / self.length,
        }
    }

    /// The cover reduced to one run: covered if every part is covered, with the worst likeness of its runs;
    /// otherwise uncovered.
    fn without_crossings(self) -> Self {
        let best = |runs: &[CoverRun]| runs.iter().map(|run| run.likeness).max().flatten();
        let likeness = if self.is_whole() { best(&self.runs) } else { None };
        let partner = self.runs.first().map_or(0, |run| run.partner);
        let mut cover = Self {
            runs: vec![CoverRun { from: 0.0, to: self.length, likeness, partner }],
            partners: Vec::new(),
            ..self
        };
        cover.collect_partners();
        cover
    }

    /// Computes `partners` from the runs.
    fn collect_partners(&mut self) {
        for run in &self.runs {
            let Some(likeness) = run.likeness else { continue };
            match self.partners.iter_mut().find(|(partner, ..)| *partner == run.partner) {
                Some((_, best, length)) => {
                    *best = likeness.min(*best);
                    *length += run.length();
                }
                None => self.partners.push((run.partner, likeness, run.length())),
            }
        }
        self.partners.sort_by(|a, b| b.2.total_cmp(&a.2).then(a.0.cmp(&b.0)));
    }
}

/// The chains of one drawing and their covers by the other drawing.
#[derive(Debug)]
pub(crate) struct CoveredChains {
    pub chains: Vec<OutlineChain>,
    /// For each chain, the index of its first copy.
    pub firsts: Vec<usize>,
    pub covers: Vec<ChainCover>,
}

/// Covers the chains of each of two drawings by those of the other one. Chains must be sorted.
pub(crate) fn cover(chains: [Vec<OutlineChain>; 2], groups: &MarkGroups) -> [CoveredChains; 2] {
    let firsts = [first_copies(&chains[0]), first_copies(&chains[1])];
    let covers = [(0, 1), (1, 0)].map(|(own, other): (usize, usize)| {
        let others = chains[other].iter().enumerate();
        let grid = SegmentGrid::of(others.filter(|(index, _)| firsts[other].get(*index) == Some(index)));
        cover_side((&chains[own], &firsts[own]), (&chains[other], &firsts[other]), &grid, groups)
    });
    let ([a, b], [firsts_a, firsts_b], [covers_a, covers_b]) = (chains, firsts, covers);
    [
        CoveredChains { chains: a, firsts: firsts_a, covers: covers_a },
        CoveredChains { chains: b, firsts: firsts_b, covers: covers_b },
    ]
}

/// Covers each chain of one drawing by the chains of another one, whose segments are in `grid`.
///
/// Each list of chains comes with the index of the first identical copy of each chain. Copies follow their
/// first copy directly. The grid contains first copies only; the n-th copy of a chain is covered by the n-th
/// copy of its partner.
fn cover_side(
    (own, own_firsts): (&[OutlineChain], &[usize]),
    (others, other_firsts): (&[OutlineChain], &[usize]),
    grid: &SegmentGrid,
    groups: &MarkGroups,
) -> Vec<ChainCover> {
    let mut copy_counts = vec![0usize; own.len()];
    own_firsts.iter().for_each(|first| copy_counts[*first] += 1);
    let of_first = |buffers: &mut _, (index, chain): (usize, &OutlineChain)| {
        let cover = match own_firsts[index] == index {
            true => cover_chain(chain, others, grid, groups, buffers),
            false => return ChainCover::default(),
        };
        // A line crossed by thousands of others has many runs; storing them for thousands of copies would take
        // too much memory.
        match cover.runs.len().saturating_mul(copy_counts[index] - 1) > MAX_COPIED_RUNS {
            true => cover.without_crossings(),
            false => cover,
        }
    };
    let of_firsts: Vec<ChainCover> =
        own.par_iter().enumerate().map_init(Default::default, of_first).collect();
    let cover_of_copy = |(index, first): (usize, &usize)| {
        let mut cover = of_firsts[*first].clone();
        let partner_of_copy = |partner: u32| {
            let copy = partner as usize + index - first;
            if other_firsts.get(copy) == Some(&(partner as usize)) { copy as u32 } else { partner }
        };
        cover.runs.iter_mut().for_each(|run| run.partner = partner_of_copy(run.partner));
        cover.partners.iter_mut().for_each(|(partner, ..)| *partner = partner_of_copy(*partner));
        cover
    };
    own_firsts.iter().enumerate().map(cover_of_copy).collect()
}

/// Parameter ranges, 0 to 1, of a segment that are covered, in a place too dense to test all other segments.
#[derive(Default)]
struct DenseCover {
    seen: usize,
    /// Disjoint ranges in increasing order.
    ranges: Vec<(f64, f64)>,
}

impl DenseCover {
    /// Adds a covered range. Only identical marks count until `MAX_SEGMENT_QUERIES` tests; after that, any
    /// mark does.
    fn add(&mut self, match_range: Option<(Likeness, (f64, f64))>) {
        self.seen += 1;
        let Some((likeness, (mut from, mut to))) = match_range else { return };
        if likeness != Likeness::Same && self.seen < MAX_SEGMENT_QUERIES {
            return;
        }
        let first = self.ranges.partition_point(|share| share.1 < from);
        let last = self.ranges.partition_point(|share| share.0 <= to);
        for share in self.ranges.drain(first..last) {
            (from, to) = (from.min(share.0), to.max(share.1));
        }
        self.ranges.insert(first, (from, to));
    }

    /// Whether a range is covered completely.
    fn covers(&self, (from, to): (f64, f64)) -> bool {
        let range_index = self.ranges.partition_point(|share| share.1 < to);
        self.ranges.get(range_index).is_some_and(|share| share.0 <= from)
    }
}

/// Covers one chain by the chains of the other drawing. The buffers are reused from chain to chain: numbers of
/// near segments, and covered intervals of a segment, which may overlap.
fn cover_chain(
    chain: &OutlineChain,
    other_chains: &[OutlineChain],
    grid: &SegmentGrid,
    groups: &MarkGroups,
    (near, intervals): &mut (Vec<u32>, Vec<CoverRun>),
) -> ChainCover {
    let tolerance = groups.tolerance(chain.group);
    let mut cover = ChainCover { length: chain.length(), ..ChainCover::default() };
    let mut at = 0.0;
    for (from, to) in chain.segments() {
        let length = from.distance(to);
        intervals.clear();
        // Stores the interval that another segment covers, and returns its likeness and its parameters.
        let mut add = |item: u32| {
            let segment = grid.segments.get(item as usize)?;
            let other_chain = other_chains.get(segment.chain as usize)?;
            let likeness = groups.likeness(chain.group, other_chain.group)?;
            let (start, end) = within(from, to, segment.from, segment.to, tolerance)?;
            intervals.push(CoverRun {
                from: at + start * length,
                to: at + end * length,
                likeness: Some(likeness),
                partner: segment.chain,
            });
            Some((likeness, (start, end)))
        };
        if grid.near(from, to, tolerance, near) {
            // An identical mark that covers the whole segment cannot be improved on.
            near.iter().any(|item| add(*item) == Some((Likeness::Same, (0.0, 1.0))));
        } else {
            let mut dense_cover = DenseCover::default();
            grid.bundles().search(|cluster_visit| match cluster_visit {
                ClusterVisit::Bundle { from: a, to: b, radius } => {
                    // A small margin for rounding.
                    let max_distance = (tolerance + radius) * (1.0 + tolerances::CLUSTER_MARGIN_SHARE);
                    within(from, to, a, b, max_distance).is_some_and(|share| !dense_cover.covers(share))
                }
                ClusterVisit::One(item) => {
                    dense_cover.add(add(item));
                    dense_cover.covers((0.0, 1.0))
                }
            });
        }
        runs(at, at + length, intervals, &mut cover.runs);
        at += length;
    }
    merge(&mut cover.runs);
    let max_crossing_length = MAX_CROSSING_TOLERANCES * tolerance;
    // Crossings of uncovered stretches go first, because they may separate runs of equal likeness.
    absorb(&mut cover.runs, max_crossing_length, |run, next| {
        next.likeness.is_none() && run.likeness.is_some()
    });
    absorb(&mut cover.runs, max_crossing_length, |run, next| {
        run.likeness.is_some() && next.likeness.is_some() && run.likeness != next.likeness
    });
    cover.collect_partners();
    cover
}

/// Partitions the arc lengths `start`–`end` into runs, each with the best interval that covers it.
fn runs(start: f64, end: f64, intervals: &mut [CoverRun], cover_runs: &mut Vec<CoverRun>) {
    if start == end {
        // A point is covered or not.
        let best = intervals.iter().min_by_key(|i| (i.likeness, i.partner)).copied();
        let uncovered = CoverRun { from: start, to: end, likeness: None, partner: 0 };
        cover_runs.push(CoverRun { from: start, to: end, ..best.unwrap_or(uncovered) });
        return;
    }
    intervals.sort_by(|a, b| {
        (a.likeness, a.partner).cmp(&(b.likeness, b.partner)).then(a.from.total_cmp(&b.from))
    });
    let mut uncovered_gaps = vec![(start, end)];
    let first = cover_runs.len();
    for interval in intervals.iter() {
        if uncovered_gaps.is_empty() {
            break;
        }
        let mut remaining_gaps = Vec::with_capacity(uncovered_gaps.len() + 1);
        for (from, to) in uncovered_gaps.drain(..) {
            let (low, high) = (interval.from.max(from), interval.to.min(to));
            if high - low <= 0.0 {
                remaining_gaps.push((from, to));
                continue;
            }
            cover_runs.push(CoverRun { from: low, to: high, ..*interval });
            let rests = [(from, low), (high, to)].into_iter();
            remaining_gaps.extend(rests.filter(|(a, b)| b - a > tolerances::MIN_UNCOVERED_GAP_PX));
        }
        uncovered_gaps = remaining_gaps;
    }
    let uncovered = |(from, to)| CoverRun { from, to, likeness: None, partner: 0 };
    cover_runs.extend(uncovered_gaps.into_iter().map(uncovered));
    cover_runs[first..].sort_by(|a, b| a.from.total_cmp(&b.from));
}

/// Merges neighbours of equal likeness and partner.
fn merge(runs: &mut Vec<CoverRun>) {
    runs.dedup_by(|next, run| {
        let is_mergeable =
            next.likeness == run.likeness && (next.partner == run.partner || run.likeness.is_none());
        if is_mergeable {
            run.to = next.to;
        }
        is_mergeable
    });
}

/// Absorbs runs of at most `max_length` px between two runs of equal likeness. `is_absorbable` receives the
/// short run and a neighbour, and returns whether it may be absorbed.
fn absorb(runs: &mut Vec<CoverRun>, max_length: f64, is_absorbable: impl Fn(&CoverRun, &CoverRun) -> bool) {
    let mut index = 1;
    while index + 1 < runs.len() {
        let (before, run, after) = (runs[index - 1], runs[index], runs[index + 1]);
        if before.likeness == after.likeness && run.length() <= max_length && is_absorbable(&run, &before) {
            runs[index].likeness = before.likeness;
            runs[index].partner = before.partner;
        }
        index += 1;
    }
    merge(runs);
}
