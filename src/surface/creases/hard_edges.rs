//! [`HardEdges`]: the edges where the surface of a mesh is creased.
//!
//! 1. Edges above a low threshold are joined to chains.
//! 2. Chains with an edge above the high threshold are candidates (hysteresis thresholding).
//! 3. A chain is a crease if it stands out from the noise of the surface around it.
//! 4. Edge marks of the file override the result.
//!
//! `find` follows all steps, for round components. `find_weighted` adds single edges in calm places, where
//! evidence decides. `above` takes every edge over the threshold.
//! `above_with_extensions` also continues such creases and drops slivers, for machined components.
//!
//! Source: Canny, "A computational approach to edge detection", IEEE PAMI 8(6), 1986, section on thresholding
//! with hysteresis.

use crate::parallel::prelude::*;

use super::calm_edges::calm_edges;
use super::crease_chains::{CreaseCandidate, CreaseCandidates, CreaseChain, folds, weighted_folds};
use super::edge_noise::EdgeNoise;
use super::sliver_creases::wrinkles;
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::Dihedral;
use crate::mesh::EdgeSet;
use crate::mesh::normals::dihedral::{is_unfolded_diagonal, mark};
use crate::mesh::{DihedralCosines, EdgeMark, Mesh};

/// Low threshold as a share of the high one: a crease continues where it turns by more than this.
pub(crate) const LOW_THRESHOLD_OF_HIGH: f64 = 0.5;

/// Minimum of n²·t/σ for a chain to be a crease (see `is_significant`). One right angle reaches it where the
/// surface around is flat within a degree. On a scan whose triangles turn by about ten degrees at random,
/// five straight edges of 40 degrees reach it.
const MIN_CHAIN_EVIDENCE: f64 = 80.0;

/// Mean turn, in standard deviations of the noise, that counts in full.
const MIN_TURN_DEVIATIONS: f64 = 4.0;

/// Factor on the length of a closed chain.
const CLOSED_CHAIN_FACTOR: f64 = 2.0;

/// Maximum number of edges that a chain counts for, per median edge length around it.
const TINY_EDGE_FACTOR: f64 = 2.0;

/// Turns are capped at this many degrees: folded slivers of scans turn by 180.
const MAX_COUNTED_TURN_DEG: f64 = 90.0;

/// Edges where the surface is creased: one flag per edge of a mesh.
///
/// Only edges with two faces can be hard. Borders and non-manifold edges always end a surface.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct HardEdges(EdgeSet);

impl HardEdges {
    /// Finds creases as chains.
    ///
    /// A chain is a crease if it has an edge that turns by more than `crease_deg` degrees and stands out from
    /// the noise around it. It continues where it turns by more than half of that ([`LOW_THRESHOLD_OF_HIGH`]). Where
    /// the surface around is flat, one edge is enough. On rougher surfaces a crease must be longer and
    /// straighter.
    ///
    /// Edge marks of the file take precedence.
    #[cfg(test)]
    #[must_use]
    pub(crate) fn find(mesh: &Mesh, crease_deg: f64) -> Self {
        Self::find_with(mesh, &DihedralCosines::of(mesh), crease_deg, |_| true)
    }

    /// Same as [`Self::find`], among the two-face edges whose first face satisfies `is_asked`.
    pub(crate) fn find_with(
        mesh: &Mesh,
        turns: &DihedralCosines,
        crease_deg: f64,
        is_asked: impl Fn(u32) -> bool,
    ) -> Self {
        let mut folds = folds(mesh, turns, LOW_THRESHOLD_OF_HIGH * crease_deg);
        folds.retain(|fold| is_asked(mesh.edges.faces(fold.edge as usize).list()[0]));
        let edges = significant_edges(mesh, turns, crease_deg, &CreaseCandidates::new(mesh, folds));
        Self::of_edges(mesh, &edges)
    }

    /// Edges of `known`, creases as chains, and single edges in calm places, with a weight of at most 1 for the
    /// turn of each edge.
    pub(crate) fn find_weighted(
        mesh: &Mesh,
        turns: &DihedralCosines,
        crease_deg: f64,
        (known, weight): (&EdgeSet, impl Fn(usize) -> f32 + Sync),
    ) -> Self {
        let folds = weighted_folds(mesh, turns, LOW_THRESHOLD_OF_HIGH * crease_deg, weight);
        let folds = CreaseCandidates::new(mesh, folds);
        let edges = significant_edges(mesh, turns, crease_deg, &folds);
        let found = known.clone().with(&edges, mesh.edges.len());
        let is_open = |f: &&CreaseCandidate| f.turn > crease_deg as f32 && !found.contains(f.edge as usize);
        let open: Vec<CreaseCandidate> = folds.folds.iter().filter(is_open).copied().collect();
        let calm = calm_edges(mesh, turns, crease_deg, &open, &found);
        Self(found.with(&calm, mesh.edges.len())).with_marks(mesh)
    }

