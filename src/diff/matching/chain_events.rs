//! Changes of single chains between two drawings.

use std::collections::BTreeMap;

use crate::parallel::prelude::*;
use kurbo::BezPath;
use rustc_hash::FxHashSet;

use super::chain_pairs::{ChainPair, pairs};
use super::interval_cover::{ChainCover, CoverRun, CoveredChains};
use crate::diff::curves::chain::{OutlineChain, flatten};
use crate::diff::curves::chain_alignment::align;
use crate::diff::curves::hausdorff_distance::{NearestPointQuery, chain_distance};
use crate::diff::curves::segment::bounds;
use crate::diff::findings::finding::Verdict;
use crate::diff::shapes::mark_groups::{Likeness, MarkGroups};

/// Least covered share of a chain by another chain of its part, for the chain to count as reshaped rather
/// than removed.
const MIN_REMAINING_SHARE: f64 = 0.1;
/// Largest residual after a shift, as a share of the largest distance, for a chain to count as moved rigidly.
const RIGID_RESIDUAL_SHARE: f64 = 0.05;
/// Largest residual after a similarity, as a share of the largest distance, for a chain to count as moved.
const SIMILARITY_RESIDUAL_SHARE: f64 = 0.4;
/// Shortest repainted run in tolerances. Shorter ones come from ends and crossings of other lines.
const MIN_REPAINT_TOLERANCES: f64 = 12.0;
/// Shortest repainted run as a share of the line.
const MIN_REPAINT_SHARE: f64 = 0.01;

/// Change of one chain; lengths in px.
#[derive(Debug, Clone)]
pub(crate) struct ChainEvent {
    pub verdict: Verdict,
    pub old: Option<usize>,
    pub new: Option<usize>,
    /// Affected length in px.
    pub size: f64,
    pub largest: f64,
    pub p95: f64,
    pub shift: Option<[f64; 2]>,
    pub removed: BezPath,
    pub added: BezPath,
}

impl ChainEvent {
    /// A change without distances and paths. `size` is the affected length in px.
    fn new(verdict: Verdict, old: Option<usize>, new: Option<usize>, size: f64) -> Self {
        let (removed, added) = (BezPath::new(), BezPath::new());
        Self { verdict, old, new, size, largest: 0.0, p95: 0.0, shift: None, removed, added }
    }

    /// The change of a chain that exists in one drawing only.
    fn one_sided(sides: &[CoveredChains; 2], side: usize, index: usize, size: f64) -> Self {
        let path = stretch(&sides[side].chains[index], 0.0, f64::INFINITY);
        match side {
            0 => Self { removed: path, ..Self::new(Verdict::Removed, Some(index), None, size) },
            _ => Self { added: path, ..Self::new(Verdict::Added, None, Some(index), size) },
        }
    }
}

/// Changes of the chains of two drawings.
pub(crate) fn events(sides: &[CoveredChains; 2], groups: &MarkGroups, page: f64) -> Vec<ChainEvent> {
    let pairs = pairs(sides, groups, page);
    let paired: [FxHashSet<usize>; 2] =
        [pairs.iter().map(|pair| pair.old).collect(), pairs.iter().map(|pair| pair.new).collect()];
    let mut events: Vec<ChainEvent> =
        pairs.par_iter().map(|pair| paired_event(sides, pair, groups)).collect();
    events.extend(repaint_events(sides, groups));
    for side in 0..2 {
        for (index, cover) in sides[side].covers.iter().enumerate() {
            if !cover.is_whole() && !paired[side].contains(&index) {
                events.push(unpaired_event(sides, side, index, groups));
            }
        }
    }
    recoloured(events, sides, groups)
}

