//! [`HardEdges`]: the edges of a mesh where its surface is meant to be creased.
//!
//! Source: Canny, "A computational approach to edge detection", IEEE PAMI 8(6), 1986, section on
//! thresholding with hysteresis: a line is followed from where it is surely one into where it is
//! faint. Whether it is one at all is told by the noise around it.

use crate::parallel::prelude::*;

use super::crease_chains::{Chain, Fold, Folds, folds};
use super::edge_noise::Roughness;
use super::sliver_creases::wrinkles;
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::normals::dihedral::{Dihedral, is_unfolded_diagonal, mark};
use crate::mesh::{EdgeMark, Mesh, Turns};

/// The low threshold as a share of the high one: a crease goes on where it turns by more.
pub const LOW_OF_HIGH: f64 = 0.5;

/// A chain is a crease if n²·t/σ is as large as this (see `stands_out`): one right angle by itself
/// where the surface around is flat within a degree, five straight edges of 40 degrees on a
/// scan whose triangles turn by ten or so at random.
const EVIDENCE: f64 = 80.0;

/// A mean turn of this many deviations is clear of the noise.
const CLEAR: f64 = 4.0;

/// A chain that comes back to where it began counts as so many times as long.
const LOOP: f64 = 2.0;

/// An edge is tiny if this many times its length is less than the length of the edges around it.
const TINY: f64 = 2.0;

/// Turns beyond this many degrees say no more than this one: folded slivers of scans turn by 180.
const FULL_TURN_DEG: f64 = 90.0;

/// Edges where the surface is creased: one flag for each edge of a mesh.
///
/// Only edges where two faces meet can be hard; the surface ends at borders, and where three faces
/// meet, in any case.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct HardEdges {
    /// One bit an edge, or empty if none is hard.
    bits: Vec<u64>,
    count: usize,
}

impl HardEdges {
    /// Creases as chains: those that hold an edge whose faces turn by more than `crease_deg`
    /// degrees, go on where they turn by more than half of it ([`LOW_OF_HIGH`]), and stand out
    /// from the noise around them. Where the surface around is flat, one edge is enough; the
    /// rougher it is, the longer and straighter a crease must be.
    ///
    /// What the file says of an edge goes before all this.
    #[must_use]
    pub fn find(mesh: &Mesh, crease_deg: f64) -> Self {
        Self::find_with(mesh, &Turns::of(mesh), crease_deg, |_| true)
    }

    /// The same among those edges with two faces for whose first face `is_asked` holds: what they belong to is asked as a whole.
    pub(crate) fn find_with(
        mesh: &Mesh,
        turns: &Turns,
        crease_deg: f64,
        is_asked: impl Fn(u32) -> bool,
    ) -> Self {
        let mut folds = folds(mesh, turns, LOW_OF_HIGH * crease_deg);
        folds.retain(|fold| is_asked(mesh.edges.faces(fold.edge as usize).list()[0]));
        let folds = Folds::new(mesh, folds);
        let chains = folds.chains(crease_deg);
        let roughness = Roughness::new(mesh, turns, crease_deg);
        let kept: Vec<&Chain> = chains
            .par_iter()
            .with_max_len(8)
            .filter(|c| stands_out(mesh, c, crease_deg, &roughness))
            .collect();
        let edges = kept.iter().flat_map(|c| c.folds.iter().map(|f| f.edge as usize));
        Self::of_edges(mesh, edges).with_marks(mesh)
    }

    /// Every edge whose faces turn by more than `crease_deg` degrees, and those that the file
    /// marks.
    #[must_use]
    pub fn above(mesh: &Mesh, crease_deg: f64) -> Self {
        Self::above_with(mesh, &Turns::of(mesh), crease_deg)
    }

    pub(crate) fn above_with(mesh: &Mesh, turns: &Turns, crease_deg: f64) -> Self {
        Self::of_edges(mesh, folds(mesh, turns, crease_deg).iter().map(|f| f.edge as usize)).with_marks(mesh)
    }

    /// Every edge whose faces turn by more than `crease_deg` degrees, those that the file marks, and of those edges
    /// of which `goes_on` says so the ones on which a crease goes on to the next line while it turns by more
    /// than `low_deg` degrees; and the sharp ones among the latter that are none, since they are wrinkles alone.
    pub(crate) fn above_and_on(
        mesh: &Mesh,
        turns: &Turns,
        [crease_deg, low_deg]: [f64; 2],
        goes_on: impl Fn(usize) -> bool + Sync,
    ) -> (Self, EdgeSet) {
        let folds = folds(mesh, turns, low_deg);
        let cosine = cos(crease_deg.to_radians()) as f32;
        // As sharp as `above` has it, by cosine and angle.
        let is_above = |f: &Fold| f.turn > crease_deg as f32 && turns.at(mesh, f.edge as usize) < cosine;
        let all = folds.par_iter().with_min_len(1 << 10);
        let mut edges: Vec<usize> = all.clone().filter(|f| is_above(f)).map(|f| f.edge as usize).collect();
        let folds = all.filter(|f| goes_on(f.edge as usize)).copied().collect();
        edges.extend(Folds::around_faint(mesh, folds, crease_deg).going_on(crease_deg));
        edges.par_sort_unstable();
        edges.dedup();
        let mut wrinkles = wrinkles(mesh, turns, crease_deg, &edges);
        wrinkles.retain(|edge| goes_on(*edge));
        edges.retain(|edge| wrinkles.binary_search(edge).is_err());
        let wrinkles = EdgeSet::default().with(&wrinkles, mesh.edges.len());
        (Self::of_edges(mesh, edges.into_iter()).with_marks(mesh), wrinkles)
    }

