//! [`Change`]: changes of the ink between two frames.

use std::collections::{BTreeMap, BTreeSet};

use super::inked::{Bit, Bits, Inked};
use super::seen::Spot;

/// Shares of the ink that two frames have in common, and displacement of hatching strokes.
#[derive(Default, Clone)]
pub struct Change {
    /// Length of strokes with the same name in both frames, as a share of all ink.
    pub kept: f64,
    /// Maximum of `kept` for any naming: strokes of both frames are paired one to one.
    pub ceiling: f64,
    /// Share of the common ink, point by point, whose stroke has a different name in the later frame.
    pub renamed: f64,
    /// Share of all ink at points that both frames show and only one of them inks.
    pub popped: f64,
    /// The same share for hatching.
    pub hatching_popped: f64,
    /// Distance of each common hatching point from its expected position, across its stroke, px.
    pub slips_px: Vec<f64>,
}

/// Result for one point in another frame. If several apply, the first one counts.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    Kept,
    Renamed,
    /// The point is hidden in the other frame.
    Hidden,
    Gone,
}

impl Change {
    pub fn between(before: &Inked, after: &Inked) -> Self {
        let common = |(id, length): (&u64, &f64)| match before.lengths.get(id) {
            Some(other) if *id != 0 => length.min(*other),
            _ => 0.0,
        };
        let kept = after.lengths.iter().map(common).sum::<f64>() / before.length.min(after.length).max(1e-9);
        let ceiling = paired(before, after) / before.length.min(after.length).max(1e-9);
        let fates: Vec<Fate> = fates(before, after, |inked| &inked.lines)
            .into_iter()
            .chain(fates(after, before, |inked| &inked.lines))
            .collect();
        let count = |wanted: fn(&Fate) -> bool| fates.iter().filter(|fate| wanted(fate)).count() as f64;
        let [same, renamed] =
            [count(|fate| matches!(fate, Fate::Kept)), count(|fate| matches!(fate, Fate::Renamed))];
        let popped = count(|fate| matches!(fate, Fate::Gone)) / fates.len().max(1) as f64;
        let (slips_px, gone) = slips(before, after);
        let hatching_popped = gone as f64 / before.hatching.all.len().max(1) as f64;
        let renamed = renamed / (same + renamed).max(1.0);
        Self { kept, ceiling: ceiling.max(kept), renamed, popped, hatching_popped, slips_px }
    }
}

/// Length of strokes that can be paired one to one, independent of names. A pair shares at least a third of
/// the ink of the shorter stroke. The longest pairs are taken first. This is greedy, so the best pairing may
/// be slightly longer.
fn paired(before: &Inked, after: &Inked) -> f64 {
    const SHARED: f64 = 1.0 / 3.0;
    let mut shared: BTreeMap<(u64, u64), f64> = BTreeMap::new();
    for bit in &before.lines.all {
        let mut there = BTreeSet::new();
        for place in before.seen.places(bit.at) {
            there.extend(after.lines.near(after.seen.spot(place).at).map(|other| other.identity));
        }
        for other in there {
            *shared.entry((bit.identity, other)).or_default() += Bits::STEP_PX;
        }
    }
    let length = |inked: &Inked, name: u64| inked.lengths.get(&name).copied().unwrap_or_default();
    let mut pairs: Vec<(f64, u64, u64)> = shared
        .into_iter()
        .map(|((a, b), shared)| (length(before, a).min(length(after, b)), shared, a, b))
        .filter(|(shorter, shared, ..)| *shared >= SHARED * shorter)
        .map(|(shorter, _, a, b)| (shorter, a, b))
        .collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let (mut left, mut right) = (BTreeSet::new(), BTreeSet::new());
    let mut sum = 0.0;
    for (shorter, a, b) in pairs {
        if !left.contains(&a) && !right.contains(&b) {
            left.insert(a);
            right.insert(b);
            sum += shorter;
        }
    }
    sum
}

fn fates(from: &Inked, to: &Inked, bits: fn(&Inked) -> &Bits) -> Vec<Fate> {
    let fate_of = |bit: &Bit, spot: Spot| {
        let mut near = bits(to).near(spot.at).map(|other| other.identity);
        match near.next() {
            Some(first) if first == bit.identity || near.any(|other| other == bit.identity) => Fate::Kept,
            Some(_) => Fate::Renamed,
            None if to.seen.shows(spot) => Fate::Gone,
            None => Fate::Hidden,
        }
    };
    let fate = |bit: &Bit| {
        let spots = from.seen.places(bit.at).into_iter().map(|place| to.seen.spot(place));
        spots.map(|spot| fate_of(bit, spot)).min().unwrap_or(Fate::Hidden)
    };
    bits(from).all.iter().map(fate).collect()
}

/// Displacement of each hatching point, and number of visible points without a stroke of similar direction
/// nearby.
fn slips(before: &Inked, after: &Inked) -> (Vec<f64>, usize) {
    /// Maximum sine of the angle between directions that count as similar.
    const PARALLEL: f64 = 0.3;
    let (mut slips, mut gone) = (Vec::new(), 0);
    for bit in &before.hatching.all {
        let Some(place) = before.seen.place(bit.at) else { continue };
        let spot = after.seen.spot(place);
        let like = after.hatching.near(spot.at).filter(|other| other.along.cross(bit.along).abs() < PARALLEL);
        match like.map(|other| (spot.at - other.at).cross(other.along).abs()).min_by(f64::total_cmp) {
            Some(slip) => slips.push(slip),
            None if after.seen.shows(spot) => gone += 1,
            None => {}
        }
    }
    (slips, gone)
}
