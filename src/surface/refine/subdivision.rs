//! Subdivision of the faces of curved surfaces: edges are split at the middle of their arcs until the caller
//! wants no more.
//!
//! Whether and where an edge is split depends on the edge alone. Both its faces agree, so no cracks open.
//! Faces are cut by the pattern of their split sides.

#[cfg(test)]
use std::borrow::Cow;

use crate::parallel::prelude::*;
use glam::DVec3;

use super::edge_marks::{EdgeMarks, marks};
use super::face_pieces::{
    CLOSED_SIDE, STRAIGHT_SIDE, SideState, SplitPieces, SubdividedPiece, SubdividedSide, is_open,
};
use super::mesh_splice::{KeptFaces, MeshCuts, PieceTriangle};
#[cfg(test)]
use super::mesh_splice::{RefinedMesh, splice};
use crate::mesh::{EdgeMark, FaceId, Mesh};
use crate::surface::normals::smooth_normals::NO_NORMAL;
use crate::surface::{EdgeArc, SmoothNormals};

/// Maximum number of times an edge is halved: 256 pieces.
const MAX_SPLIT_DEPTH: usize = 8;

/// Number of pieces per task.
const PIECES_PER_TASK: usize = 1 << 10;

/// The mesh and its normals after subdivision, or `None` where hardly any edge is split; see [`cuts`].
#[cfg(test)]
#[must_use]
pub(crate) fn refined(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    is_long: impl Fn(DVec3, DVec3) -> bool + Sync,
    want: impl Fn([DVec3; 2], [DVec3; 2]) -> f64 + Sync,
) -> Option<RefinedMesh> {
    let cuts = cuts(mesh, smooth, is_long, |_, _| true, want)?;
    Some(splice(Cow::Borrowed(mesh), Cow::Borrowed(smooth), cuts))
}

/// Subdivision of a mesh, or `None` where hardly any edge is split.
///
/// `want` takes positions and unit normals of the ends of an edge, always in the same order. The edge is
/// split if the result exceeds 1. Edges are examined only if
/// - `is_long`, a fast test, holds for their ends,
/// - `may` holds for the ends and squared length of a gentle edge.
///
/// Never split are separating edges, edges of thin walls, and edges of large parts that are dense enough.
/// Split faces lose the normals of the file.
#[must_use]
pub(crate) fn cuts(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    is_long: impl Fn(DVec3, DVec3) -> bool + Sync,
    may: impl Fn([u32; 2], f64) -> bool + Sync,
    want: impl Fn([DVec3; 2], [DVec3; 2]) -> f64 + Sync,
) -> Option<MeshCuts> {
    if smooth.is_empty() {
        return None;
    }
    let EdgeMarks { cut, edges, thin } = marks(mesh, smooth, (&is_long, &may), &want);
    if cut.is_empty() && thin.is_empty() {
        return None;
    }
    let mut work = Subdivision::of(mesh, smooth, &cut);
    let (kept, mut open) = work.affected(&edges, &thin);
    let mut done: Vec<PieceTriangle> = Vec::new();
    let mut straight: Vec<[u32; 2]> = Vec::new();
    for cuts in 0..MAX_SPLIT_DEPTH {
        if cuts > 0 {
            work.decide(&open, |ends, normals| is_long(ends[0], ends[1]) && want(ends, normals) > 1.0);
        }
        let parted = work.split_pieces(&open);
        open.clear();
        for SplitPieces { open: left, finished: whole, inner, straight: level } in parted {
            open.extend(left);
            done.extend(whole);
            work.sides.extend(inner);
            straight.extend(level);
        }
        if open.is_empty() {
            break;
        }
    }
    done.extend(open.iter().map(|piece| piece.facet));
    let Subdivision { positions, normals, .. } = work;
    let (old, known) = (mesh.positions.len(), smooth.vertices.len());
    let vertex = |v: u32| match smooth.vertices.get(v as usize) {
        Some(vertex) => *vertex,
        None => (old + v as usize - known) as u32,
    };
    Some(MeshCuts {
        vertices: (old as u32..(old + positions.len()) as u32).collect(),
        positions,
        normals,
        triangles: done.iter().map(|piece| piece.corners.map(vertex)).collect(),
        pieces: done,
        kept,
        thin,
        straight,
        edge_pieces: Vec::new(),
    })
}

