//! [`PairSearch`]: where triangles of a mesh pass through each other, kept for meshes of which some of them are cut.
//!
//! A view cuts faces near its contours and leaves the others as they are, so that of two that are left it is known whether they
//! meet. Only the pieces are sought: in the tree of the mesh, with boxes around all the pieces of a face instead of the face.

use rayon::prelude::*;

use super::boxes::{BoxTree, share_a_vertex};
use super::fine_box::FineBox;
use super::intersect::{
    IntersectionCurves, IntersectionInput, Pair, bounds, intersections_of_parts, join, pairs_in, pairs_of,
};
use crate::math::grouped::{Grouped, grouped};

/// Faces that were cut, handled by one task.
const FACES_PER_TASK: usize = 64;

/// A mesh searched in full.
#[derive(Debug, Clone)]
pub struct PairSearch {
    /// None without triangles.
    tree: Option<BoxTree>,
    /// Where the tree has each face.
    ranks: Vec<u32>,
    pairs: Vec<Pair>,
}

/// Which faces of a finer mesh are those of the mesh it was made of.
#[derive(Debug, Clone, Copy)]
pub struct Hosts<'a> {
    /// The face of the given mesh that each face is, or is part of.
    pub faces: &'a [u32],
    /// The first so many are whole; their hosts ascend.
    pub kept: usize,
}

impl PairSearch {
    /// Searches a mesh of several parts, each part as large as `scale` says of each face.
    #[must_use]
    pub fn new(input: &IntersectionInput, scale: impl Fn(u32) -> f64 + Sync) -> Self {
        let Some((low, high)) = bounds(input.positions, input.triangles) else {
            return Self { tree: None, ranks: Vec::new(), pairs: Vec::new() };
        };
        let tree = BoxTree::new(input.positions, input.triangles, input.active, low, high);
        let (pairs, ranks) = (pairs_in(&tree, input, scale), tree.ranks(input.triangles.len()));
        Self { tree: Some(tree), ranks, pairs }
    }

    /// The curves of the mesh.
    #[must_use]
    pub fn curves(&self) -> IntersectionCurves {
        join(&self.pairs)
    }

    /// The curves of a mesh that was made of this one by cutting faces, as a search of it in full would find them. `scale` is of its
    /// faces.
    #[must_use]
    pub fn curves_of_finer(
        &self,
        finer: &IntersectionInput,
        hosts: Hosts,
        scale: impl Fn(u32) -> f64 + Sync,
    ) -> IntersectionCurves {
        let Some(tree) = &self.tree else { return IntersectionCurves::default() };
        let mut places = vec![u32::MAX; self.ranks.len()];
        for (place, face) in hosts.faces[..hosts.kept].iter().enumerate() {
            places[*face as usize] = place as u32;
        }
        let whole = |face: u32| places.get(face as usize).copied().filter(|place| *place != u32::MAX);
        let left =
            |pair: &Pair| Some(Pair { faces: [whole(pair.faces[0])?, whole(pair.faces[1])?], ..*pair });
        let mut pairs: Vec<Pair> = self.pairs.iter().filter_map(left).collect();

        // Pieces of faces without area may have some.
        let is_active = |face: usize| finer.active.get(face).is_none_or(|active| *active);
        let is_known =
            |face: usize| self.ranks.get(hosts.faces[face] as usize).is_some_and(|r| *r != u32::MAX);
        if (hosts.kept..finer.triangles.len()).any(|piece| is_active(piece) && !is_known(piece)) {
            return intersections_of_parts(finer, scale);
        }

        let cut = Cut::new(tree, &self.ranks, finer, hosts);
        let found = |faces: &[(u32, u32)]| {
            let (mut found, mut search) = (Vec::new(), Search::default());
            for (rank, face) in faces {
                cut.search_face(*rank, *face, whole, &mut search);
                for (piece, others) in search.pieces.iter().zip(&search.others) {
                    pairs_of(finer, *piece, others, &scale, &mut found);
                }
            }
            found
        };
        pairs.par_extend(cut.faces.par_chunks(FACES_PER_TASK).with_max_len(8).flat_map_iter(found));
        pairs.par_sort_unstable_by_key(|pair| pair.faces);
        join(&pairs)
    }
}