    /// Every edge that turns by more than `crease_deg` degrees, and those that the file marks.
    #[cfg(test)]
    #[must_use]
    pub(crate) fn above(mesh: &Mesh, crease_deg: f64) -> Self {
        Self::above_with(mesh, &DihedralCosines::of(mesh), crease_deg)
    }

    pub(crate) fn above_with(mesh: &Mesh, turns: &DihedralCosines, crease_deg: f64) -> Self {
        let edges: Vec<usize> = folds(mesh, turns, crease_deg).iter().map(|f| f.edge as usize).collect();
        Self::of_edges(mesh, &edges)
    }

    /// Every edge that turns by more than `crease_deg` degrees, edges marked by the file, and extensions.
    ///
    /// Extensions continue a crease to the next line through edges that turn by more than `low_deg` degrees.
    /// They are sought only among edges that satisfy `goes_on`. The second result holds edges that are sharp
    /// only because of a sliver; they are no creases.
    pub(crate) fn above_with_extensions(
        mesh: &Mesh,
        turns: &DihedralCosines,
        [crease_deg, low_deg]: [f64; 2],
        goes_on: impl Fn(usize) -> bool + Sync,
    ) -> (Self, EdgeSet) {
        let folds = folds(mesh, turns, low_deg);
        let cosine = cos(crease_deg.to_radians()) as f32;
        // The same comparison as in `above`: by cosine and by angle.
        let is_above =
            |f: &CreaseCandidate| f.turn > crease_deg as f32 && turns.at(mesh, f.edge as usize) < cosine;
        let all = folds.par_iter().with_min_len(1 << 10);
        let mut edges: Vec<usize> = all.clone().filter(|f| is_above(f)).map(|f| f.edge as usize).collect();
        let folds = all.filter(|f| goes_on(f.edge as usize)).copied().collect();
        edges.extend(CreaseCandidates::near_weak_edges(mesh, folds, crease_deg).extensions(crease_deg));
        edges.par_sort_unstable();
        edges.dedup();
        let mut wrinkles = wrinkles(mesh, turns, crease_deg, &edges);
        wrinkles.retain(|edge| goes_on(*edge));
        edges.retain(|edge| wrinkles.binary_search(edge).is_err());
        let wrinkles = EdgeSet::default().with(&wrinkles, mesh.edges.len());
        (Self::of_edges(mesh, &edges), wrinkles)
    }

    /// The empty set.
    #[must_use]
    pub(crate) fn none() -> Self {
        Self::default()
    }

    /// These edges as edges of a finer mesh; see [`EdgeSet::refined`].
    #[must_use]
    pub(crate) fn refined(&self, edges: &[u32], pieces: &[(u32, usize)], count: usize) -> Self {
        Self(self.0.refined(edges, pieces, count))
    }

    /// The edges of a mesh that satisfy `is_hard`.
    #[must_use]
    pub(crate) fn of(mesh: &Mesh, is_hard: impl Fn(usize) -> bool + Sync) -> Self {
        Self(EdgeSet::collect(mesh.edges.len(), is_hard))
    }

    /// Parts the edges that only slivers cause (second result) from the others, among those that satisfy `may`.
    pub(crate) fn without_slivers(
        self,
        mesh: &Mesh,
        turns: &DihedralCosines,
        crease_deg: f64,
        may: impl Fn(usize) -> bool + Sync,
    ) -> (Self, EdgeSet) {
        let all: Vec<usize> = self.0.iter().collect();
        let mut wrinkles = wrinkles(mesh, turns, crease_deg, &all);
        wrinkles.retain(|edge| may(*edge));
        if wrinkles.is_empty() {
            return (self, EdgeSet::default());
        }
        let wrinkles = EdgeSet::default().with(&wrinkles, mesh.edges.len());
        (Self::of(mesh, |edge| self.is_hard(edge) && !wrinkles.contains(edge)), wrinkles)
    }

