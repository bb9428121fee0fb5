//! Sheets: surfaces whose faces stand twice, back to back, and the side of each that stays.
//!
//! Leaves and cloth are often modelled so. If each pair kept the face that happens to come first, the surface
//! would turn over from face to face. Hence a side is chosen for a whole sheet: what goes on in single faces
//! goes on as they do, and other sheets show outward, away from the middle of the model.

use super::soup::Soup;
use super::{EdgeFaces, Edges};

const NONE: u32 = u32::MAX;

/// Of each pair of faces that have the same corners and run opposite ways the face that stays.
pub(super) fn one_side(soup: &Soup, edges: &Edges, pairs: &[[u32; 2]]) -> Vec<u32> {
    if pairs.is_empty() {
        return Vec::new();
    }
    let mut pair_of = vec![NONE; soup.triangles.len()];
    for (pair, faces) in pairs.iter().enumerate() {
        faces.iter().for_each(|face| pair_of[*face as usize] = pair as u32);
    }
    let sheets = Sheets { soup, edges, pairs, pair_of };
    let mut sides: Vec<Option<usize>> = vec![None; pairs.len()];
    for seed in 0..pairs.len() {
        if sides[seed].is_none() {
            sheets.choose(seed, &mut sides);
        }
    }
    pairs.iter().zip(sides).map(|(faces, side)| faces[side.unwrap_or_default()]).collect()
}

struct Sheets<'a> {
    soup: &'a Soup,
    edges: &'a Edges,
    pairs: &'a [[u32; 2]],
    pair_of: Vec<u32>,
}

/// What lies on the other side of an edge of a pair.
enum Beyond {
    /// Nothing, or too much.
    Nothing,
    Pair(usize),
    Single(u32),
}

impl Sheets<'_> {
    /// Chooses the side of all pairs of the sheet to which one belongs.
    fn choose(&self, seed: usize, sides: &mut [Option<usize>]) {
        sides[seed] = Some(0);
        let mut members = vec![(seed, 0)];
        let mut done = 0;
        // Single faces that this side goes on in, less those in which the other does; and its volume.
        let (mut votes, mut volume) = (0i64, 0.0);
        while let Some(&(pair, side)) = members.get(done) {
            done += 1;
            let face = self.pairs[pair][side];
            let [a, b, c] = self.soup.triangles[face as usize];
            let [p, q, r] = [a, b, c].map(|v| self.soup.positions[v as usize]);
            volume += p.dot(q.cross(r));
            for edge in [[a, b], [b, c], [c, a]] {
                match self.beyond(pair, edge) {
                    Beyond::Nothing => {}
                    Beyond::Single(other) => votes += if self.runs(other, edge) { -1 } else { 1 },
                    Beyond::Pair(other) => {
                        // A surface runs along each edge both ways.
                        let side = usize::from(self.runs(self.pairs[other][0], edge));
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

    /// What of the same part goes on beyond an edge of a pair.
    fn beyond(&self, pair: usize, [a, b]: [u32; 2]) -> Beyond {
        let Ok(edge) = self.edges.vertices.binary_search(&[a.min(b), a.max(b)]) else {
            return Beyond::Nothing;
        };
        let part = |face: u32| self.soup.triangle_part.get(face as usize);
        let own = part(self.pairs[pair][0]);
        let faces: EdgeFaces = self.edges.faces(edge);
        let mut others = faces.list().iter().copied().filter(|face| {
            let other = self.pair_of[*face as usize];
            // Of the two faces of a pair one is enough.
            let counts = other == NONE || self.pairs[other as usize][0] == *face;
            counts && other != pair as u32 && part(*face) == own
        });
        match (others.next(), others.next()) {
            (Some(face), None) => match self.pair_of[face as usize] {
                NONE => Beyond::Single(face),
                other => Beyond::Pair(other as usize),
            },
            _ => Beyond::Nothing,
        }
    }

    /// Whether a face runs from the first of two vertices to the second.
    fn runs(&self, face: u32, [from, to]: [u32; 2]) -> bool {
        let [a, b, c] = self.soup.triangles[face as usize];
        [[a, b], [b, c], [c, a]].contains(&[from, to])
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::mesh::{EdgeFaces, FaceId, Mesh, Soup};

    /// A bent strip of squares, of which those from `single` on have one face only; which of the two
    /// faces of a triangle comes first changes along it.
    fn strip(single: u32, shift: f64) -> Mesh {
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
        // Something far below or above, so that the strip is not in the middle.
        let far = soup.positions.len() as u32;
        soup.positions.extend([0.0, 1.0, 2.0].map(|x| DVec3::new(x, x * x, -shift)));
        soup.triangles.push([far, far + 1, far + 2]);
        Mesh::build(soup)
    }

    /// How many faces of a strip face up, after a look at its edges.
    fn upward(mesh: &Mesh) -> usize {
        let turned = |e: &usize| matches!(mesh.edges.faces(*e), EdgeFaces::Two { same_way: true, .. });
        assert_eq!((0..mesh.edges.len()).filter(turned).count(), 0);
        let middle = |face: usize| mesh.corners(FaceId(face as u32)).iter().sum::<DVec3>() / 3.0;
        let strip: Vec<usize> = (0..mesh.triangles.len()).filter(|f| middle(*f).y < 1.0).collect();
        assert_eq!((mesh.triangles.len(), strip.len()), (21, 20));
        strip.into_iter().filter(|face| mesh.face_normals[*face][2] > 0.0).count()
    }

    #[test]
    fn a_sheet_keeps_its_outer_side() {
        let [above, below] = [40.0, -40.0].map(|shift| strip(10, shift));
        assert_eq!((above.cleaning.doubled, below.cleaning.doubled), (20, 20));
        assert_eq!((upward(&above), upward(&below)), (20, 0));
    }

    #[test]
    fn a_sheet_goes_on_as_its_single_faces_do() {
        for shift in [40.0, -40.0] {
            assert_eq!(upward(&strip(7, shift)), 20);
        }
    }
}
