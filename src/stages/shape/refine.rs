//! Finer triangles on rounded surfaces: edges are cut in the middle of their arcs where the caller
//! wants it, until it wants no more.
//!
//! Whether and where an edge is cut depends on the edge alone, so that the faces on both its sides
//! agree and no crack opens. Faces are cut by the patterns of their cut sides.

use std::borrow::Cow;
use std::collections::hash_map::Entry;

use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::marking::{Marks, marks};
use super::smooth_normals::NO_NORMAL;
use super::splice::{Cuts, Facet, Kept, Refined, splice};
use super::{EdgeArc, SmoothNormals};
use crate::mesh::{EdgeMark, Mesh};

/// An edge is cut at most this many times over: into 256 pieces.
const MOST_CUTS: usize = 8;

/// Pieces that one task cuts.
const CHUNK: usize = 1 << 10;

/// The mesh and its normals with all edges of rounded surfaces cut that are wanted, or `None` where
/// hardly any is: see [`cuts`].
#[must_use]
pub fn refined(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    is_long: impl Fn(DVec3, DVec3) -> bool + Sync,
    want: impl Fn([DVec3; 2], [DVec3; 2]) -> f64 + Sync,
) -> Option<Refined> {
    let cuts = cuts(mesh, smooth, is_long, want)?;
    Some(splice(Cow::Borrowed(mesh), Cow::Borrowed(smooth), cuts))
}

/// What is cut of a mesh where all edges of rounded surfaces are cut that are wanted, or `None` where
/// hardly any is. `want` is given positions and unit normals of the ends of an edge, always in the
/// same order, if `is_long`, which is quickly told, holds for its ends; an edge is cut if it says more
/// than 1. Edges that part surfaces are never cut, nor thin ones, nor those of large parts that are dense enough. What was
/// cut loses the file's normals.
#[must_use]
pub fn cuts(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    is_long: impl Fn(DVec3, DVec3) -> bool + Sync,
    want: impl Fn([DVec3; 2], [DVec3; 2]) -> f64 + Sync,
) -> Option<Cuts> {
    if smooth.is_empty() {
        return None;
    }
    let Marks { cut, edges, thin } = marks(mesh, smooth, &is_long, &want);
    if cut.is_empty() && thin.is_empty() {
        return None;
    }
    let mut work = Work::new(mesh, smooth);
    work.cut(&cut, |_, _| true);
    let (kept, mut open) = work.affected(&edges);
    let mut done: Vec<Facet> = Vec::new();
    for cuts in 0..MOST_CUTS {
        if cuts > 0 {
            work.decide(&open, |ends, normals| is_long(ends[0], ends[1]) && want(ends, normals) > 1.0);
        }
        let parted: Vec<[Vec<Facet>; 2]> = open.par_chunks(CHUNK).map(|pieces| work.parted(pieces)).collect();
        open.clear();
        for [left, whole] in parted {
            open.extend(left);
            done.extend(whole);
        }
        if open.is_empty() {
            break;
        }
    }
    done.append(&mut open);
    let Work { positions, normals, .. } = work;
    Some(Cuts { positions, normals, pieces: done, kept, thin })
}

struct Work<'a> {
    mesh: &'a Mesh,
    smooth: &'a SmoothNormals,
    /// The new vertices: positions and normals.
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// The smooth vertex in the middle of an edge between two, [`NO_NORMAL`] where it is not cut. New ones are numbered behind
    /// those of the mesh.
    middles: FxHashMap<[u32; 2], u32>,
}

impl<'a> Work<'a> {
    fn new(mesh: &'a Mesh, smooth: &'a SmoothNormals) -> Self {
        Self { mesh, smooth, positions: Vec::new(), normals: Vec::new(), middles: FxHashMap::default() }
    }

    fn position(&self, v: u32) -> DVec3 {
        match self.smooth.vertices.get(v as usize) {
            Some(vertex) => self.mesh.positions[*vertex as usize],
            None => self.positions[v as usize - self.smooth.vertices.len()],
        }
    }

    fn normal(&self, v: u32) -> DVec3 {
        match self.smooth.normals.get(v as usize) {
            Some(normal) => *normal,
            None => self.normals[v as usize - self.smooth.normals.len()],
        }
    }

    fn ends(&self, ends: [u32; 2]) -> ([DVec3; 2], [DVec3; 2]) {
        (ends.map(|v| self.position(v)), ends.map(|v| self.normal(v)))
    }

