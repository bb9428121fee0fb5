//! [`IntersectionCache`]: the intersecting triangle pairs of a mesh, reused after some of its faces are cut.
//!
//! Each view cuts the faces near its contours and keeps the others.
//!
//! 1. Pairs of two kept faces are taken from the cache.
//! 2. The tree of the original mesh is refitted: the box of a cut face becomes the box of its pieces.
//! 3. The pieces of each cut face are searched in this tree.

use crate::parallel::prelude::*;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::mesh::bvh::box_tree::{BoxTree, TreeFaces, share_a_vertex};
use crate::mesh::bvh::node_boxes::Box3;
use crate::mesh::intersect::intersection_curves::{
    IntersectingPair, IntersectionCurves, IntersectionInput, bounds, intersections_of_parts, join, pairs_in,
    pairs_of,
};
use crate::mesh::intersect::triangle_pair::PairTolerance;

/// Number of cut faces per task.
const FACES_PER_TASK: usize = 64;

/// Intersecting pairs of a mesh, and the box tree that found them.
#[derive(Debug, Clone)]
pub(crate) struct IntersectionCache {
    /// Box tree of the mesh; `None` without triangles.
    tree: Option<BoxTree>,
    /// Rank of each face in the tree.
    ranks: Vec<u32>,
    pairs: Vec<IntersectingPair>,
}

/// Mapping from the faces of a finer mesh to the original mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceHosts<'a> {
    /// The original face that each face is or is part of.
    pub faces: &'a [u32],
    /// Number of kept faces, which come first; their hosts ascend.
    pub kept_count: usize,
}

impl IntersectionCache {
    /// Finds all intersecting pairs of a mesh. `tolerance` returns the tolerance of a face's part.
    #[must_use]
    pub(crate) fn new(input: &IntersectionInput, tolerance: impl Fn(u32) -> PairTolerance + Sync) -> Self {
        let Some((low, high)) = bounds(input.positions, input.triangles) else {
            return Self { tree: None, ranks: Vec::new(), pairs: Vec::new() };
        };
        let tree = BoxTree::new(input.positions, input.triangles, input.active, low, high);
        let (pairs, ranks) = (pairs_in(&tree, input, tolerance), tree.ranks(input.triangles.len()));
        Self { tree: Some(tree), ranks, pairs }
    }

    /// The intersection curves of the mesh.
    #[cfg(test)]
    #[must_use]
    pub(crate) fn curves(&self) -> IntersectionCurves {
        join(&self.pairs)
    }

    /// The intersection curves of a finer mesh, made from this one by cutting faces. The result equals that
    /// of a full search. `tolerance` takes faces of the finer mesh.
    #[must_use]
    pub(crate) fn refined_curves(
        &self,
        finer: &IntersectionInput,
        hosts: FaceHosts,
        tolerance: impl Fn(u32) -> PairTolerance + Sync,
    ) -> IntersectionCurves {
        let Some(tree) = &self.tree else { return IntersectionCurves::default() };
        let mut kept_index = vec![u32::MAX; self.ranks.len()];
        for (index, face) in hosts.faces[..hosts.kept_count].iter().enumerate() {
            kept_index[*face as usize] = index as u32;
        }
        let uncut_face =
            |face: u32| kept_index.get(face as usize).copied().filter(|found_index| *found_index != u32::MAX);
        let left = |pair: &IntersectingPair| {
            Some(IntersectingPair {
                faces: [uncut_face(pair.faces[0])?, uncut_face(pair.faces[1])?],
                ..*pair
            })
        };
        let mut pairs: Vec<IntersectingPair> = self.pairs.iter().filter_map(left).collect();

        // A piece of a face that is not in the tree (one without area) may have an area. Then a full search
        // is needed.
        let is_active = |face: usize| finer.active.get(face).is_none_or(|active| *active);
        let is_known =
            |face: usize| self.ranks.get(hosts.faces[face] as usize).is_some_and(|r| *r != u32::MAX);
        if (hosts.kept_count..finer.triangles.len()).any(|piece| is_active(piece) && !is_known(piece)) {
            return intersections_of_parts(finer, tolerance);
        }

        let cut = RefinedFaces::new(tree, &self.ranks, finer, hosts);
        let found = |faces: &[(u32, u32)]| {
            let (mut found, mut search) = (Vec::new(), PieceSearch::default());
            for (rank, face) in faces {
                cut.search_face(*rank, *face, uncut_face, &mut search, |piece, others| {
                    pairs_of(finer, piece, others, &tolerance, &mut found);
                });
            }
            found
        };
        pairs.par_extend(cut.faces.par_chunks(FACES_PER_TASK).with_max_len(8).flat_map_iter(found));
        pairs.par_sort_unstable_by_key(|pair| pair.faces);
        join(&pairs)
    }
}

