//! Findings about lines of varying width whose axis is unchanged. The outlines of all these lines are
//! compared together, because programs may merge several outlines into one path.

use std::collections::BTreeMap;

use rustc_hash::FxHashSet;

use super::finding_writer::FindingWriter;
use crate::diff::curves::chain::{self, OutlineChain};
use crate::diff::curves::hausdorff_distance::NearestPointQuery;
use crate::diff::curves::segment::bounds;
use crate::diff::findings::finding::{Change, Finding, Verdict};
use crate::diff::matching::interval_cover::{ChainCover, cover};
use crate::diff::shapes::ink::trimmed;
use crate::diff::shapes::mark_groups::MarkGroups;

/// One finding for each line whose width varies differently.
pub(crate) fn findings(teller: &FindingWriter, groups: &MarkGroups) -> Vec<Finding> {
    let rings = [0, 1].map(|side| rings(teller, side, groups));
    if rings.iter().all(Vec::is_empty) {
        return Vec::new();
    }
    let sides = cover(rings, groups);
    // Largest difference for each old shape.
    let mut differ: BTreeMap<usize, f64> = BTreeMap::new();
    for side in 0..2 {
        let all = sides[side].chains.iter().zip(&sides[side].covers);
        for (ring, cover) in all.filter(|(_, cover)| !cover.is_whole()) {
            let other = cover.partners.first();
            let other = other.and_then(|(other, ..)| sides[1 - side].chains.get(*other as usize));
            let old = if side == 0 { Some(ring) } else { other };
            let Some(shape) = old.and_then(|old| old.shapes.first()) else { continue };
            let wider = differ.entry(*shape).or_default();
            *wider = wider.max(other.map_or(0.0, |other| off(ring, cover, other)));
        }
    }
    let lines = teller.sides[0].chains.iter().zip(&teller.sides[0].covers);
    let lines = lines.filter(|(chain, cover)| chain.shapes.len() == 1 && cover.is_same());
    let perimeters = [0, 1].map(|side: usize| {
        let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
        for ring in &sides[side].chains {
            *sums.entry(ring.shapes.first().copied().unwrap_or_default()).or_default() += ring.length();
        }
        sums
    });
    let told = lines.filter_map(|(chain, cover)| {
        let wider = differ.get(chain.shapes.first()?)?;
        let shape = teller.shape(0, chain)?;
        if trimmed(*wider) == "0" {
            return None;
        }
        let finding = |verdict: Verdict, changes: Vec<Change>| Finding {
            size: cover.length,
            added_path: shape.path.clone(),
            ..Finding::of_shape(verdict, shape, changes, bounds(&chain.points))
        };
        if *wider > shape.ink.width {
            // The line is shorter or longer. Both sides of its outline have the length of the line.
            let new = cover.partners.first().and_then(|(new, ..)| {
                teller.sides[1].chains.get(*new as usize).and_then(|new| new.shapes.first())
            });
            let long = |side: usize, shape: Option<&usize>| {
                shape.and_then(|shape| perimeters[side].get(shape)).copied().unwrap_or_default() / 2.0
            };
            return Some(Finding {
                growth: long(1, new) - long(0, chain.shapes.first()),
                largest: *wider,
                p95: *wider,
                ..finding(Verdict::Reshaped, Vec::new())
            });
        }
        let change = Change {
            what: "width along the line".to_owned(),
            old: format!("{} px on average", trimmed(shape.ink.width)),
            new: format!("up to {} px wider or thinner on one side", trimmed(*wider)),
        };
        Some(finding(Verdict::Restyled, vec![change]))
    });
    told.collect()
}

/// Rings of the outlines of all unequal lines, each with its shape, in sorted order.
fn rings(teller: &FindingWriter, side: usize, groups: &MarkGroups) -> Vec<OutlineChain> {
    let mut found = Vec::new();
    let mut seen: FxHashSet<usize> = FxHashSet::default();
    for chain in &teller.sides[side].chains {
        for index in chain.shapes.iter().filter(|index| seen.insert(**index)) {
            let outline = teller.pictures[side].shapes.get(*index).and_then(|shape| shape.outline.as_ref());
            let rings =
                outline.map(|outline| OutlineChain::of_path(outline, (chain.group, *index), groups, true));
            found.extend(rings.into_iter().flatten().map(OutlineChain::canonical));
        }
    }
    chain::sort(&mut found);
    found
}

/// Largest distance of the uncovered runs of a ring from another ring.
fn off(ring: &OutlineChain, cover: &ChainCover, other: &OutlineChain) -> f64 {
    let near = NearestPointQuery::new(other);
    let mut at = 0.0;
    let mut most = 0.0f64;
    for (p, q) in ring.segments() {
        let length = p.distance(q);
        let bare =
            cover.runs.iter().filter(|run| run.likeness.is_none() && run.to > at && run.from < at + length);
        for run in bare.filter(|_| length > 0.0) {
            for s in [run.from.max(at), run.to.min(at + length)] {
                most = most.max(near.nearest(p.lerp(q, (s - at) / length)).1);
            }
        }
        at += length;
    }
    most
}