    /// Cuts those of some edges for which `wanted` holds; the others stay whole.
    fn cut(&mut self, edges: &[[u32; 2]], wanted: impl Fn([DVec3; 2], [DVec3; 2]) -> bool + Sync) {
        let middle = |ends: &[u32; 2]| {
            let (positions, normals) = self.ends(*ends);
            wanted(positions, normals).then(|| {
                let arc = EdgeArc::new(positions, normals);
                (arc.at(0.5), arc.middle_normal())
            })
        };
        let middles: Vec<Option<(DVec3, DVec3)>> =
            edges.par_iter().with_min_len(1 << 8).map(middle).collect();
        self.middles.reserve(edges.len());
        for (ends, (position, normal)) in
            edges.iter().zip(middles).filter_map(|(ends, middle)| Some((*ends, middle?)))
        {
            self.middles.insert(ends, (self.smooth.vertices.len() + self.normals.len()) as u32);
            self.positions.push(position);
            self.normals.push(normal);
        }
    }

    /// Decides about the open sides of pieces that are not decided yet.
    fn decide(&mut self, pieces: &[Facet], wanted: impl Fn([DVec3; 2], [DVec3; 2]) -> bool + Sync) {
        // A side is mostly that of two pieces.
        self.middles.reserve(pieces.len() * 3 / 2);
        let mut asked = Vec::with_capacity(pieces.len() * 3 / 2);
        for piece in pieces {
            for side in (0..3).filter(|side| piece.open[*side]) {
                if let Entry::Vacant(vacant) = self.middles.entry(piece.side(side)) {
                    asked.push(*vacant.key());
                    vacant.insert(NO_NORMAL);
                }
            }
        }
        self.cut(&asked, wanted);
    }

    /// Which faces of the mesh stay as they are, and the pieces to begin with: those at the edges that are cut.
    fn affected(&self, cut: &[u32]) -> (Kept, Vec<Facet>) {
        let Self { mesh, smooth, .. } = self;
        let mut faces: Vec<u32> = Vec::with_capacity(2 * cut.len());
        cut.iter().for_each(|edge| faces.extend_from_slice(mesh.edges.faces(*edge as usize).list()));
        faces.par_sort_unstable();
        faces.dedup();
        let open_piece = |face: &u32| {
            let marks = mesh.edge_marks.get(*face as usize).copied().unwrap_or_default();
            let mut piece =
                Facet { corners: smooth.corners_of(*face)?, open: [false; 3], marks, face: *face };
            piece.open = [0, 1, 2].map(|side| self.middles.contains_key(&piece.side(side)));
            piece.open.contains(&true).then_some(piece)
        };
        let open: Vec<Facet> = faces.par_iter().with_min_len(CHUNK).filter_map(open_piece).collect();
        let kept = Kept::without(mesh.triangles.len(), open.iter().map(|piece| piece.face));
        (kept, open)
    }

    fn middle(&self, piece: &Facet, side: usize) -> Option<u32> {
        if !piece.open[side] {
            return None;
        }
        self.middles.get(&piece.side(side)).copied().filter(|middle| *middle != NO_NORMAL)
    }

    /// Cuts pieces: those that may be cut further, and those that are done.
    fn parted(&self, pieces: &[Facet]) -> [Vec<Facet>; 2] {
        let mut next = Vec::with_capacity(pieces.len() * 4);
        pieces.iter().for_each(|piece| self.split(piece, &mut next));
        let (open, done) = next.into_iter().partition(|piece: &Facet| piece.open.contains(&true));
        [open, done]
    }

    /// Cuts a piece by the pattern of its cut sides.
    fn split(&self, piece: &Facet, out: &mut Vec<Facet>) {
        let middles = [0, 1, 2].map(|side| self.middle(piece, side));
        let count = middles.iter().flatten().count();
        // Turned so that side 0 is the only cut one, or side 2 the only whole one.
        let turn = match count {
            1 => middles.iter().position(Option::is_some).unwrap_or(0),
            2 => (middles.iter().position(Option::is_none).unwrap_or(0) + 1) % 3,
            _ => 0,
        };
        let piece = piece.turned(turn);
        let m = |side: usize| middles[(side + turn) % 3].unwrap_or(NO_NORMAL);
        let [a, b, c] = piece.corners;
        // A whole side was decided about and stays; halves and new sides may be cut again.
        let own = |side: usize| (false, piece.marks[side]);
        let half = |side: usize| (true, piece.marks[side]);
        let new = (true, EdgeMark::Unmarked);
        let mut push = |corners: [u32; 3], sides: [(bool, EdgeMark); 3]| {
            out.push(Facet {
                corners,
                open: sides.map(|s| s.0),
                marks: sides.map(|s| s.1),
                face: piece.face,
            });
        };
        match count {
            0 => push(piece.corners, [own(0), own(1), own(2)]),
            1 => {
                push([a, m(0), c], [half(0), new, own(2)]);
                push([m(0), b, c], [half(0), own(1), new]);
            }
            2 => {
                push([m(0), b, m(1)], [half(0), half(1), new]);
                let length = |p: u32, q: u32| self.position(p).distance_squared(self.position(q));
                if length(a, m(1)) <= length(m(0), c) {
                    push([a, m(0), m(1)], [half(0), new, new]);
                    push([a, m(1), c], [new, half(1), own(2)]);
                } else {
                    push([a, m(0), c], [half(0), new, own(2)]);
                    push([m(0), m(1), c], [new, half(1), new]);
                }
            }
            _ => {
                push([a, m(0), m(2)], [half(0), new, half(2)]);
                push([m(0), b, m(1)], [half(0), half(1), new]);
                push([m(2), m(1), c], [new, half(1), half(2)]);
                push([m(0), m(1), m(2)], [new, new, new]);
            }
        }
    }
}

