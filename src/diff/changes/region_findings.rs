//! Findings about regions, from the changes of their borders.

use std::collections::{BTreeMap, BTreeSet};

use kurbo::{BezPath, Rect, Shape as _};
use rustc_hash::FxHashMap;

use super::finding_writer::{FindingWriter, label};
use crate::diff::curves::region_area::{area, ring_area, winds_round};
use crate::diff::findings::finding::{Finding, FindingBox, Verdict};
use crate::diff::matching::chain_events::ChainEvent;
use crate::diff::shapes::picture::{Picture, ShapeKind};

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
        let shape = |side: usize, index: Option<usize>| {
            index.and_then(|index| teller.sides[side].chains[index].shapes.first().copied())
        };
        let (old, new) = (shape(0, event.old), shape(1, event.new));
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
    let mut areas = Areas::default();
    by_shape
        .into_iter()
        .map(|(key, events)| region_finding(teller, &of_shape, key, events, &mut areas))
        .collect()
}

/// For each shape, the shape of the other picture that shares the longest border with it.
struct Partners([BTreeMap<usize, usize>; 2]);

impl Partners {
    /// Finds partners by the common length of borders.
    fn of(teller: &FindingWriter, borders: &[ChainEvent]) -> Self {
        let mut lengths: [BTreeMap<(usize, usize), f64>; 2] = Default::default();
        let mut add = |side: usize, from: Option<&usize>, to: Option<&usize>, length: f64| {
            if let Some((from, to)) = from.zip(to) {
                *lengths[side].entry((*from, *to)).or_default() += length;
            }
        };
        for side in 0..2 {
            let (own, others) = (&teller.sides[side], &teller.sides[1 - side]);
            for (chain, cover) in own.chains.iter().zip(&own.covers) {
                for &(partner, _, length) in &cover.partners {
                    let other = others.chains.get(partner as usize).and_then(|other| other.shapes.first());
                    let part = |side: usize, shape: Option<&usize>| {
                        teller.pictures[side].shapes.get(*shape?).and_then(|shape| shape.label.part.as_ref())
                    };
                    // Neighbours share borders: a removed region did not become its neighbour.
                    let own_part = part(side, chain.shapes.first()) == part(1 - side, other);
                    if own_part || length >= 0.9 * cover.length {
                        add(side, chain.shapes.first(), other, length);
                    }
                }
            }
        }
        for event in borders {
            let shape = |side: usize, index: Option<usize>| {
                index.and_then(|index| teller.sides[side].chains[index].shapes.first())
            };
            let (old, new) = (shape(0, event.old), shape(1, event.new));
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
    areas: &mut Areas,
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
    let mut area = |side: usize, index: Option<usize>| index.map(|i| areas.of(teller.pictures, side, i));
    let (before, after) = (area(0, old), area(1, new));
    let first = events.first().and_then(|event| event.shift);
    let mut finding = Finding {
        verdict,
        kind: shapes.iter().flatten().next().map_or(ShapeKind::Region, |shape| shape.kind),
        label: label(shapes),
        changes: teller.changes(shapes),
        place: FindingBox::of(Rect::ZERO),
        size: before.or(after).unwrap_or(0.0),
        growth: if before.is_some() && after.is_some() { growth(teller, of_shape, &events) } else { 0.0 },
        pieces: [0.0; 2],
        material: shapes.iter().flatten().next().and_then(|shape| shape.material.clone()),
        largest: events.iter().map(|event| event.largest).fold(0.0, f64::max),
        p95: events.iter().map(|event| event.p95).fold(0.0, f64::max),
        shift: first
            .filter(|_| verdict == Verdict::Moved && events.iter().all(|event| event.shift.is_some())),
        removed_path: BezPath::new(),
        added_path: BezPath::new(),
        follows_motion: false,
    };
    for event in &events {
        finding.removed_path.extend(event.removed.iter());
        finding.added_path.extend(event.added.iter());
    }
    let pieces =
        [&finding.removed_path, &finding.added_path].into_iter().filter(|path| !path.elements().is_empty());
    let pieces: Vec<Rect> = pieces.map(|path| path.bounding_box()).collect();
    let whole = shapes.into_iter().flatten().map(|shape| shape.path.bounding_box());
    let place = match verdict {
        Verdict::Reshaped => pieces.into_iter().reduce(|a, b| a.union(b)),
        _ => whole.reduce(|a, b| a.union(b)),
    };
    finding.place = FindingBox::of(place.unwrap_or_default());
    finding
}

/// Increase of the area of a region, from its changed rings only, so that it agrees with the reported
/// distances.
fn growth(teller: &FindingWriter, of_shape: &RingsOfShape, events: &[ChainEvent]) -> f64 {
    let ring = |side: usize, index: Option<usize>| -> f64 {
        let chains = &teller.sides[side].chains;
        let Some(chain) = index.and_then(|index| chains.get(index)) else { return 0.0 };
        let own = chain.shapes.first().and_then(|shape| of_shape[side].get(shape)).into_iter().flatten();
        let others = own.filter(|other| Some(**other) != index).filter_map(|other| chains.get(*other));
        let start = chain.points.first().copied().unwrap_or_default();
        let around = others.take(MAX_NESTED_RINGS).filter(|other| winds_round(&other.points, start)).count();
        ring_area(&chain.points) * if around % 2 == 0 { 1.0 } else { -1.0 }
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

/// Cache of shape areas.
#[derive(Default)]
struct Areas(FxHashMap<(usize, usize), f64>);

impl Areas {
    fn of(&mut self, pictures: [&Picture; 2], side: usize, shape: usize) -> f64 {
        *self.0.entry((side, shape)).or_insert_with(|| pictures[side].shapes.get(shape).map_or(0.0, area))
    }
}
