//! [`offsets`]: the order of bodies along an axis once they are apart, and how far each moves for that.

use std::collections::BTreeMap;

use super::axis_projection::Meeting;

/// How a body stands to another one along the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Standing {
    /// They do not meet.
    Apart,
    /// It can be taken off along the axis, and not the other one.
    Above,
    /// The other one can.
    Below,
    /// Both can.
    Free,
    /// Neither can.
    Held,
}

impl Meeting {
    /// How the first body stands to the second.
    pub fn standing(self) -> Standing {
        match (self.meets, self.blocks_up, self.blocks_down) {
            // A bearing in its bore is hidden as long as it stays there.
            (false, ..) if self.is_within => Standing::Free,
            (false, ..) => Standing::Apart,
            (true, false, false) => Standing::Free,
            (true, false, true) => Standing::Above,
            (true, true, false) => Standing::Below,
            (true, true, true) => Standing::Held,
        }
    }
}

/// How bodies meet, for each pair that does: the greater number first.
pub(crate) type Meetings = BTreeMap<[usize; 2], Meeting>;

/// A body along the axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    pub low: f64,
    pub high: f64,
    /// Its size. The largest body stays.
    pub size: f64,
    /// Its place among those that have one, if it is given: a greater one stands higher.
    pub order: Option<f64>,
}

impl Stretch {
    /// The stretch of several bodies together.
    pub fn joined(all: impl Iterator<Item = Self>) -> Self {
        let nothing = Self { low: f64::INFINITY, high: f64::NEG_INFINITY, size: 0.0, order: None };
        all.fold(nothing, |sum, own| Self {
            low: sum.low.min(own.low),
            high: sum.high.max(own.high),
            size: sum.size + own.size,
            order: sum.order.or(own.order),
        })
    }

    /// How it stands to another one if both are given a place. Then it does not matter which blocks the other.
    pub fn told(&self, other: &Self) -> Option<Standing> {
        let (own, its) = (self.order?, other.order?);
        (own != its).then_some(if own > its { Standing::Above } else { Standing::Below })
    }

    fn middle(&self) -> f64 {
        self.low + self.high
    }
}

/// How far each body moves along the axis, with a gap between those that meet. The largest of those that hang together stays.
pub(crate) fn offsets(bodies: &[Stretch], meetings: &Meetings, gap: f64) -> Vec<f64> {
    let count = bodies.len();
    let middle = |k: usize| bodies[k].middle();
    // The others under each body, and over it.
    let (mut under, mut over) = (vec![Vec::new(); count], vec![Vec::new(); count]);
    let mut above = Above::new(count);
    let mut free: Vec<[usize; 2]> = Vec::new();
    let mut put = |[upper, lower]: [usize; 2], above: &mut Above| {
        above.add(upper, lower);
        under[upper].push(lower);
        over[lower].push(upper);
    };
    for (&[a, b], meeting) in meetings {
        match bodies[a].told(&bodies[b]).unwrap_or(meeting.standing()) {
            Standing::Apart => {}
            Standing::Above => put([a, b], &mut above),
            Standing::Below => put([b, a], &mut above),
            Standing::Free | Standing::Held => {
                free.push(if middle(a) >= middle(b) { [a, b] } else { [b, a] });
            }
        }
    }
    // Those that can go both ways go by the nearer end, unless others between them say otherwise; the clearest ones are asked first.
    let far = |[upper, lower]: &[usize; 2]| middle(*upper) - middle(*lower);
    free.sort_by(|a, b| far(b).total_cmp(&far(a)).then(a.cmp(b)));
    for [upper, lower] in free {
        let turned = above.has(lower, upper) && !above.has(upper, lower);
        put(if turned { [lower, upper] } else { [upper, lower] }, &mut above);
    }
    let mut offsets: Vec<Option<f64>> = vec![None; count];
    let mut waits: Vec<usize> = under.iter().map(Vec::len).collect();
    for _ in 0..count {
        // The lowest of those under which nothing is left; where they go round in a circle, the lowest of all.
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
    stay(bodies, &under, &mut offsets);
    offsets
}

/// Shifts those that hang together so that the largest of them stays.
fn stay(bodies: &[Stretch], under: &[Vec<usize>], offsets: &mut [f64]) {
    let mut piece: Vec<usize> = (0..bodies.len()).collect();
    for (upper, lower) in (0..bodies.len()).flat_map(|k| under[k].iter().map(move |lower| (k, *lower))) {
        unite(&mut piece, upper, lower);
    }
    let mut stays: Vec<Option<usize>> = vec![None; bodies.len()];
    for k in 0..bodies.len() {
        let largest = &mut stays[root(&piece, k)];
        if largest.is_none_or(|known| bodies[k].size > bodies[known].size) {
            *largest = Some(k);
        }
    }
    let shift: Vec<f64> = stays.iter().map(|stays| stays.map_or(0.0, |k| offsets[k])).collect();
    for (k, offset) in offsets.iter_mut().enumerate() {
        *offset -= shift[root(&piece, k)];
    }
}

/// The least member of the group of `k`.
pub(crate) fn root(group: &[usize], mut k: usize) -> usize {
    while group[k] != k {
        k = group[k];
    }
    k
}

/// Makes one group of the groups of two.
pub(crate) fn unite(group: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(group, a), root(group, b));
    group[a.max(b)] = a.min(b);
}

/// What stands above what, by itself or by way of others.
struct Above {
    /// For each body a bit for each one that it stands above.
    rows: Vec<Vec<u64>>,
}

impl Above {
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