impl Facet {
    /// The smooth vertices at the ends of a side, smaller first.
    fn side(&self, side: usize) -> [u32; 2] {
        let (a, b) = (self.corners[side], self.corners[(side + 1) % 3]);
        [a.min(b), a.max(b)]
    }

    fn turned(&self, by: usize) -> Self {
        let pick = |k: usize| (k + by) % 3;
        Self {
            corners: [0, 1, 2].map(|k| self.corners[pick(k)]),
            open: [0, 1, 2].map(|k| self.open[pick(k)]),
            marks: [0, 1, 2].map(|k| self.marks[pick(k)]),
            face: self.face,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    fn icosahedron() -> Mesh {
        let golden = (1.0 + 5f64.sqrt()) / 2.0;
        let mut positions = Vec::new();
        for (x, y) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
            let p = DVec3::new(x, y, 0.0).normalize();
            positions.extend([p, DVec3::new(p.y, 0.0, p.x), DVec3::new(0.0, p.x, p.y)]);
        }
        // Three corners an edge's length from each other are a face.
        let near = |a: usize, b: usize| positions[a].distance(positions[b]) < 1.1;
        let mut triangles = Vec::new();
        for a in 0..12 {
            for b in a + 1..12 {
                for c in (b + 1..12).filter(|c| near(a, b) && near(b, *c) && near(*c, a)) {
                    let outward = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
                    let face = [a as u32, b as u32, c as u32];
                    let [a, b, c] = face;
                    triangles.push(if outward.dot(positions[a as usize]) > 0.0 { face } else { [a, c, b] });
                }
            }
        }
        Mesh::build(Soup { positions, triangles, ..Soup::default() })
    }

    #[test]
    fn a_refined_icosahedron_is_a_sphere_without_cracks() {
        let mesh = icosahedron();
        let smooth = SmoothNormals::rounded(&mesh);
        // Only one half is refined, so that all patterns occur.
        let wanted = |ends: [DVec3; 2], _: [DVec3; 2]| {
            let half = ends[0].x + ends[1].x + 0.3 * (ends[0].y + ends[1].y) > 0.4;
            if half { ends[0].distance(ends[1]) * 10.0 } else { 0.0 }
        };
        let Refined { mesh: finer, smooth: normals, hosts, edges, .. } =
            refined(&mesh, &smooth, |_, _| true, wanted).expect("edges are longer than that");
        assert_eq!((mesh.triangles.len(), edges.len()), (20, 30));
        assert!(finer.triangles.len() > 500 && hosts.len() == finer.triangles.len());
        assert_eq!((finer.edges.border_count(), finer.edges.non_manifold_count()), (0, 0));
        let euler = finer.positions.len() as i64 - finer.edges.len() as i64 + finer.triangles.len() as i64;
        assert_eq!(euler, 2);
        for (vertex, normal) in normals.vertices.iter().zip(&normals.normals) {
            let p = finer.positions[*vertex as usize];
            assert!((p.length() - 1.0).abs() < 1e-9 && p.distance(*normal) < 1e-6, "{p} {normal}");
        }
        for face in 0..finer.triangles.len() {
            let [a, b, c] = finer.corners(crate::mesh::FaceId(face as u32));
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "every face keeps its side");
        }
    }

    #[test]
    fn what_nobody_wants_is_left() {
        let mesh = icosahedron();
        assert!(refined(&mesh, &SmoothNormals::rounded(&mesh), |_, _| true, |_, _| 0.0).is_none());
        assert!(refined(&mesh, &SmoothNormals::default(), |_, _| true, |_, _| 2.0).is_none());
    }
}