/// Joins a removed and an added chain of one part that coincide but have different ink: the mark was
/// repainted. Covers miss this where other marks are in the same place.
fn recoloured(events: Vec<ChainEvent>, sides: &[CoveredChains; 2], groups: &MarkGroups) -> Vec<ChainEvent> {
    let chain = |side: usize, event: &ChainEvent| match (side, event.verdict, event.old, event.new) {
        (0, Verdict::Removed, Some(index), _) | (1, Verdict::Added, _, Some(index)) => Some(index),
        _ => None,
    };
    let key = |side: usize, index: usize| {
        let bounding_box = bounds(&sides[side].chains[index].points);
        [bounding_box.x0, bounding_box.y0, bounding_box.x1, bounding_box.y1].map(|value| value.round() as i64)
    };
    let mut waiting: BTreeMap<[i64; 4], Vec<usize>> = BTreeMap::new();
    for (event, index) in
        events.iter().enumerate().filter_map(|(event_index, event)| Some((event_index, chain(0, event)?)))
    {
        waiting.entry(key(0, index)).or_default().push(event);
    }
    let mut joined: BTreeMap<usize, usize> = BTreeMap::new();
    for (added_event, new) in events.iter().enumerate().filter_map(|(at, event)| Some((at, chain(1, event)?)))
    {
        let b = &sides[1].chains[new];
        let is_one = |removed_event: &usize| {
            let Some(a) = chain(0, &events[*removed_event]).map(|old| &sides[0].chains[old]) else {
                return false;
            };
            let tolerance = groups.tolerance(a.group);
            groups.likeness(a.group, b.group) == Some(Likeness::Ink)
                && (a.length() - b.length()).abs() <= 4.0 * tolerance
                && align(a, b).largest <= tolerance
        };
        let candidates = waiting.get_mut(&key(1, new));
        if let Some(matching_event) = candidates.and_then(|list| {
            list.iter().position(is_one).map(|position_in_list| list.remove(position_in_list))
        }) {
            joined.insert(added_event, matching_event);
        }
    }
    let absorbed_events: FxHashSet<usize> = joined.values().copied().collect();
    let old_of: BTreeMap<usize, Option<usize>> =
        joined.iter().map(|(at, other)| (*at, events[*other].old)).collect();
    let remaining_events = events.into_iter().enumerate().filter(|(at, _)| !absorbed_events.contains(at));
    remaining_events
        .map(|(at, event)| match old_of.get(&at) {
            Some(old) => ChainEvent { verdict: Verdict::Restyled, old: *old, ..event },
            None => event,
        })
        .collect()
}

/// Change of a pair of chains: moved or reshaped.
fn paired_event(sides: &[CoveredChains; 2], pair: &ChainPair, groups: &MarkGroups) -> ChainEvent {
    let (a, b) = (&sides[0].chains[pair.old], &sides[1].chains[pair.new]);
    let (cover_a, cover_b) = (&sides[0].covers[pair.old], &sides[1].covers[pair.new]);
    let tolerance = groups.tolerance(a.group);
    let distance = chain_distance(a, b);
    let alignment = &pair.alignment;
    // A mean shift near zero means noise, not a motion.
    let is_rigid = alignment.after_shift <= (2.0 * tolerance).max(RIGID_RESIDUAL_SHARE * alignment.largest)
        && alignment.shift.hypot() >= 0.5 * alignment.largest;
    let length_difference = (cover_a.length - cover_b.length).abs();
    let is_similar = alignment.after_similarity
        <= (2.0 * tolerance).max(SIMILARITY_RESIDUAL_SHARE * alignment.largest)
        && length_difference <= (4.0 * tolerance).max(alignment.largest)
        && cover_a.share().max(cover_b.share()) < 0.5;
    let verdict = if is_rigid || is_similar { Verdict::Moved } else { Verdict::Reshaped };
    let mut event = ChainEvent {
        largest: distance.largest,
        p95: distance.p95,
        removed: bare(a, cover_a),
        added: bare(b, cover_b),
        ..ChainEvent::new(verdict, Some(pair.old), Some(pair.new), cover_a.length)
    };
    if event.verdict == Verdict::Reshaped {
        event.largest = off(a, cover_a, b, tolerance).max(off(b, cover_b, a, tolerance));
        event.p95 = event.p95.min(event.largest);
    }
    if is_rigid {
        // Lines may slide along themselves unseen. If all measured points moved alike, so did the rest.
        event.shift = Some([alignment.shift.x, alignment.shift.y]);
        event.p95 = event.largest;
    }
    event
}

