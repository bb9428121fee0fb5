//! [`offsets`]: order of separated bodies along an axis, and the displacement of each.

use crate::geometry::lists::disjoint_sets::DisjointSets;
use std::collections::BTreeMap;

use super::axis_projection::PairContact;

/// Relation of a body to another one along the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AxisRelation {
    /// They are not in contact.
    Apart,
    /// It can only be removed upward.
    Above,
    /// It can only be removed downward.
    Below,
    /// It can be removed in both directions.
    Free,
    /// It can be removed in neither direction.
    Held,
}

impl PairContact {
    /// Relation of the first body to the second.
    pub(crate) fn standing(self) -> AxisRelation {
        match (self.meets, self.blocks_up, self.blocks_down) {
            // A surrounded body, such as a bearing in its bore, is hidden unless it moves.
            (false, ..) if self.is_within => AxisRelation::Free,
            (false, ..) => AxisRelation::Apart,
            (true, false, false) => AxisRelation::Free,
            (true, false, true) => AxisRelation::Above,
            (true, true, false) => AxisRelation::Below,
            (true, true, true) => AxisRelation::Held,
        }
    }
}

/// Contact of each pair that has one. The higher index comes first.
pub(crate) type PairContacts = BTreeMap<[usize; 2], PairContact>;

/// Extent of a body along the axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AxisExtent {
    pub low: f64,
    pub high: f64,
    /// Size of the body. The largest body stays.
    pub size: f64,
    /// Given order, if any. Bodies with a greater order end up higher.
    pub order: Option<f64>,
}

impl AxisExtent {
    /// Combined extent of several bodies.
    pub(crate) fn joined(all: impl Iterator<Item = Self>) -> Self {
        let nothing = Self { low: f64::INFINITY, high: f64::NEG_INFINITY, size: 0.0, order: None };
        all.fold(nothing, |sum, own| Self {
            low: sum.low.min(own.low),
            high: sum.high.max(own.high),
            size: sum.size + own.size,
            order: sum.order.or(own.order),
        })
    }

    /// Relation given by the orders of both bodies, if they have different ones. It overrides blocking.
    pub(crate) fn given_relation(&self, other: &Self) -> Option<AxisRelation> {
        let (own, its) = (self.order?, other.order?);
        (own != its).then_some(if own > its { AxisRelation::Above } else { AxisRelation::Below })
    }

    fn middle(&self) -> f64 {
        self.low + self.high
    }
}

/// Displacement of each body along the axis, with gaps between bodies in contact. The largest body of each
/// connected group stays.
pub(crate) fn offsets(bodies: &[AxisExtent], meetings: &PairContacts, gap: f64) -> Vec<f64> {
    let count = bodies.len();
    let middle = |k: usize| bodies[k].middle();
    // For each body, the bodies that must end up below and above it.
    let (mut under, mut over) = (vec![Vec::new(); count], vec![Vec::new(); count]);
    let mut above = AboveRelation::new(count);
    let mut free: Vec<[usize; 2]> = Vec::new();
    let mut put = |[upper, lower]: [usize; 2], above: &mut AboveRelation| {
        above.add(upper, lower);
        under[upper].push(lower);
        over[lower].push(upper);
    };
    for (&[a, b], meeting) in meetings {
        match bodies[a].given_relation(&bodies[b]).unwrap_or(meeting.standing()) {
            AxisRelation::Apart => {}
            AxisRelation::Above => put([a, b], &mut above),
            AxisRelation::Below => put([b, a], &mut above),
            AxisRelation::Free | AxisRelation::Held => {
                free.push(if middle(a) >= middle(b) { [a, b] } else { [b, a] });
            }
        }
    }
    // Pairs that can be separated both ways use the shorter one, unless relations with other bodies require
    // the opposite. Pairs with the largest distance are decided first.
    let far = |[upper, lower]: &[usize; 2]| middle(*upper) - middle(*lower);
    free.sort_by(|a, b| far(b).total_cmp(&far(a)).then(a.cmp(b)));
    for [upper, lower] in free {
        let turned = above.has(lower, upper) && !above.has(upper, lower);
        put(if turned { [lower, upper] } else { [upper, lower] }, &mut above);
    }
    let mut offsets: Vec<Option<f64>> = vec![None; count];
    let mut waits: Vec<usize> = under.iter().map(Vec::len).collect();
    for _ in 0..count {
        // Topological order: the lowest body with nothing left below it. If there is a cycle, the lowest body
        // of all.
        let left = || (0..count).filter(|k| offsets[*k].is_none());
        let lowest = |a: &usize, b: &usize| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b));
        let Some(next) = left().filter(|k| waits[*k] == 0).min_by(lowest).or_else(|| left().min_by(lowest))
        else {
            break;
        };
        let around = || under[next].iter().chain(&over[next]);
        let needed = around().filter_map(|k| Some(bodies[*k].high + offsets[*k]? + gap - bodies[next].low));
        offsets[next] = Some(needed.fold(0.0, f64::max));
        for upper in &over[next] {
            waits[*upper] = waits[*upper].saturating_sub(1);
        }
    }
    let mut offsets: Vec<f64> = offsets.into_iter().map(Option::unwrap_or_default).collect();
    anchor_largest(bodies, &under, &mut offsets);
    offsets
}

/// Shifts each connected group so that its largest body stays.
fn anchor_largest(bodies: &[AxisExtent], under: &[Vec<usize>], offsets: &mut [f64]) {
    let pieces = DisjointSets::new(bodies.len(), |join| {
        for (upper, lower) in under.iter().enumerate() {
            lower.iter().for_each(|lower| join(upper as u32, *lower as u32));
        }
    });
    let piece = |k: usize| pieces.representative(k as u32) as usize;
    let mut stays: Vec<Option<usize>> = vec![None; bodies.len()];
    for k in 0..bodies.len() {
        let largest = &mut stays[piece(k)];
        if largest.is_none_or(|known| bodies[k].size > bodies[known].size) {
            *largest = Some(k);
        }
    }
    let shift: Vec<f64> = stays.iter().map(|stays| stays.map_or(0.0, |k| offsets[k])).collect();
    for (k, offset) in offsets.iter_mut().enumerate() {
        *offset -= shift[piece(k)];
    }
}

/// Transitive relation: which body is above which.
struct AboveRelation {
    /// One bit set per body: the bodies below it.
    rows: Vec<Vec<u64>>,
}

impl AboveRelation {
    fn new(count: usize) -> Self {
        Self { rows: vec![vec![0; count.div_ceil(64)]; count] }
    }

    fn has(&self, upper: usize, lower: usize) -> bool {
        self.rows[upper][lower / 64] >> (lower % 64) & 1 == 1
    }

    fn add(&mut self, upper: usize, lower: usize) {
        if self.has(upper, lower) {
            return;
        }
        let mut below = self.rows[lower].clone();
        below[lower / 64] |= 1 << (lower % 64);
        for k in 0..self.rows.len() {
            if k == upper || self.has(k, upper) {
                self.rows[k].iter_mut().zip(&below).for_each(|(own, more)| *own |= more);
            }
        }
    }
}
