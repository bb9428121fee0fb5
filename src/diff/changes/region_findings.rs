//! Findings about regions, from the changes of their borders.

use std::collections::{BTreeMap, BTreeSet};

use kurbo::{BezPath, Shape as _};
use rustc_hash::FxHashMap;

use super::finding_writer::FindingWriter;
use crate::diff::curves::region_area::{area, ring_area};
use crate::diff::findings::finding::{Finding, Verdict};
use crate::diff::matching::chain_events::ChainEvent;

/// Most rings of a shape tested for nesting.
const MAX_NESTED_RINGS: usize = 200;

/// Ring numbers of each shape, for both pictures.
type RingsOfShape = [FxHashMap<usize, Vec<usize>>; 2];

/// Shape numbers of a region before and after.
type RegionPair = (Option<usize>, Option<usize>);

/// One finding for each changed region.
pub(crate) fn findings(teller: &FindingWriter, borders: Vec<ChainEvent>) -> Vec<Finding> {
    let partner = Partners::of(teller, &borders);
    let mut by_shape: BTreeMap<RegionPair, Vec<ChainEvent>> = BTreeMap::new();
    for event in borders {
        let (old, new) = (teller.shape_index(0, event.old), teller.shape_index(1, event.new));
        let key = (
            old.or_else(|| partner.0[1].get(&new?).copied()),
            new.or_else(|| partner.0[0].get(&old?).copied()),
        );
        by_shape.entry(key).or_default().push(event);
    }
    let of_shape: RingsOfShape = [0, 1].map(|side: usize| {
        let mut of_shape: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
        for (index, chain) in teller.sides[side].chains.iter().enumerate() {
            of_shape.entry(chain.shapes.first().copied().unwrap_or_default()).or_default().push(index);
        }
        of_shape
    });
    by_shape.into_iter().map(|(key, events)| region_finding(teller, &of_shape, key, events)).collect()
}

/// For each shape, the shape of the other picture that shares the longest border with it.
struct Partners([BTreeMap<usize, usize>; 2]);

impl Partners {
    /// Finds partners by the common length of borders.
    fn of(teller: &FindingWriter, borders: &[ChainEvent]) -> Self {
        let mut lengths: [BTreeMap<(usize, usize), f64>; 2] = Default::default();
        let mut add = |side: usize, from: Option<usize>, to: Option<usize>, length: f64| {
            if let Some(pair) = from.zip(to) {
                *lengths[side].entry(pair).or_default() += length;
            }
        };
        for side in 0..2 {
            for (index, cover) in teller.sides[side].covers.iter().enumerate() {
                let own = teller.shape_index(side, Some(index));
                for &(partner, _, length) in &cover.partners {
                    let other = teller.shape_index(1 - side, Some(partner as usize));
                    let part = |side: usize, shape: Option<usize>| {
                        teller.pictures[side].shapes.get(shape?).and_then(|shape| shape.label.part.as_ref())
                    };
                    // Neighbours share borders: a removed region did not become its neighbour.
                    if part(side, own) == part(1 - side, other) || length >= 0.9 * cover.length {
                        add(side, own, other, length);
                    }
                }
            }
        }
        for event in borders {
            let (old, new) = (teller.shape_index(0, event.old), teller.shape_index(1, event.new));
            add(0, old, new, event.size);
            add(1, new, old, event.size);
        }
        Self(lengths.map(|lengths| {
            let mut best: BTreeMap<usize, (f64, usize)> = BTreeMap::new();
            for ((from, to), length) in lengths {
                let entry = best.entry(from).or_insert((length, to));
                if length > entry.0 {
                    *entry = (length, to);
                }
            }
            best.into_iter().map(|(from, (_, to))| (from, to)).collect()
        }))
    }
}

/// The finding for one region, from the changes of its borders.
fn region_finding(
    teller: &FindingWriter,
    of_shape: &RingsOfShape,
    (old, new): RegionPair,
    events: Vec<ChainEvent>,
) -> Finding {
    let shape = |side: usize, index: Option<usize>| teller.pictures[side].shapes.get(index?);
    let shapes = [shape(0, old), shape(1, new)];
    let rings = |side: usize, index: Option<usize>| {
        let index = index?;
        Some(of_shape[side].get(&index).map_or(0, Vec::len))
    };
    let all = |verdict: Verdict| events.iter().all(|event| event.verdict == verdict);
    let verdict = match (old, new) {
        (Some(_), None) => Verdict::Removed,
        (None, _) => Verdict::Added,
        _ if all(Verdict::Restyled) => Verdict::Restyled,
        _ if all(Verdict::Relabelled) => Verdict::Relabelled,
        // All its borders moved and none stayed.
        _ if all(Verdict::Moved) && rings(0, old).is_none_or(|count| count <= events.len()) => Verdict::Moved,
        _ => Verdict::Reshaped,
    };
    let [before, after] = shapes.map(|shape| shape.map(area));
    let first = events.first().and_then(|event| event.shift);
    let removed_path: BezPath = events.iter().flat_map(|event| event.removed.iter()).collect();
    let added_path: BezPath = events.iter().flat_map(|event| event.added.iter()).collect();
    let parts: Vec<&BezPath> = match verdict {
        Verdict::Reshaped => vec![&removed_path, &added_path],
        _ => shapes.into_iter().flatten().map(|shape| &shape.path).collect(),
    };
    let is_drawn = |path: &&&BezPath| verdict != Verdict::Reshaped || !path.elements().is_empty();
    let boxes = parts.iter().filter(is_drawn).map(|path| path.bounding_box());
    let place = boxes.reduce(|a, b| a.union(b));
    Finding {
        size: before.or(after).unwrap_or(0.0),
        growth: if before.is_some() && after.is_some() { growth(teller, of_shape, &events) } else { 0.0 },
        largest: events.iter().map(|event| event.largest).fold(0.0, f64::max),
        p95: events.iter().map(|event| event.p95).fold(0.0, f64::max),
        shift: first
            .filter(|_| verdict == Verdict::Moved && events.iter().all(|event| event.shift.is_some())),
        removed_path,
        added_path,
        ..teller.finding(verdict, shapes, place.unwrap_or_default())
    }
}

/// Increase of the area of a region, from its changed rings only, so that it agrees with the reported
/// distances.
fn growth(teller: &FindingWriter, of_shape: &RingsOfShape, events: &[ChainEvent]) -> f64 {
    let ring = |side: usize, index: Option<usize>| -> f64 {
        let chains = &teller.sides[side].chains;
        let Some(chain) = index.and_then(|index| chains.get(index)) else { return 0.0 };
        let own = chain.shapes.first().and_then(|shape| of_shape[side].get(shape)).into_iter().flatten();
        let others = own.filter(|other| Some(**other) != index).filter_map(|other| chains.get(*other));
        ring_area(&chain.points, others.take(MAX_NESTED_RINGS).map(|other| other.points.as_slice()))
    };
    let changed =
        events.iter().filter(|event| !matches!(event.verdict, Verdict::Restyled | Verdict::Relabelled));
    // A ring may occur in the changes of both pictures.
    let rings: [BTreeSet<usize>; 2] = [
        changed.clone().filter_map(|event| event.old).collect(),
        changed.filter_map(|event| event.new).collect(),
    ];
    let area = |side: usize| rings[side].iter().map(|index| ring(side, Some(*index))).sum::<f64>();
    area(1) - area(0)
}