    /// Adds edges of the mesh.
    #[must_use]
    pub(crate) fn with(self, mesh: &Mesh, more: &[usize]) -> Self {
        Self(self.0.with(more, mesh.edges.len()))
    }

    fn of_edges(mesh: &Mesh, edges: &[usize]) -> Self {
        Self::none().with(mesh, edges).with_marks(mesh)
    }

    fn with_marks(self, mesh: &Mesh) -> Self {
        if mesh.edge_marks.is_empty() {
            return self;
        }
        // Few files have marks that create creases. Without them only edges that are already hard need a
        // check.
        let makes = |mark: &EdgeMark| matches!(mark, EdgeMark::Hard | EdgeMark::Cut);
        let makes_creases = mesh.edge_marks.par_iter().any(|marks| marks.iter().any(makes));
        Self::of(mesh, |edge| {
            let is_hard = self.is_hard(edge);
            if !makes_creases && !is_hard {
                return false;
            }
            let Some(dihedral) = Dihedral::at(mesh, edge) else { return is_hard };
            match mark(mesh, edge, dihedral.faces) {
                EdgeMark::Unmarked => is_hard,
                EdgeMark::Hard | EdgeMark::Cut => true,
                EdgeMark::Hidden | EdgeMark::Contour | EdgeMark::Covered => false,
                mark @ EdgeMark::Diagonal => is_hard && !is_unfolded_diagonal(mark, dihedral.turn()),
            }
        })
    }

    /// Whether the surface is creased at an edge of the mesh.
    #[inline]
    #[must_use]
    pub(crate) fn is_hard(&self, edge: usize) -> bool {
        self.0.contains(edge)
    }

    /// Number of hard edges.
    #[cfg(test)]
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.0.iter().count()
    }
}

/// The edges of the chains that stand out from the noise around them.
fn significant_edges(
    mesh: &Mesh,
    turns: &DihedralCosines,
    crease_deg: f64,
    folds: &CreaseCandidates,
) -> Vec<usize> {
    let chains = folds.chains(crease_deg);
    let roughness = EdgeNoise::new(mesh, turns, crease_deg);
    let kept: Vec<&CreaseChain> = chains
        .par_iter()
        .with_max_len(8)
        .filter(|c| is_significant(mesh, c, crease_deg, &roughness))
        .collect();
    kept.iter().flat_map(|c| c.folds.iter().map(|f| f.edge as usize)).collect()
}

/// Whether a chain is a feature rather than noise: n²·t/σ is at least [`MIN_CHAIN_EVIDENCE`].
///
/// n is the length in edges and σ the standard deviation of the turns around the chain. t is the mean turn,
/// stretched so that the low threshold counts as 0 and the high threshold as itself.
///
/// The mean of n noisy turns has a deviation of σ/√n only. Noise also does not run straight: most noisy
/// chains end after two or three edges. Length therefore counts more than sharpness. Chains whose mean turn
/// is within a few deviations of zero can be noise, so they count less.
fn is_significant(mesh: &Mesh, chain: &CreaseChain, crease_deg: f64, roughness: &EdgeNoise) -> bool {
    let around = roughness.around(chain);
    let n = chain.folds.len() as f64;
    let most = MAX_COUNTED_TURN_DEG.max(crease_deg);
    let mean = chain.folds.iter().map(|f| f64::from(f.turn).min(most)).sum::<f64>() / n;
    let turn = (mean - LOW_THRESHOLD_OF_HIGH * crease_deg).max(0.0) / (1.0 - LOW_THRESHOLD_OF_HIGH);
    let ends = chain.folds.iter().map(|f| mesh.edges.vertices[f.edge as usize]);
    let length: f64 =
        ends.map(|[a, b]| mesh.positions[a as usize].distance(mesh.positions[b as usize])).sum();
    // Many tiny edges count as one edge of their total length.
    let edges = (TINY_EDGE_FACTOR * length / around.edge_length.max(f64::MIN_POSITIVE)).clamp(1.0, n);
    let straight = edges * chain.straightness * if chain.closed { CLOSED_CHAIN_FACTOR } else { 1.0 };
    let clear = (turn / (MIN_TURN_DEVIATIONS * around.deviation).max(f64::MIN_POSITIVE)).min(1.0);
    straight * straight * turn * clear * clear >= MIN_CHAIN_EVIDENCE * around.deviation
}
