//! Ends of chains where another chain continues in the same direction.

use kurbo::Vec2;
use rustc_hash::FxHashMap;

use super::stroke_axis::StrokeAxis;
use crate::chains::Chain;

/// Cosine of the greatest turn between joined ends, 50 degrees.
const MIN_JOIN_COSINE: f64 = 0.643;

/// End of a chain: the chain's index, and 0 for its first point or 1 for its last.
pub(crate) type ChainEnd = (usize, usize);

/// For both ends of each chain, the straightest continuation among chains that are visible or hidden alike,
/// if any.
pub(crate) fn joined_ends(chains: &[&Chain], axes: &[StrokeAxis]) -> Vec<[Option<ChainEnd>; 2]> {
    // Chains that meet share a node, so their end points are identical to the last bit.
    let mut at: FxHashMap<(u64, u64, bool), Vec<ChainEnd>> = FxHashMap::default();
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
            joined[*i][*side] = straightest.filter(|b| turn(b) < -MIN_JOIN_COSINE).map(|b| ends[b]);
        }
    }
    joined
}
