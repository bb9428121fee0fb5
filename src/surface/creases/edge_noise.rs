//! [`EdgeNoise`]: noise of the turns at the edges around a chain.
//!
//! The median of absolute turns estimates the spread of noise and is robust against a few feature edges
//! (Huber and Ronchetti, "Robust Statistics"). The lower quartile is a second estimate. Noise affects every
//! edge, so both agree there. A tessellated cylinder turns at two of three edges and is flat at its
//! diagonals, so its quartile is 0. The result is the geometric mean of both estimates.

use super::crease_chains::CreaseChain;
use crate::geometry::numbers::portable_math::{acos, cos};
use crate::mesh::Dihedral;
use crate::mesh::edges::triangle_sides::sides;
use crate::mesh::{DihedralCosines, Mesh, VertexEdges};

/// Standard deviation of a normal distribution, in medians of its absolute values.
const DEVIATIONS_PER_MEDIAN: f64 = 1.4826;

/// Standard deviation of a normal distribution, in lower quartiles of its absolute values.
const DEVIATIONS_PER_QUARTILE: f64 = 3.1383;

/// Maximum number of edges of a chain that are sampled. Longer chains are sampled evenly.
const MAX_CHAIN_SAMPLES: usize = 64;

/// Estimates the noise around chains of a mesh.
pub(crate) struct EdgeNoise<'a> {
    mesh: &'a Mesh,
    turns: &'a DihedralCosines,
    edges: VertexEdges<'a>,
    /// Edges that turn by more than the angle of this cosine are features, not noise.
    high_cosine: f32,
}

/// Noise and edge length around a chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NoiseEstimate {
    /// Standard deviation of the turns, degrees; 0 where the surface is flat.
    pub deviation: f64,
    /// Median turn, degrees.
    pub median: f64,
    /// Median length of the edges, world units.
    pub edge_length: f64,
}

impl<'a> EdgeNoise<'a> {
    pub(crate) fn new(mesh: &'a Mesh, turns: &'a DihedralCosines, high_deg: f64) -> Self {
        let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
        Self { mesh, turns, edges, high_cosine: cos(high_deg.to_radians()) as f32 }
    }

    /// Samples the edges of the faces next to a chain and of their neighbours. Edges of the chain and other
    /// sharp edges are left out of the noise estimate.
    pub(crate) fn around(&self, chain: &CreaseChain) -> NoiseEstimate {
        let mut own: Vec<u32> = chain.folds.iter().map(|f| f.edge).collect();
        own.sort_unstable();
        let (mut cosines, mut lengths) = (Vec::new(), Vec::new());
        let mut seen = |edge: usize, cosine: f32| {
            let [a, b] = self.mesh.ends(edge);
            lengths.push(a.distance_squared(b));
            if cosine >= self.high_cosine && own.binary_search(&(edge as u32)).is_err() {
                cosines.push(f64::from(-cosine));
            }
        };
        for fold in chain.folds.iter().step_by(chain.folds.len().div_ceil(MAX_CHAIN_SAMPLES)) {
            let Some(dihedral) = self.turns.dihedral(self.mesh, fold.edge as usize) else { continue };
            for face in dihedral.faces {
                for (edge, beside) in self.sides(face, fold.edge as usize) {
                    seen(edge, beside.cosine);
                    let beyond = if beside.faces[0] == face { beside.faces[1] } else { beside.faces[0] };
                    self.sides(beyond, edge).for_each(|(edge, next)| seen(edge, next.cosine));
                }
            }
        }
        // Cosines are negated: a smaller cosine is a larger turn.
        let mut turn = |share| quantile(&mut cosines, share).map_or(0.0, |c| acos(-c).to_degrees());
        let (median, quartile) = (turn(2), turn(4));
        NoiseEstimate {
            deviation: (DEVIATIONS_PER_MEDIAN * median * DEVIATIONS_PER_QUARTILE * quartile).sqrt(),
            median,
            edge_length: quantile(&mut lengths, 2).map_or(0.0, f64::sqrt),
        }
    }

    /// The edges of a face, except one, where it meets another face.
    fn sides(&self, face: u32, except: usize) -> impl Iterator<Item = (usize, Dihedral)> + '_ {
        let sides = sides(self.mesh.triangles[face as usize]).into_iter();
        let edges = sides.filter_map(|[u, v]| self.edges.between(u, v));
        edges
            .filter(move |edge| *edge != except)
            .filter_map(|edge| Some((edge, self.turns.dihedral(self.mesh, edge)?)))
    }
}

/// The quantile 1/`share` of some numbers, rounded down to an element.
fn quantile(numbers: &mut [f64], share: usize) -> Option<f64> {
    let at = numbers.len().checked_sub(1)? / share;
    Some(*numbers.select_nth_unstable_by(at, f64::total_cmp).1)
}