/// The cut faces, and a tree with boxes around their pieces.
struct RefinedFaces<'a> {
    finer: &'a IntersectionInput<'a>,
    tree: BoxTree,
    kept_count: usize,
    /// Rank and id of each cut face, by rank.
    faces: Vec<(u32, u32)>,
    /// Pieces by the rank of their face.
    pieces: CsrLists<u32>,
    /// Box of each piece.
    boxes: Vec<Box3>,
    ranks: &'a [u32],
}

/// Buffers of one task.
#[derive(Default)]
struct PieceSearch {
    stack: Vec<(usize, usize)>,
    /// Faces near a cut face, followed by its own pieces.
    near: Vec<NearbyFace>,
    /// Faces that may pass through one of the pieces.
    others: Vec<u32>,
}

/// Face of the finer mesh near a cut face, with its vertices and box.
#[derive(Clone, Copy)]
struct NearbyFace {
    own_box: Box3,
    face: u32,
    vertices: [u32; 3],
}

impl<'a> RefinedFaces<'a> {
    fn new(tree: &BoxTree, ranks: &'a [u32], finer: &'a IntersectionInput<'a>, hosts: FaceHosts) -> Self {
        let first_piece = hosts.kept_count;
        let corners = |triangle: &[u32; 3]| triangle.map(|v| finer.positions[v as usize]);
        let boxes: Vec<Box3> = finer.triangles[first_piece..]
            .par_iter()
            .with_min_len(1 << 10)
            .map(|triangle| tree.box_of(corners(triangle)))
            .collect();
        let is_active_piece = |piece: &usize| finer.active.get(*piece).is_none_or(|active| *active);
        let by_rank = |piece: usize| (ranks[hosts.faces[piece] as usize] as usize, piece as u32);
        let active_pieces = (first_piece..finer.triangles.len()).filter(is_active_piece);
        let pieces = csr_lists_from_pairs(ranks.len(), active_pieces.map(by_rank));
        let around = |rank: usize| {
            let piece_boxes = pieces.of(rank).iter().map(|piece| boxes[*piece as usize - first_piece]);
            Some((rank as u32, piece_boxes.reduce(Box3::union)?))
        };
        let changed: Vec<(u32, Box3)> = (0..pieces.count()).filter_map(around).collect();
        let host = |rank: u32| hosts.faces[pieces.of(rank as usize)[0] as usize];
        let faces = changed.iter().map(|(rank, _)| (*rank, host(*rank))).collect();
        Self { finer, tree: tree.with_boxes(&changed), kept_count: first_piece, faces, pieces, boxes, ranks }
    }

