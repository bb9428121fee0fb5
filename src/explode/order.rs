//! [`offsets`]: in which order parts stand along an axis once they are apart, and how far each moves for that.

use super::columns::Columns;

/// Parts that meet on less than this share of the fields of the smaller one only graze each other.
const GRAZE: f64 = 0.02;

/// How a part stands to another one along the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    /// They do not meet.
    Beside,
    /// It can be taken off along the axis, and not the other one.
    Above,
    /// The other one can.
    Below,
    /// Both can.
    Free,
    /// Neither can.
    Held,
}

fn standing(a: &Columns, b: &Columns, touch: f64) -> Standing {
    let [both, above, below] = a.meets(b, touch);
    let graze = (GRAZE * a.count.min(b.count) as f64).floor() as usize;
    if both <= graze {
        // A bearing in its bore is hidden as long as it stays there.
        let [small, large] = if a.count <= b.count { [a, b] } else { [b, a] };
        let is_within = small.count > 0 && small.lies_within(large) + graze >= small.count;
        return if is_within { Standing::Free } else { Standing::Beside };
    }
    // Where the other is in the way above, this one cannot go up, nor the other down.
    match (above > graze, below > graze) {
        (false, false) => Standing::Free,
        (false, true) => Standing::Above,
        (true, false) => Standing::Below,
        (true, true) => Standing::Held,
    }
}

/// How many pairs hold each other, and how many can be put apart.
pub(super) fn held_and_met(columns: &[Columns], touch: f64) -> (usize, usize) {
    let (mut held, mut met) = (0, 0);
    for a in 0..columns.len() {
        for b in 0..a {
            match standing(&columns[a], &columns[b], touch) {
                Standing::Beside => {}
                Standing::Held => held += 1,
                _ => met += 1,
            }
        }
    }
    (held, met)
}

/// Parts that hold each other, together; each group by its least part.
pub(super) fn groups(columns: &[Columns], touch: f64) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..columns.len()).collect();
    for a in 0..columns.len() {
        for b in 0..a {
            let (from, to) = (group[a].max(group[b]), group[a].min(group[b]));
            if from != to && standing(&columns[a], &columns[b], touch) == Standing::Held {
                group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
            }
        }
    }
    let of = |own: usize| (0..columns.len()).filter(|k| group[*k] == own).collect::<Vec<_>>();
    (0..columns.len()).map(of).filter(|group| !group.is_empty()).collect()
}

/// How far each group moves along the axis.
pub(super) fn offsets(columns: &[Columns], groups: &[Vec<usize>], touch: f64, gap: f64) -> Vec<f64> {
    let whole = |group: &Vec<usize>| group.iter().fold(Columns::default(), |sum, k| sum.with(&columns[*k]));
    let bodies: Vec<Columns> = groups.iter().map(whole).collect();
    let count = bodies.len();
    let middle = |k: usize| bodies[k].low + bodies[k].high;
    // Which others stand under each one.
    let mut under: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut piece: Vec<usize> = (0..count).collect();
    let mut above = Above::new(count);
    let mut free: Vec<[usize; 2]> = Vec::new();
    for a in 0..count {
        for b in 0..a {
            let [upper, lower] = match standing(&bodies[a], &bodies[b], touch) {
                Standing::Beside => continue,
                Standing::Above => [a, b],
                Standing::Below => [b, a],
                Standing::Free | Standing::Held => {
                    free.push(if middle(a) >= middle(b) { [a, b] } else { [b, a] });
                    continue;
                }
            };
            above.add(upper, lower);
            under[upper].push(lower);
        }
    }
    // Those that can go both ways go by the nearer end, unless others between them say otherwise; the clearest ones are asked first.
    let far = |[upper, lower]: &[usize; 2]| middle(*upper) - middle(*lower);
    free.sort_by(|a, b| far(b).total_cmp(&far(a)).then(a.cmp(b)));
    for [upper, lower] in free {
        let turned = above.has(lower, upper) && !above.has(upper, lower);
        let [upper, lower] = if turned { [lower, upper] } else { [upper, lower] };
        above.add(upper, lower);
        under[upper].push(lower);
    }
    for (upper, lower) in (0..count).flat_map(|k| under[k].iter().map(move |lower| (k, *lower))) {
        let (from, to) = (piece[upper].max(piece[lower]), piece[upper].min(piece[lower]));
        piece.iter_mut().filter(|p| **p == from).for_each(|p| *p = to);
    }
    let mut offsets: Vec<Option<f64>> = vec![None; count];
    for _ in 0..count {
        // The lowest of those under which nothing is left; where they go round in a circle, the lowest of all.
        let left = || (0..count).filter(|k| offsets[*k].is_none());
        let lowest = |a: &usize, b: &usize| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b));
        let is_free = |k: &usize| under[*k].iter().all(|lower| offsets[*lower].is_some());
        let Some(next) = left().filter(is_free).min_by(lowest).or_else(|| left().min_by(lowest)) else {
            break;
        };
        let needed = (0..count)
            .filter(|k| under[next].contains(k) || under[*k].contains(&next))
            .filter_map(|k| Some(bodies[k].high + offsets[k]? + gap - bodies[next].low));
        offsets[next] = Some(needed.fold(0.0, f64::max));
    }
    let mut offsets: Vec<f64> = offsets.into_iter().map(Option::unwrap_or_default).collect();
    // The largest of those that hang together stays.
    let size = |k: usize| bodies[k].count as f64 * (bodies[k].high - bodies[k].low);
    for own in 0..count {
        let together: Vec<usize> = (0..count).filter(|k| piece[*k] == own).collect();
        let largest = together.iter().copied().max_by(|a, b| size(*a).total_cmp(&size(*b)).then(b.cmp(a)));
        let stays = largest.map(|k| offsets[k]).unwrap_or_default();
        together.iter().for_each(|k| offsets[*k] -= stays);
    }
    offsets
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
