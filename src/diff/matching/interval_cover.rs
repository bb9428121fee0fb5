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
use kurbo::Point;

use super::capsule_interval::within;
use crate::diff::curves::chain::OutlineChain;
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
    /// Whether the chain has no length.
    is_point: bool,
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
        if self.is_point {
            f64::from(u8::from(self.is_whole()))
        } else {
            1.0 - self.uncovered_length() / self.length
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

/// Covers each chain of `own_chains` by the chains of `other_chains`, whose segments are in `grid`.
///
/// Each list of chains comes with the index of the first identical copy of each chain. Copies follow their
/// first copy directly. The grid contains first copies only; the n-th copy of a chain is covered by the n-th
/// copy of its partner.
pub(crate) fn cover(
    own_chains: (&[OutlineChain], &[usize]),
    other_chains: (&[OutlineChain], &[usize]),
    grid: &SegmentGrid,
    groups: &MarkGroups,
) -> Vec<ChainCover> {
    let first_copy = |index: usize| own_chains.1.get(index).copied().unwrap_or(index);
    let of_firsts: Vec<Option<ChainCover>> = own_chains
        .0
        .par_iter()
        .enumerate()
        .map_init(CoverScratch::default, |scratch, (index, chain)| {
            (first_copy(index) == index).then(|| cover_chain(chain, other_chains.0, grid, groups, scratch))
        })
        .collect();
    // A line crossed by thousands of others has many runs; storing them for thousands of copies would take
    // too much memory.
    let mut copy_counts = vec![0usize; own_chains.0.len()];
    (0..copy_counts.len()).for_each(|index| copy_counts[first_copy(index)] += 1);
    let limit_runs = |(index, cover): (usize, Option<ChainCover>)| {
        cover.map(|cover| match cover.runs.len().saturating_mul(copy_counts[index] - 1) > MAX_COPIED_RUNS {
            true => cover.without_crossings(),
            false => cover,
        })
    };
    let of_firsts: Vec<Option<ChainCover>> = of_firsts.into_iter().enumerate().map(limit_runs).collect();
    let cover_of_copy = |index: usize| {
        let mut cover = of_firsts.get(first_copy(index)).cloned().flatten().unwrap_or_default();
        let rank = index - first_copy(index);
        let partner_of_copy = |partner: u32| {
            let copy = partner as usize + rank;
            if other_chains.1.get(copy) == Some(&(partner as usize)) { copy as u32 } else { partner }
        };
        cover.runs.iter_mut().for_each(|run| run.partner = partner_of_copy(run.partner));
        cover.partners.iter_mut().for_each(|(partner, ..)| *partner = partner_of_copy(*partner));
        cover
    };
    (0..own_chains.0.len()).map(cover_of_copy).collect()
}

/// Buffers reused from chain to chain.
#[derive(Default)]
struct CoverScratch {
    near: Vec<u32>,
    /// Likeness of the current chain to each group seen so far.
    likeness: Vec<(usize, Option<Likeness>)>,
    intervals: Vec<CoverInterval>,
}

/// A segment of the chain being covered; it starts at arc length `at`.
struct ChainSegment {
    from: Point,
    to: Point,
    at: f64,
    length: f64,
    tolerance: f64,
}

impl CoverScratch {
    /// Stores the interval that another segment covers, and returns its likeness and its share of this
    /// segment.
    fn add_segment(
        &mut self,
        own_segment: &ChainSegment,
        chain: &OutlineChain,
        others: &[OutlineChain],
        grid: &SegmentGrid,
        groups: &MarkGroups,
        item: u32,
    ) -> Option<(Likeness, (f64, f64))> {
        let segment = grid.segments.get(item as usize)?;
        let other_chain = others.get(segment.chain as usize)?;
        let cached_likeness = self.likeness.iter().find(|(group, _)| *group == other_chain.group);
        let likeness = cached_likeness
            .map_or_else(|| groups.likeness(chain.group, other_chain.group), |(_, known)| *known);
        if cached_likeness.is_none() {
            self.likeness.push((other_chain.group, likeness));
        }
        let likeness = likeness?;
        let (start, end) =
            within(own_segment.from, own_segment.to, segment.from, segment.to, own_segment.tolerance)?;
        self.intervals.push(CoverInterval {
            from: own_segment.at + start * own_segment.length,
            to: own_segment.at + end * own_segment.length,
            likeness,
            partner: segment.chain,
        });
        Some((likeness, (start, end)))
    }
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

/// An interval of a chain, covered by a chain of the other drawing; arc lengths in px.
#[derive(Debug, Clone, Copy)]
struct CoverInterval {
    from: f64,
    to: f64,
    likeness: Likeness,
    partner: u32,
}

/// Covers one chain by the chains of the other drawing.
fn cover_chain(
    chain: &OutlineChain,
    other_chains: &[OutlineChain],
    grid: &SegmentGrid,
    groups: &MarkGroups,
    scratch: &mut CoverScratch,
) -> ChainCover {
    let tolerance = groups.groups.get(chain.group).map_or(0.01, |group| group.tolerance);
    let mut cover = ChainCover { length: chain.length(), ..ChainCover::default() };
    cover.is_point = cover.length == 0.0;
    let mut start_offset = 0.0;
    scratch.likeness.clear();
    for (from, to) in chain.segments() {
        let length = from.distance(to);
        scratch.intervals.clear();
        let own_segment = ChainSegment { from, to, at: start_offset, length, tolerance };
        let is_crowded = !grid.near(from, to, tolerance, &mut scratch.near);
        let nearby_segments = std::mem::take(&mut scratch.near);
        if is_crowded {
            let mut dense_cover = DenseCover::default();
            grid.bundles().search(|cluster_visit| match cluster_visit {
                ClusterVisit::Bundle { from, to, radius } => {
                    // A small margin for rounding.
                    let max_distance = (tolerance + radius) * (1.0 + tolerances::CLUSTER_MARGIN_SHARE);
                    within(own_segment.from, own_segment.to, from, to, max_distance)
                        .is_some_and(|share| !dense_cover.covers(share))
                }
                ClusterVisit::One(item) => {
                    let item_match =
                        scratch.add_segment(&own_segment, chain, other_chains, grid, groups, item);
                    dense_cover.add(item_match);
                    dense_cover.covers((0.0, 1.0))
                }
            });
        }
        for item in nearby_segments.iter().filter(|_| !is_crowded) {
            let segment_match = scratch.add_segment(&own_segment, chain, other_chains, grid, groups, *item);
            // An identical mark that covers the whole segment cannot be improved on.
            if segment_match
                .is_some_and(|(likeness, share)| likeness == Likeness::Same && share == (0.0, 1.0))
            {
                break;
            }
        }
        scratch.near = nearby_segments;
        runs(start_offset, start_offset + length, &mut scratch.intervals, &mut cover.runs);
        start_offset += length;
    }
    merge(&mut cover.runs);
    let max_crossing_length = MAX_CROSSING_TOLERANCES * tolerance;
    // Crossings of uncovered stretches go first, because they may separate runs of equal likeness.
    absorb(&mut cover.runs, max_crossing_length, |run, neighbour| {
        neighbour.likeness.is_none() && run.likeness.is_some()
    });
    absorb(&mut cover.runs, max_crossing_length, |run, neighbouring_run| {
        run.likeness.is_some()
            && neighbouring_run.likeness.is_some()
            && run.likeness != neighbouring_run.likeness
    });
    cover.collect_partners();
    cover
}

/// Partitions the arc lengths `start`–`end` into runs, each with the best interval that covers it.
fn runs(start: f64, end: f64, intervals: &mut [CoverInterval], cover_runs: &mut Vec<CoverRun>) {
    if start == end {
        // A point is covered or not.
        let best = intervals.iter().min_by_key(|i| (i.likeness, i.partner));
        cover_runs.push(CoverRun {
            from: start,
            to: end,
            likeness: best.map(|best| best.likeness),
            partner: best.map_or(0, |best| best.partner),
        });
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
            cover_runs.push(CoverRun {
                from: low,
                to: high,
                likeness: Some(interval.likeness),
                partner: interval.partner,
            });
            remaining_gaps.extend(
                [(from, low), (high, to)]
                    .into_iter()
                    .filter(|(a, b)| b - a > tolerances::MIN_UNCOVERED_GAP_PX),
            );
        }
        uncovered_gaps = remaining_gaps;
    }
    cover_runs.extend(uncovered_gaps.into_iter().map(|(from, to)| CoverRun {
        from,
        to,
        likeness: None,
        partner: 0,
    }));
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

/// Absorbs runs of at most `max_length` px between two runs of equal likeness. `is_absorbable` receives the short run and
/// the run before it, and returns whether it may be absorbed.
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