    /// Calls `visit` for each piece of a cut face with the faces that may pass through it. A pair of cut
    /// faces is found once, from the face with the lower rank.
    fn search_face(
        &self,
        rank: u32,
        face: u32,
        uncut_face: impl Fn(u32) -> Option<u32>,
        search: &mut PieceSearch,
        mut visit: impl FnMut(u32, &[u32]),
    ) {
        let PieceSearch { stack, near, others } = search;
        let piece = |face: u32| {
            let own_box = self.boxes[face as usize - self.kept_count];
            NearbyFace { own_box, face, vertices: self.finer.triangles[face as usize] }
        };
        let pieces = self.pieces.of(rank as usize);
        let boxes = pieces.iter().map(|piece_index| self.boxes[*piece_index as usize - self.kept_count]);
        let Some(around) = boxes.reduce(Box3::union) else { return };
        near.clear();
        self.tree.near(&around, stack, |nearby| {
            if nearby == face {
                return;
            }
            let other_rank = self.ranks[nearby as usize];
            let of_other = self.pieces.of(other_rank as usize);
            if !of_other.is_empty() {
                if other_rank > rank {
                    near.extend(of_other.iter().map(|face| piece(*face)));
                }
            } else if let Some(face) = uncut_face(nearby) {
                let vertices = self.finer.triangles[face as usize];
                let corners = vertices.map(|v| self.finer.positions[v as usize]);
                near.push(NearbyFace { own_box: self.tree.box_of(corners), face, vertices });
            }
        });
        near.retain(|candidate| around.overlaps(&candidate.own_box));
        let all = TreeFaces { triangles: self.finer.triangles, bodies: self.finer.bodies };
        let first = near.len();
        near.extend(pieces.iter().map(|face| piece(*face)));
        for k in first..near.len() {
            let current = near[k];
            let are_neighbours = |neighbour: &NearbyFace| {
                share_a_vertex(current.vertices, neighbour.vertices)
                    && all.are_joined(current.face, neighbour.face)
            };
            let meets = |other_piece: &&NearbyFace| {
                current.own_box.overlaps(&other_piece.own_box) && !are_neighbours(other_piece)
            };
            others.clear();
            others.extend(
                near[..first].iter().chain(&near[k + 1..]).filter(meets).map(|met_face| met_face.face),
            );
            if !others.is_empty() {
                visit(current.face, others);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};

    /// One triangle around each point of `middles`, without common vertices.
    fn random_triangles_around(seed: u64, middles: &[DVec3]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let number = |k: usize| unit_interval(hash(seed, &[k as u64])) - 0.5;
        let corner = |(k, middle): (usize, &DVec3)| {
            [0, 3, 6].map(|c| {
                *middle + DVec3::new(number(9 * k + c), number(9 * k + c + 1), number(9 * k + c + 2))
            })
        };
        let positions: Vec<DVec3> = middles.iter().enumerate().flat_map(corner).collect();
        let triangles = (0..middles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        (positions, triangles)
    }

    #[test]
    fn refined_curves_match_a_full_intersection_search() {
        let (mut among_own, mut among_cut, mut with_whole) = (0, 0, 0);
        for seed in 0..20 {
            // A row of triangles that each meet the next few. Two of three are cut into two to four pieces.
            let middles: Vec<DVec3> = (0..40).map(|k| DVec3::X * 0.3 * f64::from(k)).collect();
            let (positions, triangles_before) = random_triangles_around(seed, &middles);
            let before = IntersectionInput {
                positions: &positions,
                triangles: &triangles_before,
                active: &[],
                bodies: &[],
            };
            let search = IntersectionCache::new(&before, |_| PairTolerance::of_exact(1.0));

            let is_whole = |face: &u32| (*face as u64 + seed).is_multiple_of(3);
            let mut hosts: Vec<u32> = (0..40).filter(is_whole).collect();
            let kept = hosts.len();
            let pieces = |face: u32| std::iter::repeat_n(face, 2 + face as usize % 3);
            hosts.extend((0..40).filter(|face| !is_whole(face)).flat_map(pieces));
            let middles: Vec<DVec3> = hosts[kept..].iter().map(|host| middles[*host as usize]).collect();
            let (more, of_pieces) = random_triangles_around(seed + 100, &middles);
            let first = positions.len() as u32;
            let positions: Vec<DVec3> = positions.iter().copied().chain(more).collect();
            let whole = hosts[..kept].iter().map(|host| triangles_before[*host as usize]);
            let after: Vec<[u32; 3]> = whole.chain(of_pieces.iter().map(|t| t.map(|v| v + first))).collect();
            let finer =
                IntersectionInput { positions: &positions, triangles: &after, active: &[], bodies: &[] };

            let curves = search.refined_curves(&finer, FaceHosts { faces: &hosts, kept_count: kept }, |_| {
                PairTolerance::of_exact(1.0)
            });
            assert_eq!(curves, intersections_of_parts(&finer, |_| PairTolerance::of_exact(1.0)), "{seed}");
            for segment in &curves.segments {
                let [a, b] = segment.faces.map(|face| face as usize);
                if a >= kept {
                    let same = hosts[a] == hosts[b];
                    among_own += usize::from(same);
                    among_cut += usize::from(!same);
                } else {
                    with_whole += usize::from(b >= kept);
                }
            }
        }
        assert!(among_own > 20 && among_cut > 20 && with_whole > 20, "{among_own} {among_cut} {with_whole}");
    }
}
