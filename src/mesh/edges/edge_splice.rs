//! Update of an edge table after faces were removed or cut into pieces.
//!
//! Edges of kept faces are copied, edges of pieces are built, and both are merged. The result equals a new
//! table.

use std::ops::Range;

use crate::parallel::prelude::*;

use super::edge_table::{NO_FACE, NON_MANIFOLD, PARALLEL_FLAG};
use crate::mesh::{EdgeFaces, Edges};

/// Marks a removed edge or face.
const REMOVED: u32 = u32::MAX;

/// Number of edges per task.
const EDGES_PER_TASK: usize = 1 << 13;
/// Above this number of edges, one task does everything, so that nothing is stored twice.
const MAX_PARALLEL_EDGES: usize = 1 << 20;

impl Edges {
    /// The edges after faces were cut, with the new id of each old edge (`u32::MAX` for cut edges).
    ///
    /// `renamed` holds the new number of each face, `u32::MAX` for cut ones. The others are the first `kept`
    /// faces and keep their order. The `pieces` follow; their new vertices are numbered after all others.
    /// Each side of a cut face is a side of one piece, or is cut for all adjacent faces.
    pub(crate) fn spliced(
        &self,
        renamed: &[u32],
        kept: u32,
        vertex_count: usize,
        pieces: &[[u32; 3]],
    ) -> (Self, Vec<u32>) {
        let piece_edges = Self::build(vertex_count, pieces);
        let chunk = if self.len() > MAX_PARALLEL_EDGES { self.len() } else { EDGES_PER_TASK };
        self.spliced_in_chunks(chunk, &piece_edges, renamed, kept)
    }

    /// Same, with the edges `piece_edges` of the pieces, and `chunk` edges per task.
    fn spliced_in_chunks(
        &self,
        chunk: usize,
        piece_edges: &Self,
        renamed: &[u32],
        kept: u32,
    ) -> (Self, Vec<u32>) {
        let insertion_index = |edge: usize| match self.vertices.get(edge) {
            Some(_) if edge == 0 => 0,
            Some(ends) => piece_edges.vertices.partition_point(|piece_ends| piece_ends < ends),
            None => piece_edges.len(),
        };
        let spliced = |k: usize| {
            let edges = k * chunk..((k + 1) * chunk).min(self.len());
            self.spliced_part(
                edges.clone(),
                (piece_edges, insertion_index(edges.start)..insertion_index(edges.end)),
                renamed,
                kept,
            )
        };
        let (parts, mut ids): (Vec<Self>, Vec<Vec<u32>>) =
            (0..self.len().div_ceil(chunk).max(1)).into_par_iter().map(spliced).unzip();
        let mut before = 0;
        for (part, ids) in parts.iter().zip(&mut ids) {
            ids.iter_mut().filter(|id| **id != REMOVED).for_each(|id| *id += before);
            before += part.len() as u32;
        }
        let ids = if let [only] = ids.as_mut_slice() { std::mem::take(only) } else { ids.concat() };
        (Self::joined(parts), ids)
    }

    /// Same for a range of the edges, with the edges of the pieces that sort before and among them. Ids are
    /// relative to this range.
    fn spliced_part(
        &self,
        edges: Range<usize>,
        (piece_edges, among): (&Self, Range<usize>),
        renamed: &[u32],
        kept: u32,
    ) -> (Self, Vec<u32>) {
        let behind = |face: u32| face + kept;
        let mut all = Self::default();
        all.vertices.reserve_exact(edges.len() + among.len());
        all.faces.reserve_exact(edges.len() + among.len());
        let mut ids = Vec::with_capacity(edges.len());
        let mut next = among.start;
        for (edge, ends) in edges.clone().zip(&self.vertices[edges]) {
            while piece_edges.vertices.get(next).is_some_and(|piece_ends| piece_ends < ends) {
                all.add(piece_edges, next, behind);
                next += 1;
            }
            let [first, second] = self.faces[edge];
            let is_shared = piece_edges.vertices.get(next) == Some(ends);
            if !is_shared && first != NON_MANIFOLD {
                let first = renamed[first as usize];
                let second = match second {
                    NO_FACE => NO_FACE,
                    second => match renamed[(second & !PARALLEL_FLAG) as usize] {
                        REMOVED => REMOVED,
                        face => face | second & PARALLEL_FLAG,
                    },
                };
                if first == REMOVED {
                    ids.push(REMOVED);
                    continue;
                }
                ids.push(all.len() as u32);
                all.vertices.push(*ends);
                all.faces.push([first, second]);
                continue;
            }
            let (before, same_way) = match self.faces(edge) {
                EdgeFaces::Two { same_way, .. } => (self.faces(edge), same_way),
                faces => (faces, false),
            };
            let mut faces: Vec<u32> = before
                .list()
                .iter()
                .map(|face| renamed[*face as usize])
                .filter(|face| *face != REMOVED)
                .collect();
            if is_shared {
                faces.extend(piece_edges.faces(next).list().iter().map(|piece| piece + kept));
                next += 1;
            }
            if faces.is_empty() {
                ids.push(REMOVED);
                continue;
            }
            ids.push(all.len() as u32);
            all.push(*ends, &faces, same_way);
        }
        (next..among.end).for_each(|edge| all.add(piece_edges, edge, behind));
        (all, ids)
    }

