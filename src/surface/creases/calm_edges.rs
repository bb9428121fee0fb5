//! [`calm_edges`]: single sharp edges in calm places.
//!
//! A chain of one or two edges is too short to stand out from noise by its length. It is a crease by its angle
//! alone if the surface around it hardly turns, and if it leads from one line to another: an edge that ends
//! inside a surface is a fault of the mesh, such as a dent of a scan.

use super::crease_chains::{CreaseCandidate, CreaseChain};
use super::edge_noise::EdgeNoise;
use crate::mesh::{DihedralCosines, EdgeFaces, EdgeSet, Mesh};
use crate::parallel::prelude::*;

/// Maximum median turn of the edges next to a calm edge, as a share of the turn of the calm edge.
const MAX_TURN_BESIDE: f64 = 0.2;

/// The edges of `sharp` where the surface next to them hardly turns, and which lead to `creases`, borders or
/// each other at both ends.
pub(crate) fn calm_edges(
    mesh: &Mesh,
    turns: &DihedralCosines,
    crease_deg: f64,
    sharp: &[CreaseCandidate],
    creases: &EdgeSet,
) -> Vec<usize> {
    let noise = EdgeNoise::new(mesh, turns, crease_deg);
    let is_calm = |fold: &&CreaseCandidate| {
        let alone = CreaseChain { folds: vec![**fold], straightness: 1.0, closed: false };
        noise.around(&alone).median <= MAX_TURN_BESIDE * f64::from(fold.turn)
    };
    let calm = sharp.par_iter().with_max_len(64).filter(is_calm).map(|fold| fold.edge as usize).collect();
    without_loose_ends(mesh, calm, creases)
}

/// Removes edges that end at a vertex where no other line does, until each of them leads on.
fn without_loose_ends(mesh: &Mesh, mut calm: Vec<usize>, creases: &EdgeSet) -> Vec<usize> {
    if calm.is_empty() {
        return calm;
    }
    let is_line = |edge: &usize| {
        creases.contains(*edge) || !matches!(mesh.edges.faces(*edge), EdgeFaces::Two { same_way: false, .. })
    };
    // Lines that end at each vertex.
    let mut lines = vec![0_u32; mesh.positions.len()];
    let ends = |edge: usize| mesh.edges.vertices[edge].map(|vertex| vertex as usize);
    let all = (0..mesh.edges.len()).filter(is_line).chain(calm.iter().copied());
    all.flat_map(ends).for_each(|vertex| lines[vertex] += 1);
    loop {
        let (kept, loose): (Vec<usize>, Vec<usize>) =
            calm.into_iter().partition(|edge| ends(*edge).iter().all(|vertex| lines[*vertex] > 1));
        if loose.is_empty() {
            return kept;
        }
        loose.into_iter().flat_map(ends).for_each(|vertex| lines[vertex] -= 1);
        calm = kept;
    }
}
