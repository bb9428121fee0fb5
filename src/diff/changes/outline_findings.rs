//! Findings about lines of varying width whose axis is unchanged. The outlines of all these lines are
//! compared together, because programs may merge several outlines into one path.

use std::collections::BTreeMap;

use rustc_hash::FxHashSet;

use super::finding_writer::FindingWriter;
use crate::diff::curves::chain::{self, OutlineChain};
use crate::diff::curves::hausdorff_distance::NearestPointQuery;
use crate::diff::curves::segment_grid::SegmentGrid;
use crate::diff::findings::finding::{Change, Finding, FindingBox, Verdict};
use crate::diff::matching::chain_pairs::bounds;
use crate::diff::matching::interval_cover::{ChainCover, cover};
use crate::diff::shapes::ink::trimmed;
use crate::diff::shapes::mark_groups::MarkGroups;
use crate::diff::shapes::picture::ShapeKind;

/// One finding for each line whose width varies differently.
pub(crate) fn findings(teller: &FindingWriter, groups: &MarkGroups) -> Vec<Finding> {
    let rings = [0, 1].map(|side| rings(teller, side, groups));
    if rings.iter().all(Vec::is_empty) {
        return Vec::new();
    }
    let firsts = [chain::first_copies(&rings[0]), chain::first_copies(&rings[1])];
    let grids = [0, 1].map(|side: usize| SegmentGrid::new(&rings[side]));
    let all = |side: usize| (rings[side].as_slice(), firsts[side].as_slice());
    let covers = [cover(all(0), all(1), &grids[1], groups), cover(all(1), all(0), &grids[0], groups)];
    // Largest difference for each old shape.
    let mut differ: BTreeMap<usize, f64> = BTreeMap::new();
    for side in 0..2 {
        for (ring, cover) in rings[side].iter().zip(&covers[side]).filter(|(_, cover)| !cover.is_whole()) {
            let other = cover.partners.first().and_then(|(other, ..)| rings[1 - side].get(*other as usize));
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
        for ring in &rings[side] {
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
        if *wider > shape.ink.width {
            // The line is shorter or longer. Both sides of its outline have the length of the line.
            let new = cover.partners.first().and_then(|(new, ..)| {
                teller.sides[1].chains.get(*new as usize).and_then(|new| new.shapes.first())
            });
            let long = |side: usize, shape: Option<&usize>| {
                shape.and_then(|shape| perimeters[side].get(shape)).copied().unwrap_or_default() / 2.0
            };
            let (kind, label) = (ShapeKind::Line, (*shape.label).clone());
            let place = FindingBox::of(bounds(&chain.points));
            return Some(Finding {
                size: cover.length,
                growth: long(1, new) - long(0, chain.shapes.first()),
                largest: *wider,
                p95: *wider,
                added_path: shape.path.clone(),
                material: shape.material.clone(),
                ..Finding::in_place(Verdict::Reshaped, kind, label, Vec::new(), place)
            });
        }
        let change = Change {
            what: "width along the line".to_owned(),
            old: format!("{} px on average", trimmed(shape.ink.width)),
            new: format!("up to {} px wider or thinner on one side", trimmed(*wider)),
        };
        let place = FindingBox::of(bounds(&chain.points));
        let (kind, label) = (ShapeKind::Line, (*shape.label).clone());
        Some(Finding {
            size: cover.length,
            added_path: shape.path.clone(),
            material: shape.material.clone(),
            ..Finding::in_place(Verdict::Restyled, kind, label, vec![change], place)
        })
    });
    told.collect()
}

/// Rings of the outlines of all unequal lines, each with its shape, in sorted order.
fn rings(teller: &FindingWriter, side: usize, groups: &MarkGroups) -> Vec<OutlineChain> {
    let mut found = Vec::new();
    let mut seen: FxHashSet<usize> = FxHashSet::default();
    for chain in &teller.sides[side].chains {
        let tolerance = groups.groups.get(chain.group).map_or(0.01, |group| group.tolerance);
        for index in chain.shapes.iter().filter(|index| seen.insert(**index)) {
            let outline = teller.pictures[side].shapes.get(*index).and_then(|shape| shape.outline.as_ref());
            let of_shape = chain::rings(outline, tolerance).into_iter();
            found.extend(of_shape.map(|ring| OutlineChain {
                group: chain.group,
                shapes: vec![*index],
                ..ring
            }));
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
