//! Which ends of chains are ends of lines: not those where another chain goes on in the same direction.

use kurbo::Vec2;
use rustc_hash::FxHashMap;

use super::axis::Axis;
use crate::chain::Chain;

/// A line goes on where it turns by no more than this (cosine of 50 degrees).
const JOINED_COSINE: f64 = 0.643;

/// For each chain, whether another one, as visible or hidden as it is, goes on from its first and its last
/// point.
pub(super) fn joined(chains: &[&Chain], axes: &[Axis]) -> Vec<[bool; 2]> {
    // Chains that meet share a node, and so the place of it to the last bit.
    let mut at: FxHashMap<(u64, u64, bool), Vec<(usize, usize)>> = FxHashMap::default();
    for (i, chain) in chains.iter().enumerate().filter(|(i, chain)| !chain.closed && axes[*i].len() > 1) {
        for (side, p) in [chain.points.first(), chain.points.last()].into_iter().enumerate() {
            if let Some(p) = p {
                at.entry((p.x.to_bits(), p.y.to_bits(), chain.invisibility > 0)).or_default().push((i, side));
            }
        }
    }
    let mut joined = vec![[false; 2]; chains.len()];
    for ends in at.values().filter(|ends| ends.len() > 1) {
        let ways: Vec<Vec2> = ends.iter().map(|(i, side)| axes[*i].end_tangent(*side)).collect();
        for (a, (i, side)) in ends.iter().enumerate() {
            let goes_on = |b: usize| b != a && ways[a].dot(ways[b]) < -JOINED_COSINE;
            joined[*i][*side] = (0..ends.len()).any(goes_on);
        }
    }
    joined
}
