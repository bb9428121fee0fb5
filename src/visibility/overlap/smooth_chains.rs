//! [`smooth_chains`]: hidden edges of a view map, chained up to corners and branches.

use super::edge_line::EdgeLine;
use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::visibility::graph::{ViewEdge, ViewMap};

/// Smallest cosine (20 degrees) between edges that continue each other without a corner.
const MIN_SMOOTH_COSINE: f64 = 0.939_692_620_785_908_4;

/// Chains the hidden edges of a map. An edge continues into the next where exactly two hidden edges of one
/// kind meet without a corner.
pub(crate) fn smooth_chains(map: &ViewMap) -> Vec<Vec<u32>> {
    let hidden = |edge: &ViewEdge| edge.invisibility > 0;
    // First two hidden edges at each vertex, and their number.
    let mut at: Vec<([u32; 2], u32)> = vec![([0; 2], 0); map.vertices.len()];
    for (number, edge) in (0..).zip(&map.edges).filter(|(_, edge)| hidden(edge)) {
        for end in [edge.start, edge.end] {
            let (edges, count) = &mut at[end.index()];
            if let Some(slot) = edges.get_mut(*count as usize) {
                *slot = number;
            }
            *count += 1;
        }
    }
    let mut pairs = Vec::new();
    for (node, ([a, b], count)) in at.into_iter().enumerate() {
        let [one, other] = [a, b].map(|number| &map.edges[number as usize]);
        if count != 2 || a == b || one.kind != other.kind {
            continue;
        }
        let away = |edge: &ViewEdge| {
            let along = EdgeLine::of(map, edge).along;
            if edge.start.index() == node { along } else { -along }
        };
        if -away(one).dot(away(other)) >= MIN_SMOOTH_COSINE {
            pairs.push((a, b));
        }
    }
    let groups = DisjointSets::new(map.edges.len(), |join| pairs.into_iter().for_each(|(a, b)| join(a, b)));
    let mut lines: Vec<Vec<u32>> = vec![Vec::new(); map.edges.len()];
    for (number, _) in (0..).zip(&map.edges).filter(|(_, edge)| hidden(edge)) {
        lines[groups.representative(number) as usize].push(number);
    }
    lines.retain(|line| !line.is_empty());
    lines
}
