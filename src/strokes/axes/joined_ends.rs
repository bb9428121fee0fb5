//! Which ends of chains are ends of lines: not those where another chain goes on in the same direction.

use kurbo::Vec2;
use rustc_hash::FxHashMap;

use super::stroke_axis::Axis;
use crate::chains::Chain;

/// A line goes on where it turns by no more than this (cosine of 50 degrees).
const JOINED_COSINE: f64 = 0.643;

/// The end of another chain: its index, and 0 for its first point, 1 for its last.
pub(crate) type End = (usize, usize);

/// For the first and the last point of each chain, the chain that goes on from it, as visible or hidden as it
/// is, if there is one: the straightest.
pub(crate) fn joined(chains: &[&Chain], axes: &[Axis]) -> Vec<[Option<End>; 2]> {
    // Chains that meet share a node, and so the place of it to the last bit.
    let mut at: FxHashMap<(u64, u64, bool), Vec<End>> = FxHashMap::default();
    for (i, chain) in chains.iter().enumerate().filter(|(i, chain)| !chain.closed && axes[*i].len() > 1) {
        for (side, p) in [chain.points.first(), chain.points.last()].into_iter().enumerate() {
            if let Some(p) = p {
                at.entry((p.x.to_bits(), p.y.to_bits(), chain.invisibility > 0)).or_default().push((i, side));
            }
        }
    }
    let mut joined = vec![[None; 2]; chains.len()];
    for ends in at.values().filter(|ends| ends.len() > 1) {
        let ways: Vec<Vec2> = ends.iter().map(|(i, side)| axes[*i].end_tangent(*side)).collect();
        for (a, (i, side)) in ends.iter().enumerate() {
            let turn = |b: &usize| ways[a].dot(ways[*b]);
            let straightest = (0..ends.len()).filter(|b| *b != a).min_by(|b, c| turn(b).total_cmp(&turn(c)));
            joined[*i][*side] = straightest.filter(|b| turn(b) < -JOINED_COSINE).map(|b| ends[b]);
        }
    }
    joined
}
