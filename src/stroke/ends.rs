//! Which ends of chains are ends of lines: not those where another chain goes on in the same direction.

use kurbo::{Point, Vec2};
use rustc_hash::FxHashMap;

use super::axis::length;
use crate::chain::Chain;
use crate::chain::fit::unit;

/// Directions at ends are taken over this length, px.
const WINDOW_PX: f64 = 4.0;

/// A line goes on where it turns by no more than this (cosine of 50 degrees).
const JOINED_COSINE: f64 = 0.643;

/// For each chain, whether another one goes on from its first and its last point.
pub(super) fn joined(chains: &[&Chain], px: f64) -> Vec<[bool; 2]> {
    // Chains that meet share a node, and so the place of it to the last bit.
    let mut at: FxHashMap<(u64, u64), Vec<(usize, usize)>> = FxHashMap::default();
    for (i, chain) in chains.iter().enumerate().filter(|(_, chain)| !chain.closed) {
        for (side, p) in [chain.points.first(), chain.points.last()].into_iter().enumerate() {
            if let Some(p) = p {
                at.entry((p.x.to_bits(), p.y.to_bits())).or_default().push((i, side));
            }
        }
    }
    let mut joined = vec![[false; 2]; chains.len()];
    for ends in at.values().filter(|ends| ends.len() > 1) {
        let ways: Vec<Vec2> = ends.iter().map(|(i, side)| leaving(chains[*i], *side, px)).collect();
        for (a, (i, side)) in ends.iter().enumerate() {
            let goes_on = |b: usize| b != a && ways[a].dot(ways[b]) < -JOINED_COSINE;
            joined[*i][*side] = (0..ends.len()).any(goes_on);
        }
    }
    joined
}

/// Direction in which a chain leaves one of its ends.
fn leaving(chain: &Chain, side: usize, px: f64) -> Vec2 {
    let n = chain.points.len();
    let at = |k: usize| -> Point { chain.points[if side == 0 { k } else { n - 1 - k }] };
    let far = (1..n).find(|k| length(at(*k) - at(0)) >= WINDOW_PX * px);
    unit(at(far.unwrap_or(n - 1)) - at(0))
}