    /// No edge.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// These hard edges in a mesh with `count` edges made of this one: `ids` tells which of them each edge of this one
    /// is, `u32::MAX` for none.
    #[must_use]
    pub fn carried(&self, ids: &[u32], count: usize) -> Self {
        if self.is_empty() {
            return Self::none();
        }
        let mut bits = vec![0u64; count.div_ceil(64)];
        let hard = self.bits.iter().enumerate().filter(|(_, word)| **word != 0);
        for edge in hard.flat_map(|(k, word)| {
            (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| 64 * k + bit)
        }) {
            if let Some(edge) = ids.get(edge).filter(|edge| **edge != u32::MAX) {
                bits[*edge as usize / 64] |= 1 << (edge % 64);
            }
        }
        Self { count: self::count(&bits), bits }
    }

    /// Those edges of a mesh of which it is said that they are hard.
    #[must_use]
    pub fn of(mesh: &Mesh, is_hard: impl Fn(usize) -> bool + Sync) -> Self {
        let bits = EdgeSet::collect(mesh.edges.len(), is_hard).into_words();
        Self { count: count(&bits), bits }
    }

    /// These and more edges of a mesh.
    #[must_use]
    pub fn with(mut self, mesh: &Mesh, more: &[usize]) -> Self {
        if more.is_empty() {
            return self;
        }
        self.bits.resize(mesh.edges.len().div_ceil(64), 0);
        more.iter().for_each(|edge| self.bits[edge / 64] |= 1 << (edge % 64));
        self.count = count(&self.bits);
        self
    }

    fn of_edges(mesh: &Mesh, edges: impl Iterator<Item = usize>) -> Self {
        let mut bits = vec![0u64; mesh.edges.len().div_ceil(64)];
        edges.for_each(|e| bits[e / 64] |= 1 << (e % 64));
        Self { count: count(&bits), bits }
    }

    fn with_marks(mut self, mesh: &Mesh) -> Self {
        if mesh.edge_marks.is_empty() {
            return self;
        }
        // Most files have none of those that make creases: then only sharp edges are looked at.
        let makes = |mark: &EdgeMark| matches!(mark, EdgeMark::Hard | EdgeMark::Cut);
        let makes_creases = mesh.edge_marks.par_iter().any(|marks| marks.iter().any(makes));
        for edge in 0..mesh.edges.len() {
            if !makes_creases && !self.is_hard(edge) {
                continue;
            }
            let Some(dihedral) = Dihedral::at(mesh, edge) else { continue };
            let bit = 1 << (edge % 64);
            let mark = mark(mesh, edge, dihedral.faces);
            match mark {
                EdgeMark::Unmarked => {}
                EdgeMark::Hard | EdgeMark::Cut => self.bits[edge / 64] |= bit,
                EdgeMark::Hidden | EdgeMark::Contour | EdgeMark::Covered => self.bits[edge / 64] &= !bit,
                EdgeMark::Diagonal => {
                    if is_unfolded_diagonal(mark, dihedral.turn()) {
                        self.bits[edge / 64] &= !bit;
                    }
                }
            }
        }
        self.count = count(&self.bits);
        self
    }

    /// Whether the surface is creased at an edge of the mesh.
    #[inline]
    #[must_use]
    pub fn is_hard(&self, edge: usize) -> bool {
        self.bits.get(edge / 64).is_some_and(|word| word >> (edge % 64) & 1 == 1)
    }

    /// Number of hard edges.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

fn count(bits: &[u64]) -> usize {
    bits.iter().map(|word| word.count_ones() as usize).sum()
}

/// Whether a chain is a feature and not noise: n²·t/σ is large, where n is its length in edges, σ
/// the spread of the turns around it, and t its mean turn, stretched so that the low threshold
/// counts nothing and the high one itself.
///
/// The mean of n turns of noise spreads by σ/√n only, and noise does not go straight on: most lines
/// of it end after two or three edges. Hence length counts for more than sharpness, unless the mean
/// turn is within a few deviations: such lines noise makes too, and they count for less.
fn stands_out(mesh: &Mesh, chain: &Chain, crease_deg: f64, roughness: &Roughness) -> bool {
    let around = roughness.around(chain);
    let n = chain.folds.len() as f64;
    let most = FULL_TURN_DEG.max(crease_deg);
    let mean = chain.folds.iter().map(|f| f64::from(f.turn).min(most)).sum::<f64>() / n;
    let turn = (mean - LOW_OF_HIGH * crease_deg).max(0.0) / (1.0 - LOW_OF_HIGH);
    let ends = chain.folds.iter().map(|f| mesh.edges.vertices[f.edge as usize]);
    let length: f64 =
        ends.map(|[a, b]| mesh.positions[a as usize].distance(mesh.positions[b as usize])).sum();
    // Many tiny edges are no more than one that is as long.
    let edges = (TINY * length / around.edge_length.max(f64::MIN_POSITIVE)).clamp(1.0, n);
    let straight = edges * chain.straightness * if chain.closed { LOOP } else { 1.0 };
    let clear = (turn / (CLEAR * around.deviation).max(f64::MIN_POSITIVE)).min(1.0);
    straight * straight * turn * clear * clear >= EVIDENCE * around.deviation
}
