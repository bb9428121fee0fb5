//! [`closed_outlines`] and [`close_gaps`]: which outlines are closed loops, and closing of small gaps.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::plane_clip::Clipped;
use crate::geometry::lists::disjoint_sets::DisjointSets;

/// Edges of closed outlines, and the number of connected outlines that do not close.
pub(crate) fn closed_outlines(cut: &Clipped) -> (Vec<([u32; 2], i32)>, u64) {
    let outlines =
        DisjointSets::new(cut.nodes.len(), |join| cut.open.iter().for_each(|([a, b], _)| join(*a, *b)));
    let excess = excess(cut);
    let mut is_open = vec![false; cut.nodes.len()];
    for v in 0..cut.nodes.len() as u32 {
        if excess[v as usize] != 0 {
            is_open[outlines.representative(v) as usize] = true;
        }
    }
    let unclosed = is_open.iter().filter(|open| **open).count() as u64;
    let closes = |([a, _], _): &&([u32; 2], i32)| !is_open[outlines.representative(*a) as usize];
    (cut.open.iter().filter(closes).copied().collect(), unclosed)
}

/// For each node, how many edges start there minus how many end there.
fn excess(cut: &Clipped) -> Vec<i64> {
    let mut excess = vec![0_i64; cut.nodes.len()];
    for ([a, b], times) in &cut.open {
        excess[*a as usize] += i64::from(*times);
        excess[*b as usize] -= i64::from(*times);
    }
    excess
}

/// Joins ends of outlines to starts of outlines within `reach` (world units), nearest first.
pub(crate) fn close_gaps(cut: &mut Clipped, reach: f64) {
    let mut excess = excess(cut);
    let place = |node: u32| cut.geometry.positions[cut.nodes[node as usize] as usize];
    let key = |p: DVec3| (p / reach).floor().to_array().map(|x| x as i64);
    let mut begins: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    for node in (0..cut.nodes.len() as u32).filter(|node| excess[*node as usize] > 0) {
        begins.entry(key(place(node))).or_default().push(node);
    }
    let mut pairs: Vec<(f64, u32, u32)> = Vec::new();
    for end in (0..cut.nodes.len() as u32).filter(|node| excess[*node as usize] < 0) {
        let [x, y, z] = key(place(end));
        for k in 0..27_i64 {
            let field =
                [x.saturating_add(k % 3 - 1), y.saturating_add(k / 3 % 3 - 1), z.saturating_add(k / 9 - 1)];
            let near = begins.get(&field).into_iter().flatten();
            let distance = |begin: &u32| place(*begin).distance(place(end));
            let near = near.map(|begin| (distance(begin), end, *begin)).filter(|(far, ..)| *far <= reach);
            // Limited, because many ends at one place would give too many pairs.
            pairs.extend(near.take(MAX_PAIRS_PER_CELL));
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    for (_, end, begin) in pairs {
        let times = excess[begin as usize].min(-excess[end as usize]);
        if times > 0 {
            excess[begin as usize] -= times;
            excess[end as usize] += times;
            cut.open.push(([end, begin], times as i32));
        }
    }
}

/// Maximum number of starts per grid cell that are tried for an end.
const MAX_PAIRS_PER_CELL: usize = 64;
