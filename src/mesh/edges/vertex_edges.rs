//! [`VertexEdges`]: index of the edges by their smaller vertex, for fast lookup of the edge between two
//! vertices.

use crate::parallel::prelude::*;

use super::edge_table::Edges;

/// Number of vertices per task.
const VERTICES_PER_TASK: usize = 1 << 12;

/// Start of the edges of each vertex in the edge table. Edges are sorted by smaller vertex.
#[derive(Debug, Clone)]
pub(crate) struct VertexEdges<'a> {
    edges: &'a Edges,
    /// One entry per vertex, and one at the end.
    first: Vec<u32>,
}

impl<'a> VertexEdges<'a> {
    /// Indexes edges between `vertices` vertices.
    pub(crate) fn of(edges: &'a Edges, vertices: usize) -> Self {
        let mut first = vec![0; vertices + 1];
        first.par_chunks_mut(VERTICES_PER_TASK).enumerate().for_each(|(k, first)| {
            let least = (k * VERTICES_PER_TASK) as u32;
            let mut edge = edges.vertices.partition_point(|[lo, _]| *lo < least);
            for (vertex, first) in (least..).zip(first) {
                while edges.vertices.get(edge).is_some_and(|[lo, _]| *lo < vertex) {
                    edge += 1;
                }
                *first = edge as u32;
            }
        });
        Self { edges, first }
    }

    /// The edge between two vertices.
    #[inline]
    pub(crate) fn between(&self, u: u32, v: u32) -> Option<usize> {
        let (lo, hi) = (u.min(v), u.max(v));
        let [start, end] = [lo, lo + 1].map(|v| self.first[v as usize] as usize);
        let found = self.edges.vertices[start..end].binary_search_by_key(&hi, |[_, hi]| *hi);
        found.ok().map(|at| start + at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;

    #[test]
    fn vertex_edges_between_matches_a_search_of_all_edges() {
        // Some vertices have no edges, including the last ones.
        let vertices = 2 * VERTICES_PER_TASK as u64 + 10;
        let corner = |n: u64| (hash(n % 3, &[n / 3]) % (vertices - 5)) as u32;
        let triangles: Vec<[u32; 3]> =
            (0..vertices).map(|k| [3 * k, 3 * k + 1, 3 * k + 2].map(corner)).collect();
        let whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let triangles: Vec<[u32; 3]> = triangles.into_iter().filter(whole).collect();
        let edges = Edges::build(vertices as usize, &triangles);
        let first = VertexEdges::of(&edges, vertices as usize);
        for (edge, [a, b]) in edges.vertices.iter().enumerate() {
            assert_eq!(first.between(*b, *a), Some(edge));
        }
        for n in 0..1000 {
            let [a, b] = [corner(7 * n), corner(11 * n + 1)];
            let plain = edges.vertices.iter().position(|ends| *ends == [a.min(b), a.max(b)]);
            assert_eq!(first.between(a, b), plain);
        }
        let last = vertices as u32 - 1;
        assert_eq!(first.between(last, last - 1), None);
    }
}
