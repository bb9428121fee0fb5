//! Doubled sheets: surfaces whose faces occur twice, back to back, and the side that is kept.
//!
//! Leaves and cloth are often modelled in this way. Keeping the first face of each pair would flip the
//! surface from face to face. One side is therefore chosen for each connected sheet. If the sheet continues
//! in single faces, it matches their winding. Otherwise it faces outward, away from the middle of the model.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::mesh::edges::triangle_sides::runs_along;
use crate::parallel::prelude::*;

use crate::mesh::Edges;
use crate::mesh::soup::Soup;

const NO_FACE_OR_PAIR: u32 = u32::MAX;

/// Number of edges per task.
const EDGES_PER_TASK: usize = 1 << 12;

/// Of each pair of faces with the same corners and opposite windings, the face to keep.
pub(crate) fn choose_sheet_sides(soup: &Soup, edges: &Edges, pairs: &[[u32; 2]]) -> Vec<u32> {
    if pairs.is_empty() {
        return Vec::new();
    }
    let sheets = DoubledSheets::new(soup, edges, pairs);
    let mut sides: Vec<Option<usize>> = vec![None; pairs.len()];
    for seed in 0..pairs.len() {
        if sides[seed].is_none() {
            sheets.choose(seed, &mut sides);
        }
    }
    pairs.iter().zip(sides).map(|(faces, side)| faces[side.unwrap_or_default()]).collect()
}

struct DoubledSheets<'a> {
    soup: &'a Soup,
    pairs: &'a [[u32; 2]],
    pair_of: Vec<u32>,
    /// For each side of the first face of each pair, the face of the same part across it: the first face of
    /// another pair, or a single face. [`NO_FACE_OR_PAIR`] if there is no such face, or more than one.
    face_across: Vec<[AtomicU32; 3]>,
}

impl<'a> DoubledSheets<'a> {
    fn new(soup: &'a Soup, edges: &Edges, pairs: &'a [[u32; 2]]) -> Self {
        let mut pair_of = vec![NO_FACE_OR_PAIR; soup.triangles.len()];
        for (pair, faces) in pairs.iter().enumerate() {
            faces.iter().for_each(|face| pair_of[*face as usize] = pair as u32);
        }
        let beyond = pairs.iter().map(|_| [NO_FACE_OR_PAIR; 3].map(AtomicU32::new)).collect();
        let sheets = Self { soup, pairs, pair_of, face_across: beyond };
        let all = (0..edges.len()).into_par_iter().with_min_len(EDGES_PER_TASK);
        all.for_each(|edge| sheets.record_neighbours(edges, edge));
        sheets
    }

    /// Chooses the side of all pairs in the sheet of `seed`.
    fn choose(&self, seed: usize, sides: &mut [Option<usize>]) {
        sides[seed] = Some(0);
        let mut members = vec![(seed, 0)];
        let mut done = 0;
        // Number of single faces that match this side minus those that match the other; and the enclosed
        // volume.
        let (mut votes, mut volume) = (0i64, 0.0);
        while let Some(&(pair, side)) = members.get(done) {
            done += 1;
            let face = self.pairs[pair][side];
            let [a, b, c] = self.soup.triangles[face as usize];
            let [p, q, r] = [a, b, c].map(|v| self.soup.positions[v as usize]);
            volume += p.dot(q.cross(r));
            for edge in [[a, b], [b, c], [c, a]] {
                let other = self.face_across[pair][self.side(self.pairs[pair][0], edge)].load(Relaxed);
                if other == NO_FACE_OR_PAIR {
                    continue;
                }
                // Consistent neighbours run along an edge in opposite directions.
                let turned = self.runs(other, edge);
                match self.pair_of[other as usize] {
                    NO_FACE_OR_PAIR => votes += if turned { -1 } else { 1 },
                    other => {
                        let (other, side) = (other as usize, usize::from(turned));
                        if sides[other].is_none() {
                            sides[other] = Some(side);
                            members.push((other, side));
                        }
                    }
                }
            }
        }
        if votes < 0 || votes == 0 && volume < 0.0 {
            members.iter().for_each(|(pair, side)| sides[*pair] = Some(1 - side));
        }
    }

    /// Records for the pairs at an edge the face across it.
    fn record_neighbours(&self, edges: &Edges, edge: usize) {
        let faces = edges.faces(edge);
        let part = |face: u32| self.soup.triangle_part.get(face as usize);
        // The first face of a pair represents both.
        let first_of = |face: u32| match self.pair_of[face as usize] {
            NO_FACE_OR_PAIR => None,
            pair => Some((pair as usize, self.pairs[pair as usize][0])),
        };
        let counts = |face: &u32| first_of(*face).is_none_or(|(_, first)| first == *face);
        let counted = || faces.list().iter().copied().filter(counts);
        for face in counted() {
            let Some((pair, _)) = first_of(face) else { continue };
            let mut others = counted().filter(|other| *other != face && part(*other) == part(face));
            if let (Some(other), None) = (others.next(), others.next()) {
                self.face_across[pair][self.side(face, edges.vertices[edge])].store(other, Relaxed);
            }
        }
    }

    /// Index of the side of a face between two of its vertices.
    fn side(&self, face: u32, ends: [u32; 2]) -> usize {
        let corners = self.soup.triangles[face as usize];
        (0..2).find(|side| ends.contains(&corners[*side]) && ends.contains(&corners[side + 1])).unwrap_or(2)
    }