    /// The edges after faces were removed. `renamed` holds the new number of each face, `u32::MAX` for
    /// removed ones; the order is kept. `triangles` are the remaining ones.
    pub(crate) fn without(&self, renamed: &[u32], triangles: &[[u32; 3]]) -> Self {
        let chunk = if self.len() > MAX_PARALLEL_EDGES { self.len() } else { EDGES_PER_TASK };
        self.without_in_chunks(chunk, renamed, triangles)
    }

    /// Same, with `chunk` edges per task.
    fn without_in_chunks(&self, chunk: usize, renamed: &[u32], triangles: &[[u32; 3]]) -> Self {
        let some =
            |k: usize| self.some_without(k * chunk..((k + 1) * chunk).min(self.len()), renamed, triangles);
        Self::joined((0..self.len().div_ceil(chunk)).into_par_iter().with_max_len(1).map(some).collect())
    }

    /// Same for a range of the edges.
    fn some_without(&self, edges: Range<usize>, renamed: &[u32], triangles: &[[u32; 3]]) -> Self {
        let mut all = Self::default();
        all.vertices.reserve_exact(edges.len());
        all.faces.reserve_exact(edges.len());
        let mut left = Vec::new();
        for (edge, ends) in edges.clone().zip(&self.vertices[edges]) {
            let faces = self.faces(edge);
            left.clear();
            let still = faces.list().iter().map(|face| renamed[*face as usize]);
            left.extend(still.filter(|face| *face != REMOVED));
            let same_way = match (faces, left.as_slice()) {
                (_, []) => continue,
                (EdgeFaces::Two { same_way, .. }, _) => same_way,
                (_, [a, b]) => {
                    let up = |face: u32| {
                        let [a, b, c] = triangles[face as usize];
                        [[a, b], [b, c], [c, a]].contains(ends)
                    };
                    up(*a) == up(*b)
                }
                _ => false,
            };
            all.push(*ends, &left, same_way);
        }
        all
    }

    /// Adds an edge of another table. `number` maps its face numbers.
    #[inline]
    pub(crate) fn add(&mut self, others: &Self, edge: usize, number: impl Fn(u32) -> u32) {
        let faces = others.faces(edge);
        let same_way = matches!(faces, EdgeFaces::Two { same_way: true, .. });
        match faces.list() {
            [face] => self.push(others.vertices[edge], &[number(*face)], same_way),
            [a, b] => self.push(others.vertices[edge], &[number(*a), number(*b)], same_way),
            faces => {
                let faces: Vec<u32> = faces.iter().map(|face| number(*face)).collect();
                self.push(others.vertices[edge], &faces, same_way);
            }
        }
    }

