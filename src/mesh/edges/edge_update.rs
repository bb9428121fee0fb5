//! Update of an edge table after faces were removed, changed or added.
//!
//! Edges of the other faces are copied, those of changed faces are built, and both are merged. The result
//! equals a new table.

use super::edge_table::{NO_FACE, NON_MANIFOLD, PARALLEL_FLAG};
use crate::mesh::Edges;

/// Marks a removed or changed face.
const GONE: u32 = u32::MAX;

impl Edges {
    /// The edges of `triangles`. `renamed` holds the new number of each face of this table, `u32::MAX` for
    /// removed and changed faces; the others keep their order.
    pub(crate) fn updated(&self, vertex_count: usize, triangles: &[[u32; 3]], renamed: &[u32]) -> Self {
        let mut is_kept = vec![false; triangles.len()];
        renamed.iter().filter(|face| **face != GONE).for_each(|face| is_kept[*face as usize] = true);
        let changed: Vec<u32> = (0..triangles.len() as u32).filter(|face| !is_kept[*face as usize]).collect();
        let corners: Vec<[u32; 3]> = changed.iter().map(|face| triangles[*face as usize]).collect();
        let own = Self::build(vertex_count, &corners);
        let own_faces = |edge: usize| own.faces(edge).each().map(|k| changed[k as usize]);
        // Whether a face runs along an edge from the smaller to the larger vertex.
        let up = |ends: [u32; 2], face: u32| {
            let [a, b, c] = triangles[face as usize];
            [[a, b], [b, c], [c, a]].contains(&ends)
        };
        let mut all = Self::default();
        all.vertices.reserve_exact(self.len() + own.len());
        all.faces.reserve_exact(self.len() + own.len());
        let mut faces = Vec::new();
        let mut next = 0;
        for (edge, &ends) in self.vertices.iter().enumerate() {
            while own.vertices.get(next).is_some_and(|other| *other < ends) {
                faces.extend(own_faces(next));
                all.push(own.vertices[next], &mut faces, up);
                next += 1;
            }
            let meets = own.vertices.get(next) == Some(&ends);
            let [first, second] = self.faces[edge];
            if !meets && first != NON_MANIFOLD {
                let renamed_second = match second {
                    NO_FACE => Some(NO_FACE),
                    _ => Some(renamed[(second & !PARALLEL_FLAG) as usize]).filter(|face| *face != GONE),
                };
                // Almost all edges keep all their faces.
                if let Some(face) = renamed_second.filter(|_| renamed[first as usize] != GONE) {
                    let flag = if second == NO_FACE { 0 } else { second & PARALLEL_FLAG };
                    all.vertices.push(ends);
                    all.faces.push([renamed[first as usize], face | flag]);
                    continue;
                }
            }
            faces.extend(self.faces(edge).each().map(|face| renamed[face as usize]).filter(|f| *f != GONE));
            if meets {
                faces.extend(own_faces(next));
                next += 1;
            }
            all.push(ends, &mut faces, up);
        }
        for edge in next..own.len() {
            faces.extend(own_faces(edge));
            all.push(own.vertices[edge], &mut faces, up);
        }
        all
    }

    /// Appends an edge with some faces, if there are any, and clears their list.
    fn push(&mut self, ends: [u32; 2], faces: &mut Vec<u32>, up: impl Fn([u32; 2], u32) -> bool) {
        faces.sort_unstable();
        let entry = match faces[..] {
            [] => return,
            [face] => [face, NO_FACE],
            [a, b] => [a, b | if up(ends, a) == up(ends, b) { PARALLEL_FLAG } else { 0 }],
            _ => {
                self.fan_starts.push(self.fans.len() as u32);
                self.fans.extend(&*faces);
                [NON_MANIFOLD, self.fan_starts.len() as u32 - 1]
            }
        };
        self.vertices.push(ends);
        self.faces.push(entry);
        faces.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;

    #[test]
    fn updated_edges_equal_a_rebuild() {
        const VERTICES: u64 = 40;
        let number = |n: u64, below: u64| (hash(1, &[n]) % below) as u32;
        let face = |n: u64| {
            let a = number(3 * n, VERTICES);
            let b = (a + 1 + number(3 * n + 1, VERTICES - 2)) % VERTICES as u32;
            let c = (0..VERTICES as u32).map(|k| (b + 1 + k) % VERTICES as u32).find(|c| *c != a && *c != b);
            [a, b, c.unwrap_or(0)]
        };
        // From a few faces to enough that most edges have several.
        for (round, count) in [5, 20, 60, 300].into_iter().enumerate() {
            let before: Vec<[u32; 3]> = (0..count).map(|n| face(1000 * round as u64 + n)).collect();
            let edges = Edges::build(VERTICES as usize, &before);
            for every in [1, 2, 7, 1000] {
                // Of the chosen faces, every other one is removed, and the rest are changed in place.
                let (mut triangles, mut renamed) = (Vec::new(), Vec::new());
                for (n, own) in before.iter().enumerate() {
                    let is_chosen = n % every == every - 1;
                    renamed.push(if is_chosen { GONE } else { triangles.len() as u32 });
                    if !is_chosen {
                        triangles.push(*own);
                    } else if n / every % 2 == 0 {
                        triangles.push(face(n as u64 + 77_777));
                    }
                }
                triangles.extend((0..3).map(|n| face(n + 99_999)));
                let found = edges.updated(VERTICES as usize, &triangles, &renamed);
                let anew = Edges::build(VERTICES as usize, &triangles);
                assert_eq!((&found.vertices, &found.faces), (&anew.vertices, &anew.faces));
                assert_eq!((&found.fans, &found.fan_starts), (&anew.fans, &anew.fan_starts));
            }
        }
    }
}
