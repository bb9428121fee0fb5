//! Repair of crack lines: closes small gaps and removes spurs.

use super::crack_lattice::{Crack, CrackLattice};
use super::jump_tiles::JumpTiles;

/// Largest gap that is closed, in cracks. There must be a jump all along it.
const MAX_GAP_CRACKS: usize = 4;

/// Longest branch with a free end that is removed, in cracks.
const MAX_SPUR_CRACKS: usize = 4;

/// Extends free ends along the largest jumps, if that reaches another line within a few cracks.
pub(crate) fn close_gaps(lattice: &mut CrackLattice, jumps: &JumpTiles) {
    let loose: Vec<usize> = ends(lattice);
    for start in loose {
        let Some(first) = lattice.leaving(start).next().filter(|_| lattice.degree(start) == 1) else {
            continue;
        };
        let mut way: Vec<Crack> = Vec::with_capacity(MAX_GAP_CRACKS);
        // The last corners of the line itself, which do not close a gap.
        let mut own = vec![start];
        own.extend(
            branch_from(lattice, first, 2 * MAX_GAP_CRACKS).iter().filter_map(|crack| lattice.end(*crack)),
        );
        let mut at = start;
        let mut met = false;
        while way.len() < MAX_GAP_CRACKS && !met {
            let next = (0..4)
                .map(|way| Crack { corner: at, direction: way })
                .filter(|crack| !lattice.has(*crack))
                .filter(|crack| lattice.end(*crack).is_some_and(|end| !own.contains(&end)))
                .map(|crack| (lattice.jump(jumps, crack), crack))
                .filter(|(jump, _)| *jump > 0.0)
                .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.direction.cmp(&a.1.direction)));
            let Some((_, crack)) = next else { break };
            let Some(end) = lattice.end(crack) else { break };
            way.push(crack);
            own.push(end);
            met = lattice.degree(end) > 0;
            at = end;
        }
        if met {
            way.into_iter().for_each(|crack| lattice.put(crack, true));
        }
    }
}

/// Removes short branches, and short isolated lines.
pub(crate) fn remove_spurs(lattice: &mut CrackLattice) {
    for start in ends(lattice) {
        let Some(first) = lattice.leaving(start).next().filter(|_| lattice.degree(start) == 1) else {
            continue;
        };
        let branch = branch_from(lattice, first, MAX_SPUR_CRACKS + 1);
        if branch.len() <= MAX_SPUR_CRACKS {
            branch.into_iter().for_each(|crack| lattice.put(crack, false));
        }
    }
}

/// Corners with exactly one line.
fn ends(lattice: &CrackLattice) -> Vec<usize> {
    lattice.corners().into_iter().filter(|corner| lattice.degree(*corner) == 1).collect()
}

/// Cracks of a line from a free end to its next branch or end, at most `most`.
fn branch_from(lattice: &CrackLattice, first: Crack, most: usize) -> Vec<Crack> {
    let mut branch = vec![first];
    while branch.len() < most {
        let Some(last) = branch.last().copied() else { break };
        let Some(at) = lattice.end(last) else { break };
        let mut on = lattice.leaving(at).filter(|crack| lattice.end(*crack) != Some(last.corner));
        let (Some(next), None) = (on.next(), on.next()) else { break };
        branch.push(next);
    }
    branch
}