    /// Appends an edge.
    #[inline]
    pub(crate) fn push(&mut self, ends: [u32; 2], faces: &[u32], same_way: bool) {
        self.vertices.push(ends);
        self.faces.push(match faces {
            [face] => [*face, NO_FACE],
            [first, second] => [*first, second | if same_way { PARALLEL_FLAG } else { 0 }],
            faces => {
                self.fan_starts.push(self.fans.len() as u32);
                self.fans.extend(faces);
                [NON_MANIFOLD, self.fan_starts.len() as u32 - 1]
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Square of cells, each cut in two. It has a fin at one edge, and one face with reversed winding.
    fn sheet(n: u32) -> Vec<[u32; 3]> {
        let at = |x: u32, y: u32| y * (n + 1) + x;
        let mut faces = Vec::new();
        for (x, y) in (0..n).flat_map(|x| (0..n).map(move |y| (x, y))) {
            faces.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            faces.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
        }
        faces.push([at(1, 1), at(2, 1), (n + 1) * (n + 1)]);
        faces[7].swap(0, 1);
        faces
    }

    #[test]
    fn edges_without_removed_faces_equal_a_rebuild() {
        let faces = sheet(6);
        let edges = Edges::build(50, &faces);
        for every in [1, 2, 3, 7, 100] {
            let mut left: Vec<[u32; 3]> = Vec::new();
            let mut renamed = Vec::new();
            for (number, face) in faces.iter().enumerate() {
                let goes = number % every == every - 1;
                renamed.push(if goes { REMOVED } else { left.len() as u32 });
                left.extend(Some(*face).filter(|_| !goes));
            }
            let (fewer, anew) = (edges.without(&renamed, &left), Edges::build(50, &left));
            assert_eq!(fewer.vertices, anew.vertices);
            assert!((0..anew.len()).all(|edge| fewer.faces(edge) == anew.faces(edge)), "{every}");
            for chunk in [1, 7, 64] {
                let parts = edges.without_in_chunks(chunk, &renamed, &left);
                assert_eq!((&parts.vertices, &parts.faces), (&fewer.vertices, &fewer.faces), "by {chunk}");
                assert_eq!((&parts.fans, &parts.fan_starts), (&fewer.fans, &fewer.fan_starts), "by {chunk}");
            }
        }
    }

    #[test]
    fn spliced_edges_equal_a_rebuild() {
        let n = 6;
        let faces = sheet(n);
        let count = (n + 1) * (n + 1) + 1;
        let edges = Edges::build(count as usize, &faces);
        // Some edges get a middle vertex. Faces with such edges are cut into fans.
        for every in [1, 2, 5, 200] {
            let middle = |a: u32, b: u32| {
                let edge = edges.vertices.binary_search(&[a.min(b), a.max(b)]).unwrap();
                edge.is_multiple_of(every).then_some(count + edge as u32)
            };
            let (mut renamed, mut kept, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
            for face @ [a, b, c] in faces.iter().copied() {
                let ring: Vec<u32> = [(a, b), (b, c), (c, a)]
                    .into_iter()
                    .flat_map(|(a, b)| [Some(a), middle(a, b)])
                    .flatten()
                    .collect();
                if ring.len() == 3 {
                    renamed.push(kept.len() as u32);
                    kept.push(face);
                } else {
                    // Around a separate centre vertex, so that sides never overlap.
                    let own = count + edges.len() as u32 + renamed.len() as u32;
                    renamed.push(REMOVED);
                    pieces.extend((0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()], own]));
                }
            }
            let vertices = count as usize + edges.len() + faces.len();
            let (spliced, ids) = edges.spliced(&renamed, kept.len() as u32, vertices, &pieces);
            let all: Vec<[u32; 3]> = kept.iter().chain(&pieces).copied().collect();
            let anew = Edges::build(vertices, &all);
            assert_eq!(spliced.vertices, anew.vertices);
            assert!((0..anew.len()).all(|edge| spliced.faces(edge) == anew.faces(edge)), "{every}");
            assert_eq!((&spliced.fans, &spliced.fan_starts), (&anew.fans, &anew.fan_starts));
            let own = Edges::build(vertices, &pieces);
            for chunk in [1, 7, 64] {
                let (parts, of_parts) = edges.spliced_in_chunks(chunk, &own, &renamed, kept.len() as u32);
                assert_eq!(
                    (&parts.vertices, &parts.faces),
                    (&spliced.vertices, &spliced.faces),
                    "by {chunk}"
                );
                assert_eq!((&parts.fans, &parts.fan_starts), (&spliced.fans, &spliced.fan_starts));
                assert_eq!(of_parts, ids);
            }
            for (edge, id) in ids.iter().enumerate() {
                let now = spliced.vertices.get(*id as usize);
                assert_eq!(now, Some(&edges.vertices[edge]).filter(|_| edge % every != 0));
            }
        }
    }
}
