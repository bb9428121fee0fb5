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
        return Standing::Beside;
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
    for a in 0..count {
        for b in 0..a {
            let above = match standing(&bodies[a], &bodies[b], touch) {
                Standing::Beside => continue,
                Standing::Above => true,
                Standing::Below => false,
                Standing::Free | Standing::Held => middle(a) >= middle(b),
            };
            let (upper, lower) = if above { (a, b) } else { (b, a) };
            under[upper].push(lower);
            let (from, to) = (piece[a].max(piece[b]), piece[a].min(piece[b]));
            piece.iter_mut().filter(|p| **p == from).for_each(|p| *p = to);
        }
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
