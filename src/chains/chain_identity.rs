//! Chain identities: numbers that stay the same from frame to frame while the model moves.
//!
//! 1. The space around the model in its rest pose is divided into cells.
//! 2. Each cell that a chain passes gives it a random number, better the longer the chain runs in the cell.
//!    The best number names the chain. Two chains share a name with a probability equal to the overlap of
//!    their cells, so a chain that loses or gains a little mostly keeps its name.
//! 3. Where several chains pass a cell, the one with the best number gets it. The others take their next best
//!    free one.
//! 4. Chains without a free number are named by finer cells.
//!
//! Only the chains of the frame are used: a frame's names do not depend on other frames.
//!
//! Source: weighted minwise hashing (Ioffe, Improved Consistent Sampling, Weighted Minhash and L1 Sketching,
//! ICDM 2010), with exponentially distributed numbers.

use std::sync::Arc;

use rustc_hash::FxHashSet;

use super::{Anchor, Chain};
use crate::geometry::numbers::noise::{hash, unit_interval};
use crate::geometry::numbers::portable_math::ln;
use crate::lines::LineKind;

/// Cells along the diagonal of a part, from coarse to fine. The first list is for contours, which move over
/// the surface with the camera; the second is for all other lines, which do not.
const CONTOUR_CELLS_PER_DIAGONAL: [f64; 5] = [6.0, 18.0, 54.0, 160.0, 500.0];
const FIXED_LINE_CELLS_PER_DIAGONAL: [f64; 5] = [24.0, 72.0, 216.0, 650.0, 4000.0];

/// Maximum number of cell walls per axis that are found between two points of a line.
const MAX_WALLS_PER_AXIS: usize = 1024;

/// Shift of the cells, so that no plane of symmetry lies between two of them.
const CELL_SHIFT: f64 = 0.372_915;

/// Cells along the diagonal of a part for [`Chain::rest_cells`]: for contours, and for all other lines.
const LOCATION_CELLS_PER_DIAGONAL: [f64; 2] = [32.0, 96.0];

/// Assigns an identity and a list of cells to all chains with known anchors. `parts` holds one number per
/// part.
pub(crate) fn assign_identities(chains: &mut [Chain], parts: &[u64]) {
    for chain in chains.iter_mut().filter(|chain| is_anchored(chain)) {
        chain.rest_cells = location_cells(chain, parts);
    }
    let mut open: Vec<usize> =
        (0..chains.len()).filter(|number| chains.get(*number).is_some_and(is_anchored)).collect();
    for level in 0..CONTOUR_CELLS_PER_DIAGONAL.len() {
        let mut claims: Vec<(f64, u64, usize)> = Vec::new();
        for number in &open {
            let lots = chains.get(*number).map(|chain| lots(chain, parts, level)).unwrap_or_default();
            claims.extend(lots.into_iter().map(|(lot, name)| (lot, name, *number)));
        }
        claims.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut assigned: FxHashSet<u64> = FxHashSet::default();
        for (_, name, number) in claims {
            if let Some(chain) = chains.get_mut(number).filter(|chain| chain.identity == 0)
                && assigned.insert(name)
            {
                chain.identity = name;
            }
        }
        open.retain(|number| chains.get(*number).is_some_and(|chain| chain.identity == 0));
    }
    // Chains that even the finest cells do not separate lie on top of each other.
    for (order, number) in open.into_iter().enumerate() {
        if let Some(chain) = chains.get_mut(number) {
            let name =
                lots(chain, parts, CONTOUR_CELLS_PER_DIAGONAL.len() - 1).first().map_or(1, |(_, name)| *name);
            chain.identity = hash(name, &[order as u64]).max(1);
        }
    }
}

fn is_anchored(chain: &Chain) -> bool {
    chain.samples.iter().any(|sample| sample.anchor.is_known())
}

/// Numbers of the cells that a chain passes, ascending.
fn location_cells(chain: &Chain, parts: &[u64]) -> Arc<[u64]> {
    let slides = chain.kind == LineKind::Contour;
    let part = parts.get(chain.part.index()).copied().unwrap_or_default();
    let mut cells = Vec::new();
    for [from, to] in sides(chain) {
        visit_cells(from, to, LOCATION_CELLS_PER_DIAGONAL[usize::from(!slides)], |cell, _| {
            if cells.last() != Some(&cell) {
                cells.push(cell);
            }
        });
    }
    let mut numbers: Vec<u64> =
        cells.into_iter().map(|cell| hash(part, &cell.map(i64::cast_unsigned)) ^ u64::from(slides)).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers.into()
}

/// Random number and name of each cell of a chain at a level.
fn lots(chain: &Chain, parts: &[u64], level: usize) -> Vec<(f64, u64)> {
    let slides = chain.kind == LineKind::Contour;
    let cells = if slides { CONTOUR_CELLS_PER_DIAGONAL[level] } else { FIXED_LINE_CELLS_PER_DIAGONAL[level] };
    let part = parts.get(chain.part.index()).copied().unwrap_or_default();
    let mut weights: Vec<([i64; 3], f64)> = Vec::new();
    for [from, to] in sides(chain) {
        visit_cells(from, to, cells, |cell, length| match weights.last_mut() {
            Some((last, weight)) if *last == cell => *weight += length,
            _ => weights.push((cell, length)),
        });
    }
    weights.sort_by_key(|(cell, _)| *cell);
    weights.dedup_by(|next, previous| {
        let same = next.0 == previous.0;
        if same {
            previous.1 += next.1;
        }
        same
    });
    let lot = |(cell, weight): &([i64; 3], f64)| {
        let words = cell.map(i64::cast_unsigned);
        let name = hash(part, &[u64::from(slides), level as u64, words[0], words[1], words[2]]);
        (-ln(unit_interval(hash(name, &[0])).max(f64::MIN_POSITIVE)) / weight.max(f64::MIN_POSITIVE), name)
    };
    weights.iter().map(lot).map(|(lot, own)| (lot, own.max(1))).collect()
}