/// Change of a chain with uncovered runs and without a pair: reshaped, removed or added.
fn unpaired_event(sides: &[CoveredChains; 2], side: usize, index: usize, groups: &MarkGroups) -> ChainEvent {
    let (chain, cover) = (&sides[side].chains[index], &sides[side].covers[index]);
    let is_same_part = |partner: &&(u32, Likeness, f64)| {
        let partner_chain = sides[1 - side].chains.get(partner.0 as usize);
        partner_chain.is_some_and(|other| groups.same_part(chain.group, other.group))
    };
    let best_partner = cover
        .partners
        .iter()
        .find(is_same_part)
        .filter(|partner| partner.2 > MIN_REMAINING_SHARE * cover.length);
    let size = cover.uncovered_length();
    let Some(partner) = best_partner.map(|(partner, ..)| *partner as usize) else {
        return ChainEvent::one_sided(sides, side, index, size);
    };
    let largest = off(chain, cover, &sides[1 - side].chains[partner], groups.tolerance(chain.group));
    let (old, new) = if side == 0 { (index, partner) } else { (partner, index) };
    let event = ChainEvent::new(Verdict::Reshaped, Some(old), Some(new), size);
    match side {
        0 => ChainEvent { largest, p95: largest, removed: bare(chain, cover), ..event },
        _ => ChainEvent { largest, p95: largest, added: bare(chain, cover), ..event },
    }
}

/// Largest distance of the uncovered runs of a chain from the other drawing. It is limited by the arc length
/// to the nearest covered run, so that a line linked to another one counts only its difference.
fn off(chain: &OutlineChain, cover: &ChainCover, other: &OutlineChain, tolerance: f64) -> f64 {
    let nearest_point_query = NearestPointQuery::new(other);
    let is_covered = |run_index: Option<usize>| {
        run_index.and_then(|at| cover.runs.get(at)).is_some_and(|run| run.likeness.is_some())
    };
    let last = cover.runs.len().saturating_sub(1);
    let mut max_distance = 0.0f64;
    for (index, run) in cover.runs.iter().enumerate().filter(|(_, run)| run.likeness.is_none()) {
        let before = if index == 0 { chain.closed.then_some(last) } else { Some(index - 1) };
        let after = if index == last { chain.closed.then_some(0) } else { Some(index + 1) };
        let piece = stretch(chain, run.from, run.to);
        let points = flatten(&piece, 1.0, false).into_iter().flat_map(|(points, _)| points).collect();
        let piece = OutlineChain { group: chain.group, points, closed: false, shapes: Vec::new() };
        let limit = match (is_covered(before), is_covered(after)) {
            (true, true) => run.length() / 2.0 + tolerance,
            (false, false) => f64::INFINITY,
            _ => run.length() + tolerance,
        };
        max_distance = max_distance.max(nearest_point_query.farthest(&piece, 0.0).min(limit));
    }
    max_distance
}