    /// Whether a face has a directed side from the first vertex to the second.
    fn runs(&self, face: u32, side: [u32; 2]) -> bool {
        runs_along(self.soup.triangles[face as usize], side)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::{EdgeFaces, FaceId, Mesh, PartId};

    /// Bent strip of squares. Those from `single` on have one face only. The order of the two faces of a pair
    /// varies along the strip.
    fn strip_with_doubled_faces(single: u32, shift: f64) -> Mesh {
        let bend = |i: u32| f64::from(i * i) / 20.0;
        let positions: Vec<DVec3> =
            (0..22).map(|k| DVec3::new(f64::from(k / 2), f64::from(k % 2), shift + bend(k / 2))).collect();
        let mut soup = Soup { positions, ..Soup::default() };
        for k in 0..10 {
            let a = 2 * k;
            for [a, b, c] in [[a, a + 2, a + 1], [a + 1, a + 2, a + 3]] {
                let (up, down) = ([a, b, c], [c, b, a]);
                match (k < single, k % 3 == 1) {
                    (false, _) => soup.triangles.push(up),
                    (_, false) => soup.triangles.extend([up, down]),
                    (_, true) => soup.triangles.extend([down, up]),
                }
            }
        }
        // A distant triangle, so that the strip is not in the middle of the model.
        let far = soup.positions.len() as u32;
        soup.positions.extend([0.0, 1.0, 2.0].map(|x| DVec3::new(x, x * x, -shift)));
        soup.triangles.push([far, far + 1, far + 2]);
        Mesh::build(soup)
    }

    /// Number of upward faces of a strip. Also checks that all neighbours are consistent.
    fn upward_face_count(mesh: &Mesh) -> usize {
        let turned = |e: &usize| matches!(mesh.edges.faces(*e), EdgeFaces::Two { same_way: true, .. });
        assert_eq!((0..mesh.edges.len()).filter(turned).count(), 0);
        let middle = |face: usize| mesh.corners(FaceId(face as u32)).iter().sum::<DVec3>() / 3.0;
        let strip: Vec<usize> = (0..mesh.triangles.len()).filter(|f| middle(*f).y < 1.0).collect();
        assert_eq!((mesh.triangles.len(), strip.len()), (21, 20));
        strip.into_iter().filter(|face| mesh.face_normals[*face][2] > 0.0).count()
    }

    #[test]
    fn a_sheet_keeps_its_outer_side() {
        let [above, below] = [40.0, -40.0].map(|shift| strip_with_doubled_faces(10, shift));
        assert_eq!((above.cleaning.doubled, below.cleaning.doubled), (20, 20));
        assert_eq!((upward_face_count(&above), upward_face_count(&below)), (20, 0));
    }

    #[test]
    fn doubled_sheets_follow_the_side_of_their_single_faces() {
        for shift in [40.0, -40.0] {
            assert_eq!(upward_face_count(&strip_with_doubled_faces(7, shift)), 20);
        }
    }

    #[test]
    fn face_across_pairs_matches_a_search_of_all_faces() {
        let (mut dice, mut found) = (Dice::new(5), 0);
        for round in 0..200 {
            let mut soup = Soup { positions: vec![DVec3::ZERO; 9], ..Soup::default() };
            let mut below = |n: u32| dice.below(n as usize) as u32;
            while soup.triangles.len() < 30 {
                let corners @ [a, b, c] = [0; 3].map(|_| below(9));
                let part = PartId(below(1 + round % 3));
                let is_new = |t: &[u32; 3]| !corners.iter().all(|corner| t.contains(corner));
                if a != b && b != c && c != a && soup.triangles.iter().all(is_new) {
                    // About half of the triangles are doubled.
                    let twice = below(2) as usize;
                    soup.triangles.extend([[a, b, c], [c, b, a]].iter().take(1 + twice));
                    soup.triangle_part.extend([part; 2].iter().take(1 + twice));
                }
            }
            let faces = soup.triangles.len() as u32;
            let is_pair = |face: &u32| {
                let [a, b, c] = soup.triangles[*face as usize];
                face + 1 < faces && soup.triangles[*face as usize + 1] == [c, b, a]
            };
            let pairs: Vec<[u32; 2]> = (0..faces).filter(is_pair).map(|face| [face, face + 1]).collect();
            let edges = Edges::build(9, &soup.triangles);
            let sheets = DoubledSheets::new(&soup, &edges, &pairs);
            for ([first, second], beyond) in pairs.iter().zip(&sheets.face_across) {
                let [a, b, c] = soup.triangles[*first as usize];
                for (ends, beyond) in [[a, b], [b, c], [c, a]].iter().zip(beyond) {
                    let is_other = |face: &u32| {
                        let corners = soup.triangles[*face as usize];
                        let is_second = pairs.iter().any(|pair| pair[1] == *face);
                        let same_part =
                            soup.triangle_part[*face as usize] == soup.triangle_part[*first as usize];
                        let is_own = face == first || face == second;
                        same_part && !is_own && !is_second && ends.iter().all(|end| corners.contains(end))
                    };
                    let others: Vec<u32> = (0..faces).filter(is_other).collect();
                    let expected = if let [only] = others[..] { only } else { NO_FACE_OR_PAIR };
                    assert_eq!(beyond.load(Relaxed), expected, "{round}");
                    found += usize::from(expected != NO_FACE_OR_PAIR);
                }
            }
        }
        assert!(found > 300, "{found}");
    }
}
