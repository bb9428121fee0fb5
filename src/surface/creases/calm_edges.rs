//! [`calm_edges`]: single sharp edges in calm places.
//!
//! A chain of one or two edges is too short to stand out from noise by its length. If the surface around it
//! hardly turns, there is no noise, and the edge is a crease by its angle alone.

use super::crease_chains::{CreaseCandidate, CreaseChain};
use super::edge_noise::EdgeNoise;
use crate::mesh::{DihedralCosines, Mesh};
use crate::parallel::prelude::*;

/// Maximum median turn of the edges next to a calm edge, as a share of the turn of the calm edge.
const MAX_TURN_BESIDE: f64 = 0.2;

/// The edges of `sharp` where the surface next to them hardly turns.
pub(crate) fn calm_edges(
    mesh: &Mesh,
    turns: &DihedralCosines,
    crease_deg: f64,
    sharp: &[CreaseCandidate],
) -> Vec<usize> {
    let noise = EdgeNoise::new(mesh, turns, crease_deg);
    let is_calm = |fold: &&CreaseCandidate| {
        let alone = CreaseChain { folds: vec![**fold], straightness: 1.0, closed: false };
        noise.around(&alone).median <= MAX_TURN_BESIDE * f64::from(fold.turn)
    };
    sharp.par_iter().with_max_len(64).filter(is_calm).map(|fold| fold.edge as usize).collect()
}