/// Sides of a chain, between positions in the rest pose.
fn sides(chain: &Chain) -> impl Iterator<Item = [[f64; 3]; 2]> + '_ {
    let count = chain.samples.len();
    let sides = if chain.closed { count } else { count.saturating_sub(1) };
    (0..sides).filter_map(move |side| {
        let ends = [side, (side + 1) % count].map(|at| chain.samples.get(at).map(|sample| sample.anchor));
        let [Some(from), Some(to)] = ends else { return None };
        let rest_point = |anchor: Anchor| anchor.rest_position.map(f64::from);
        (from.is_known() && to.is_known()).then(|| [rest_point(from), rest_point(to)])
    })
}

/// Visits the cells that a segment passes, in order, with its length in each. Lengths are those of the rest
/// pose, so that a line keeps its name when it turns.
fn visit_cells(from: [f64; 3], to: [f64; 3], cells: f64, mut visit: impl FnMut([i64; 3], f64)) {
    let [from, to] = [from, to].map(|point| point.map(|x| (x + CELL_SHIFT) * cells));
    let direction = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let length =
        (direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]).sqrt();
    let mut walls: Vec<f64> = vec![0.0, 1.0];
    for axis in 0..3 {
        let (low, high) = (from[axis].min(to[axis]).floor() as i64, from[axis].max(to[axis]).floor() as i64);
        let crossed = (low.saturating_add(1)..=high).take(MAX_WALLS_PER_AXIS);
        walls.extend(crossed.map(|wall| ((wall as f64 - from[axis]) / direction[axis]).clamp(0.0, 1.0)));
    }
    walls.sort_by(f64::total_cmp);
    for pair in walls.windows(2) {
        let middle = (pair[0] + pair[1]) / 2.0;
        let cell = [0, 1, 2].map(|axis| (from[axis] + direction[axis] * middle).floor() as i64);
        visit(cell, (pair[1] - pair[0]) * length);
    }
}

#[cfg(test)]
mod tests {
    use kurbo::{BezPath, Point};

    use super::super::Sample;
    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::{MaterialId, PartId};

    /// A chain along a straight line in the rest pose.
    fn straight_chain(from: [f64; 3], to: [f64; 3], points: usize) -> Chain {
        let at = |k: usize| k as f64 / (points - 1) as f64;
        let rest_point = |t: f64| [0, 1, 2].map(|axis| (from[axis] + (to[axis] - from[axis]) * t) as f32);
        let sample = |k| Sample {
            anchor: Anchor { rest_position: rest_point(at(k)), scale: 500.0 },
            ..Sample::new(1.0, 1.0)
        };
        Chain {
            points: (0..points).map(|k| Point::new(400.0 * at(k), 0.0)).collect(),
            samples: (0..points).map(sample).collect(),
            closed: false,
            kind: LineKind::Crease,
            silhouette: false,
            invisibility: 0,
            veiled: false,
            both_seen: true,
            part: PartId(0),
            material: MaterialId(0),
            smooth: false,
            covered: [false; 2],
            segment: 0,
            identity: 0,
            rest_cells: Arc::default(),
            path: BezPath::new(),
        }
    }

    fn assigned_identities(mut chains: Vec<Chain>) -> Vec<u64> {
        assign_identities(&mut chains, &[7]);
        chains.iter().map(|chain| chain.identity).collect()
    }

    /// End points of lines all over the model.
    fn line_ends() -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
        (0..300).map(f64::from).map(|k| {
            let from = [0.3 * cos(k), 0.3 * sin(1.7 * k), 0.3 * cos(2.3 * k)];
            (from, [from[0] + 0.2 * sin(0.9 * k), from[1] + 0.2 * cos(0.9 * k), from[2] + 0.1])
        })
    }

    #[test]
    fn identity_survives_loss_of_a_tenth_of_the_line_in_most_cases() {
        let unchanged = line_ends().filter(|(from, to)| {
            let shorter = [0, 1, 2].map(|axis| from[axis] + 0.9 * (to[axis] - from[axis]));
            assigned_identities(vec![straight_chain(*from, *to, 9)])
                == assigned_identities(vec![straight_chain(*from, shorter, 9)])
        });
        let kept = unchanged.count();
        assert!((255..300).contains(&kept), "{kept} of 300");
    }

    #[test]
    fn identity_does_not_depend_on_the_number_of_points() {
        for (from, to) in line_ends() {
            assert_eq!(
                assigned_identities(vec![straight_chain(from, to, 2)]),
                assigned_identities(vec![straight_chain(from, to, 65)])
            );
        }
    }

    #[test]
    fn lines_through_the_same_cells_have_different_identities() {
        let nearby_chain =
            |k: i32| straight_chain([0.0, f64::from(k) * 1e-5, 0.0], [0.3, f64::from(k) * 1e-5, 0.1], 4);
        let mut identities = assigned_identities((0..40).map(nearby_chain).collect());
        assert!(identities.iter().all(|name| *name != 0));
        identities.sort_unstable();
        identities.dedup();
        assert_eq!(identities.len(), 40);
    }
}
