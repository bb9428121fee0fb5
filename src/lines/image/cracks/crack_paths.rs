//! [`CrackPath`]: crack lines from junction to junction, joined straight through junctions.

use rustc_hash::FxHashMap;

use super::crack_lattice::{Crack, CrackLattice};

/// Window for the direction of a line at a junction, in cracks.
const DIRECTION_CRACKS: usize = 10;

/// Cosine of the sharpest turn (50 degrees) of a line at a junction.
const MIN_STRAIGHT_COSINE: f64 = 0.643;

/// Line along cracks.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct CrackPath {
    pub cracks: Vec<Crack>,
    /// Whether it is closed.
    pub closed: bool,
}

impl CrackPath {
    /// Corner after the given number of cracks.
    pub(crate) fn corner(&self, lattice: &CrackLattice, after: usize) -> usize {
        match self.cracks.get(after) {
            Some(crack) => crack.corner,
            None => self.cracks.last().and_then(|crack| lattice.end(*crack)).unwrap_or(0),
        }
    }

    fn turned(&self, lattice: &CrackLattice) -> Self {
        let back = |crack: &Crack| Crack {
            corner: lattice.end(*crack).unwrap_or(crack.corner),
            direction: (crack.direction + 2) % 4,
        };
        Self { cracks: self.cracks.iter().rev().map(back).collect(), closed: self.closed }
    }

    /// Unit direction at its start.
    fn direction(&self, lattice: &CrackLattice) -> [f64; 2] {
        let [from, to] = [0, self.cracks.len().min(DIRECTION_CRACKS)]
            .map(|after| lattice.place(self.corner(lattice, after)).map(|i| i as f64));
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = (x * x + y * y).sqrt().max(f64::MIN_POSITIVE);
        [x / length, y / length]
    }
}

/// All lines of a lattice, with each crack in exactly one. At junctions the straightest pairs are joined.
pub(crate) fn paths(lattice: &CrackLattice) -> Vec<CrackPath> {
    let branches = branches(lattice);
    join(lattice, branches)
}

/// Lines between junctions and free ends, followed by rings without either.
fn branches(lattice: &CrackLattice) -> Vec<CrackPath> {
    let mut done = vec![0_u8; lattice.len()];
    let mut branches = Vec::new();
    let mut follow = |first: Crack, done: &mut Vec<u8>| {
        let mut path = CrackPath::default();
        let mut next = Some(first);
        while let Some(crack) = next {
            let Some(end) = lattice.end(crack) else { break };
            done[crack.corner] |= 1 << crack.direction;
            done[end] |= 1 << ((crack.direction + 2) % 4);
            path.cracks.push(crack);
            let is_through = lattice.degree(end) == 2;
            next = is_through
                .then(|| lattice.leaving(end).find(|crack| done[end] & (1 << crack.direction) == 0))
                .flatten();
            path.closed = is_through && next.is_none() && end == first.corner;
        }
        branches.push(path);
    };
    let corners = lattice.corners();
    for rings in [false, true] {
        for corner in corners.iter().copied() {
            if !rings && lattice.degree(corner) == 2 {
                continue;
            }
            for crack in lattice.leaving(corner) {
                if done[corner] & (1 << crack.direction) == 0 {
                    follow(crack, &mut done);
                }
            }
        }
    }
    branches
}

/// End of a branch: its index, and whether it is the far end.
type BranchEnd = (usize, bool);

/// Joins branches that continue each other at junctions.
fn join(lattice: &CrackLattice, branches: Vec<CrackPath>) -> Vec<CrackPath> {
    let next = pairs(lattice, &branches);
    let mut used = vec![false; branches.len()];
    let mut paths = Vec::with_capacity(branches.len());
    // Lines that start at an unpaired end first; the rest are rings through junctions.
    for rings in [false, true] {
        for start in 0..branches.len() {
            for end in [false, true] {
                if used[start] || (!rings && next.contains_key(&(start, end))) {
                    continue;
                }
                let mut path = CrackPath { closed: branches[start].closed, ..CrackPath::default() };
                let mut at = Some((start, end));
                while let Some((branch, from)) = at.filter(|(branch, _)| !used[*branch]) {
                    used[branch] = true;
                    let own = &branches[branch];
                    path.cracks.extend(if from { own.turned(lattice).cracks } else { own.cracks.clone() });
                    at = next.get(&(branch, !from)).copied();
                }
                path.closed |= at == Some((start, end)) && !path.cracks.is_empty();
                paths.push(path);
            }
        }
    }
    paths
}

/// Pairs of branch ends that continue each other.
fn pairs(lattice: &CrackLattice, branches: &[CrackPath]) -> FxHashMap<BranchEnd, BranchEnd> {
    let mut ends: Vec<(usize, BranchEnd, [f64; 2])> = Vec::with_capacity(2 * branches.len());
    for (id, branch) in branches.iter().enumerate().filter(|(_, branch)| !branch.closed) {
        ends.push((branch.corner(lattice, 0), (id, false), branch.direction(lattice)));
        let turned = branch.turned(lattice);
        ends.push((turned.corner(lattice, 0), (id, true), turned.direction(lattice)));
    }
    ends.sort_unstable_by_key(|(corner, end, _)| (*corner, *end));
    let mut next = FxHashMap::default();
    for meeting in ends.chunk_by(|a, b| a.0 == b.0) {
        let mut turns: Vec<(f64, BranchEnd, BranchEnd)> = Vec::new();
        for (i, (_, a, to_a)) in meeting.iter().enumerate() {
            for (_, b, to_b) in &meeting[i + 1..] {
                let cosine = -(to_a[0] * to_b[0] + to_a[1] * to_b[1]);
                if cosine > MIN_STRAIGHT_COSINE {
                    turns.push((cosine, *a, *b));
                }
            }
        }
        turns.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (_, a, b) in turns {
            if !next.contains_key(&a) && !next.contains_key(&b) {
                next.insert(a, b);
                next.insert(b, a);
            }
        }
    }
    next
}
