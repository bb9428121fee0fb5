//! [`Change`]: what becomes of the ink from one frame to the next.

use std::collections::{BTreeMap, BTreeSet};

use super::inked::{Bit, Bits, Inked};
use super::seen::Spot;

/// Shares of the ink that two frames have, and how far hatching slips.
#[derive(Default, Clone)]
pub struct Change {
    /// Of all ink: in strokes that both frames have by the same name, by length.
    pub kept: f64,
    /// The most that any naming could keep: strokes of both frames paired one to one.
    pub ceiling: f64,
    /// Of the ink that both frames show, point by point: that has another name in the later frame.
    pub renamed: f64,
    /// Of all ink: on places that both frames show, and which only one of them inks.
    pub popped: f64,
    /// The same of the hatching.
    pub hatching_popped: f64,
    /// Of bits of hatching that both frames have: how far they are across their stroke from where their place on the surface went, px.
    pub slips_px: Vec<f64>,
}

/// What becomes of one bit in another frame; of what may become of it, the first.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    Kept,
    Renamed,
    /// Its place is out of sight there.
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

/// The ink of strokes of two frames that are paired one to one, whatever their names: those that share at least a third of
/// the shorter one's ink, the longest first. Greedy, so that the best pairs of all may hold somewhat more.
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

/// How far each bit of hatching slips, and how many bits have no stroke of their direction near them though they are in sight.
fn slips(before: &Inked, after: &Inked) -> (Vec<f64>, usize) {
    /// Directions of strokes that may be the same, as the sine of the angle between them.
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