/// The faces that were cut, and a tree with boxes around their pieces.
struct Cut<'a> {
    finer: &'a IntersectionInput<'a>,
    tree: BoxTree,
    kept: usize,
    /// The ranks and numbers of the faces, by rank.
    faces: Vec<(u32, u32)>,
    /// The pieces by the rank of their face.
    pieces: Grouped<u32>,
    /// By piece.
    boxes: Vec<FineBox>,
    ranks: &'a [u32],
}

/// What one task finds, kept so that it is allocated once.
#[derive(Default)]
struct Search {
    stack: Vec<(usize, usize)>,
    /// Faces near a face: whole ones of the finer mesh with their boxes, and the ranks of others that were cut.
    whole: Vec<(u32, FineBox)>,
    cut: Vec<u32>,
    /// The pieces of a face.
    pieces: Vec<u32>,
    /// What may pass through each of them.
    others: Vec<Vec<u32>>,
}

impl<'a> Cut<'a> {
    fn new(tree: &BoxTree, ranks: &'a [u32], finer: &'a IntersectionInput<'a>, hosts: Hosts) -> Self {
        let kept = hosts.kept;
        let corners = |triangle: &[u32; 3]| triangle.map(|v| finer.positions[v as usize]);
        let boxes: Vec<FineBox> = finer.triangles[kept..]
            .par_iter()
            .with_min_len(1 << 10)
            .map(|triangle| tree.box_of(corners(triangle)))
            .collect();
        let is_sought = |piece: &usize| finer.active.get(*piece).is_none_or(|active| *active);
        let pieces = grouped(ranks.len(), |put| {
            for piece in (kept..finer.triangles.len()).filter(is_sought) {
                put(ranks[hosts.faces[piece] as usize] as usize, piece as u32);
            }
        });
        let around = |rank: usize| {
            let own = pieces.of(rank).iter().map(|piece| boxes[*piece as usize - kept]);
            Some((rank as u32, own.reduce(FineBox::union)?))
        };
        let changed: Vec<(u32, FineBox)> = (0..pieces.count()).filter_map(around).collect();
        let host = |rank: u32| hosts.faces[pieces.of(rank as usize)[0] as usize];
        let faces = changed.iter().map(|(rank, _)| (*rank, host(*rank))).collect();
        Self { finer, tree: tree.with_boxes(&changed), kept, faces, pieces, boxes, ranks }
    }

    /// Finds what may pass through the pieces of a face: of two faces that were cut, one finds the other.
    fn search_face(&self, rank: u32, face: u32, whole: impl Fn(u32) -> Option<u32>, search: &mut Search) {
        let Search { stack, whole: kept, cut, pieces, others } = search;
        let of_piece = |piece: u32| self.boxes[piece as usize - self.kept];
        let triangle = |face: u32| self.finer.triangles[face as usize];
        pieces.clear();
        pieces.extend_from_slice(self.pieces.of(rank as usize));
        others.resize_with(pieces.len().max(others.len()), Vec::new);
        others.iter_mut().for_each(Vec::clear);
        let Some(own) = pieces.iter().map(|piece| of_piece(*piece)).reduce(FineBox::union) else { return };
        kept.clear();
        cut.clear();
        self.tree.near(own, stack, |other| {
            if other == face {
                return;
            }
            let other_rank = self.ranks[other as usize];
            if !self.pieces.of(other_rank as usize).is_empty() {
                cut.extend((other_rank > rank).then_some(other_rank));
            } else {
                let of_face =
                    |face: u32| self.tree.box_of(triangle(face).map(|v| self.finer.positions[v as usize]));
                kept.extend(whole(other).map(|face| (face, of_face(face))));
            }
        });
        let are_strangers = |piece: u32, other: u32| !share_a_vertex(triangle(piece), triangle(other));
        for (k, piece) in pieces.iter().enumerate() {
            let own = of_piece(*piece);
            let near = kept.iter().filter(|(face, far)| own.overlaps(*far) && are_strangers(*piece, *face));
            others[k].extend(near.map(|(face, _)| *face));
            let of_cut = cut.iter().flat_map(|rank| self.pieces.of(*rank as usize)).copied();
            let later = pieces[k + 1..].iter().copied();
            let near = of_cut.chain(later);
            others[k]
                .extend(near.filter(|other| own.overlaps(of_piece(*other)) && are_strangers(*piece, *other)));
        }
    }
}