/// Changes of chains that are covered by other ink or by another part.
fn repaint_events(sides: &[CoveredChains; 2], groups: &MarkGroups) -> Vec<ChainEvent> {
    // `None` if the chain is unchanged; otherwise the marks that replaced it, if single marks did.
    let repainting_partners = |side: usize, index: usize| -> Option<Vec<(usize, Likeness, f64)>> {
        let (chain, cover) = (&sides[side].chains[index], &sides[side].covers[index]);
        if !cover.is_whole() || cover.is_same() {
            return None;
        }
        let tolerance = groups.tolerance(chain.group);
        let min_length = (MIN_REPAINT_TOLERANCES * tolerance)
            .max(MIN_REPAINT_SHARE * cover.length)
            .min(0.5 * cover.length);
        let unlike_partners = || {
            let partners = cover.partners.iter().copied();
            partners.filter(|(_, likeness, length)| *likeness != Likeness::Same && *length >= min_length)
        };
        unlike_partners().next()?;
        let unchanged_length: f64 =
            cover.partners.iter().filter(|p| p.1 == Likeness::Same).map(|p| p.2).sum();
        // Short runs of lines of several other parts do not add up to a replacement.
        let is_repainted_by = |partner: u32, length: f64| {
            let same_part = groups.same_part(chain.group, sides[1 - side].chains[partner as usize].group);
            same_part || length.max(unchanged_length) >= 0.5 * cover.length
        };
        Some(
            unlike_partners()
                .filter(|(partner, _, length)| is_repainted_by(*partner, *length))
                .map(|(partner, likeness, length)| (partner as usize, likeness, length))
                .collect(),
        )
    };
    let of_new: Vec<Option<Vec<(usize, Likeness, f64)>>> =
        (0..sides[1].chains.len()).map(|index| repainting_partners(1, index)).collect();
    let whole_event = |side: usize, index: usize| {
        ChainEvent::one_sided(sides, side, index, sides[side].covers[index].length)
    };
    let mut events = Vec::new();
    let mut reported_chains: FxHashSet<usize> = FxHashSet::default();
    for index in 0..sides[0].chains.len() {
        let Some(list) = repainting_partners(0, index) else { continue };
        let mut drawn_over = true;
        for (partner, likeness, length) in list {
            // If the coverage is not mutual, the chain was drawn twice and is now drawn once.
            let is_mutual = of_new[partner].iter().flatten().any(|(back, ..)| *back == index)
                || !sides[1].covers[partner].is_whole();
            if is_mutual {
                drawn_over = false;
                reported_chains.insert(partner);
                let verdict = match likeness {
                    Likeness::Same | Likeness::Ink | Likeness::Both => Verdict::Restyled,
                    Likeness::Label => Verdict::Relabelled,
                };
                events.push(ChainEvent {
                    added: stretches(&sides[0].chains[index], &sides[0].covers[index], |run| {
                        run.likeness.is_some_and(|likeness| likeness != Likeness::Same)
                    }),
                    ..ChainEvent::new(verdict, Some(index), Some(partner), length)
                });
            }
        }
        if drawn_over {
            events.push(whole_event(0, index));
        }
    }
    for (index, list) in of_new.iter().enumerate() {
        if list.is_some() && !reported_chains.contains(&index) {
            events.push(whole_event(1, index));
        }
    }
    events
}

/// Uncovered runs of a chain as a path.
fn bare(chain: &OutlineChain, cover: &ChainCover) -> BezPath {
    stretches(chain, cover, |run| run.likeness.is_none())
}

/// The runs of a chain that satisfy a condition, as a path.
fn stretches(chain: &OutlineChain, cover: &ChainCover, is_selected: impl Fn(&CoverRun) -> bool) -> BezPath {
    let runs = cover.runs.iter().filter(|run| is_selected(run));
    runs.flat_map(|run| stretch(chain, run.from, run.to).into_iter().collect::<Vec<_>>()).collect()
}

/// Part of a chain between two arc lengths.
fn stretch(chain: &OutlineChain, from: f64, to: f64) -> BezPath {
    let mut path = BezPath::new();
    let mut length_so_far = 0.0;
    for (p, q) in chain.segments() {
        let length = p.distance(q);
        let (start, end) = (from.max(length_so_far), to.min(length_so_far + length));
        if start <= end {
            let point = |s: f64| if length > 0.0 { p.lerp(q, (s - length_so_far) / length) } else { p };
            if path.elements().is_empty() {
                path.move_to(point(start));
            }
            path.line_to(point(end));
        }
        length_so_far += length;
    }
    path
}