struct Subdivision<'a> {
    mesh: &'a Mesh,
    smooth: &'a SmoothNormals,
    /// Positions and normals of the new vertices, numbered after those of the mesh.
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// All sides that are or were open. Neighbours share a side by its index, so that no vertex is created
    /// twice.
    sides: Vec<SubdividedSide>,
}

impl<'a> Subdivision<'a> {
    /// Starts with the sides between some smooth vertices, which are split and get the first indices.
    fn of(mesh: &'a Mesh, smooth: &'a SmoothNormals, cut: &[[u32; 2]]) -> Self {
        let sides = cut.iter().map(|[a, b]| SubdividedSide::open(*a, *b)).collect();
        let mut work = Self { mesh, smooth, positions: Vec::new(), normals: Vec::new(), sides };
        work.cut(&(0..cut.len() as u32).collect::<Vec<_>>(), |_, _| true);
        work
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

    /// Splits the `sides` that satisfy `wanted`; the others stay whole.
    fn cut(&mut self, sides: &[u32], wanted: impl Fn([DVec3; 2], [DVec3; 2]) -> bool + Sync) {
        let middle = |side: &u32| {
            let [a, b] = self.sides[*side as usize].ends;
            let positions = [self.position(a), self.position(b)];
            let normals = [self.normal(a), self.normal(b)];
            wanted(positions, normals).then(|| {
                let arc = EdgeArc::new(positions, normals);
                (arc.at(0.5), arc.middle_normal())
            })
        };
        let middles: Vec<Option<(DVec3, DVec3)>> =
            sides.par_iter().with_min_len(1 << 8).map(middle).collect();
        for (side, middle) in sides.iter().zip(middles) {
            let Some((position, normal)) = middle else {
                self.sides[*side as usize].state = SideState::Whole;
                continue;
            };
            let middle = (self.smooth.vertices.len() + self.normals.len()) as u32;
            let halves = self.sides.len() as u32;
            let [a, b] = self.sides[*side as usize].ends;
            self.sides[*side as usize].state = SideState::Cut { middle, halves };
            self.sides.extend([SubdividedSide::open(a, middle), SubdividedSide::open(b, middle)]);
            self.positions.push(position);
            self.normals.push(normal);
        }
    }

    /// Decides on the open sides of pieces that are undecided.
    fn decide(&mut self, pieces: &[SubdividedPiece], wanted: impl Fn([DVec3; 2], [DVec3; 2]) -> bool + Sync) {
        // Most sides belong to two pieces.
        let mut asked = Vec::with_capacity(pieces.len() * 3 / 2);
        for side in pieces.iter().flat_map(|piece| piece.sides).filter(is_open) {
            let fate = &mut self.sides[side as usize].state;
            if *fate == SideState::Open {
                *fate = SideState::Whole;
                asked.push(side);
            }
        }
        self.cut(&asked, wanted);
    }

    /// The faces that stay, and the first pieces: faces at the split edges `cut`, whose sides have the first
    /// indices. `thin` edges stay straight.
    fn affected(&self, cut: &[u32], thin: &[usize]) -> (KeptFaces, Vec<SubdividedPiece>) {
        let Self { mesh, smooth, .. } = self;
        // Few vertices are on straight edges, so most sides need no search.
        let has_straight = !(smooth.straight.is_empty() && thin.is_empty());
        let mut at_straight = vec![false; if has_straight { mesh.positions.len() } else { 0 }];
        for edge in smooth.straight.iter().chain(thin.iter().copied()) {
            mesh.edges.vertices[edge].iter().for_each(|v| at_straight[*v as usize] = true);
        }
        let is_straight = |[a, b]: [u32; 2]| {
            let ends = [a, b].map(|v| smooth.vertices[v as usize]);
            if !ends.iter().all(|v| at_straight[*v as usize]) {
                return false;
            }
            let edge = mesh.edges.between(ends[0], ends[1]);
            edge.is_some_and(|edge| smooth.straight.contains(edge) || thin.binary_search(&edge).is_ok())
        };
        // Whether the arc over a side would rise by more than the width of the face.
        let is_sliver = |face: u32, ends: [u32; 2]| {
            let at = ends.map(|v| self.position(v));
            let rise = EdgeArc::new(at, ends.map(|v| self.normal(v))).height().length();
            rise * at[0].distance(at[1]) > 2.0 * mesh.area(FaceId(face))
        };
        // Pairs of a face and one of its split sides.
        let mut at: Vec<(u32, u32)> = Vec::with_capacity(2 * cut.len());
        for (side, edge) in cut.iter().enumerate() {
            at.extend(mesh.edges.faces(*edge as usize).list().iter().map(|face| (*face, side as u32)));
        }
        at.par_sort_unstable();
        let open_piece = |at: &[(u32, u32)]| {
            let face = at.first()?.0;
            let corners = smooth.corners_of(face)?;
            let marks = mesh.edge_marks.get(face as usize).copied().unwrap_or_default();
            let ends = [0, 1, 2].map(|k| SubdividedSide::open(corners[k], corners[(k + 1) % 3]).ends);
            let stay = ends.map(|ends| has_straight && is_straight(ends));
            let is_between = stay.iter().filter(|stays| **stays).count() > 1;
            let sides = [0, 1, 2].map(|k| {
                match at.iter().find(|(_, side)| self.sides[*side as usize].ends == ends[k]) {
                    Some((_, side)) => *side,
                    None if stay[k] && (is_between || is_sliver(face, ends[k])) => STRAIGHT_SIDE,
                    None => CLOSED_SIDE,
                }
            });
            let facet = PieceTriangle { corners, marks, face };
            sides.iter().any(is_open).then_some(SubdividedPiece { facet, sides })
        };
        let open: Vec<SubdividedPiece> = at.par_chunk_by(|a, b| a.0 == b.0).filter_map(open_piece).collect();
        let kept = KeptFaces::without(mesh.triangles.len(), open.iter().map(|piece| piece.facet.face));
        (kept, open)
    }

    /// Middle vertices of the split sides of a piece, and the indices of their halves.
    #[inline]
    fn cuts(&self, piece: &SubdividedPiece) -> [Option<(u32, u32)>; 3] {
        let mut cuts = [None; 3];
        for (cut, side) in cuts.iter_mut().zip(piece.sides) {
            if let Some(SubdividedSide { state: SideState::Cut { middle, halves }, .. }) =
                self.sides.get(side as usize)
            {
                *cut = Some((*middle, *halves));
            }
        }
        cuts
    }

    /// Cuts pieces whose sides are decided.
    fn split_pieces(&self, pieces: &[SubdividedPiece]) -> Vec<SplitPieces> {
        // A piece gets one new inner side per split side.
        let inner = |pieces: &[SubdividedPiece]| {
            pieces.iter().map(|piece| self.cuts(piece).iter().flatten().count()).sum::<usize>()
        };
        let counts: Vec<usize> = pieces.par_chunks(PIECES_PER_TASK).with_max_len(1).map(inner).collect();
        let mut first = self.sides.len();
        let of_chunk = |(pieces, count): (_, usize)| {
            first += count;
            (pieces, first - count)
        };
        let chunks: Vec<(&[SubdividedPiece], usize)> =
            pieces.chunks(PIECES_PER_TASK).zip(counts).map(of_chunk).collect();
        let part = |(pieces, first): (&[SubdividedPiece], usize)| {
            let mut parted = SplitPieces {
                open: Vec::with_capacity(pieces.len() * 2),
                finished: Vec::with_capacity(pieces.len() * 2),
                inner: Vec::with_capacity(pieces.len() * 3),
                straight: Vec::new(),
            };
            pieces.iter().for_each(|piece| self.split(piece, first, &mut parted));
            parted
        };
        chunks.into_par_iter().with_max_len(1).map(part).collect()
    }

    /// Cuts a piece by the pattern of its split sides. `first` is the index of the first new side of this
    /// batch.
    fn split(&self, piece: &SubdividedPiece, first: usize, out: &mut SplitPieces) {
        let cuts = self.cuts(piece);
        let count = cuts.iter().flatten().count();
        // Rotated so that side 0 is the only split side, or side 2 the only whole one.
        let turn = match count {
            1 => cuts.iter().position(Option::is_some).unwrap_or(0),
            2 => (cuts.iter().position(Option::is_none).unwrap_or(0) + 1) % 3,
            _ => 0,
        };
        let SubdividedPiece { facet, sides } = piece.rotated(turn);
        let cut = |side: usize| cuts[(side + turn) % 3].unwrap_or((NO_NORMAL, CLOSED_SIDE));
        let m = |side: usize| cut(side).0;
        let [a, b, c] = facet.corners;
        // Whole sides were decided and stay. Halves and new sides may be split again.
        let own = |side: usize| {
            (if sides[side] == STRAIGHT_SIDE { STRAIGHT_SIDE } else { CLOSED_SIDE }, facet.marks[side])
        };
        let half = |side: usize, end: u32| {
            let is_second = end != self.sides[sides[side] as usize].ends[0];
            (cut(side).1 + u32::from(is_second), facet.marks[side])
        };
        // The surface is also straight between two straight sides, and along a straight side of a sliver.
        // Otherwise the middle of a short side would rise over the full length of the long sides.
        let is_level = (0..3).any(|side| sides[side] == STRAIGHT_SIDE);
        let new = |k: usize| (if is_level { STRAIGHT_SIDE } else { (first + k) as u32 }, EdgeMark::Unmarked);
        let known = out.inner.len();
        let mut push = |corners: [u32; 3], sides: [(u32, EdgeMark); 3]| {
            let facet = PieceTriangle { corners, marks: sides.map(|side| side.1), face: facet.face };
            let sides = sides.map(|side| side.0);
            if sides.iter().any(is_open) {
                out.open.push(SubdividedPiece { facet, sides });
            } else {
                out.finished.push(facet);
            }
        };
        match count {
            0 => push([a, b, c], [own(0), own(1), own(2)]),
            1 => {
                let across = new(known);
                push([a, m(0), c], [half(0, a), across, own(2)]);
                push([m(0), b, c], [half(0, b), own(1), across]);
                out.inner.push(SubdividedSide::open(m(0), c));
            }
            2 => {
                let (across, rest) = (new(known), new(known + 1));
                push([m(0), b, m(1)], [half(0, b), half(1, b), across]);
                let length = |p: u32, q: u32| self.position(p).distance_squared(self.position(q));
                let diagonal = if length(a, m(1)) <= length(m(0), c) {
                    push([a, m(0), m(1)], [half(0, a), across, rest]);
                    push([a, m(1), c], [rest, half(1, c), own(2)]);
                    SubdividedSide::open(a, m(1))
                } else {
                    push([a, m(0), c], [half(0, a), rest, own(2)]);
                    push([m(0), m(1), c], [across, half(1, c), rest]);
                    SubdividedSide::open(m(0), c)
                };
                out.inner.extend([SubdividedSide::open(m(0), m(1)), diagonal]);
            }
            _ => {
                let [at_a, at_b, at_c] = [0, 1, 2].map(|k| new(known + k));
                push([a, m(0), m(2)], [half(0, a), at_a, half(2, a)]);
                push([m(0), b, m(1)], [half(0, b), half(1, b), at_b]);
                push([m(2), m(1), c], [at_c, half(1, c), half(2, c)]);
                push([m(0), m(1), m(2)], [at_b, at_c, at_a]);
                out.inner.extend(
                    [[m(0), m(2)], [m(0), m(1)], [m(1), m(2)]].map(|[p, q]| SubdividedSide::open(p, q)),
                );
            }
        }
        if is_level {
            out.straight.extend(out.inner[known..].iter().map(|side| side.ends));
        }
    }
}

#[cfg(test)]
mod tests;
