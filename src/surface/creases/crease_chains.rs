//! [`CreaseCandidates`]: crease candidates, and the chains that they form end to end.
//!
//! 1. Edges that turn by more than the low threshold are candidates.
//! 2. At each vertex, candidates are paired by straightness and similar turn, best pair first. A ridge is
//!    never paired with a valley.
//! 3. Paired candidates form chains, which run straight through junctions.
//!
//! Source: Hubeli and Gross, "Multiresolution feature extraction from unstructured meshes", IEEE
//! Visualization 2001: edges are weighted, thinned and joined to lines by hysteresis.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::Dihedral;
use crate::mesh::normals::dihedral::turn_degrees;
use crate::mesh::{DihedralCosines, FaceId, Mesh};
use crate::parallel::concatenation::concatenate;

/// Minimum cosine of the bend between two candidates at a vertex without others. At 80 degrees the zigzag of
/// a regular triangulation is one chain.
const MIN_CHAIN_COSINE: f64 = 0.17;

/// Minimum cosine of the bend between two candidates at a vertex with more than two: 53 degrees.
const MIN_JUNCTION_COSINE: f64 = 0.6;

/// Maximum number of candidates at a vertex through which a chain may run.
const MAX_JUNCTION_EDGES: usize = 24;

/// Candidates that turn by more than this many degrees are neither ridge nor valley: the surface almost folds
/// onto itself.
const MAX_SIGNED_TURN_DEG: f32 = 170.0;

/// Edge where the surface turns by more than the low threshold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CreaseCandidate {
    /// Edge id.
    pub edge: u32,
    /// Turn of the surface, degrees.
    pub turn: f32,
}

/// All candidates of a mesh, indexed by vertex.
pub(crate) struct CreaseCandidates<'a> {
    mesh: &'a Mesh,
    /// In edge order.
    pub folds: Vec<CreaseCandidate>,
    /// Candidate ends at each vertex: candidate index shifted left by one; bit 0 selects which of its
    /// vertices.
    ends: CsrLists<u32>,
}

/// Candidates joined end to end.
pub(crate) struct CreaseChain {
    /// In order along the chain.
    pub folds: Vec<CreaseCandidate>,
    /// Mean cosine of the bends, above 0 and at most 1.
    pub straightness: f64,
    /// Whether the last candidate continues into the first.
    pub closed: bool,
}

/// All edges where the surface turns by more than `low_deg` degrees, in edge order.
pub(crate) fn folds(mesh: &Mesh, turns: &DihedralCosines, low_deg: f64) -> Vec<CreaseCandidate> {
    weighted_folds(mesh, turns, low_deg, |_| 1.0)
}

/// All edges where the turn of the surface times `weight` (at most 1) is more than `low_deg` degrees, in edge
/// order. Their turns are the products.
pub(crate) fn weighted_folds(
    mesh: &Mesh,
    turns: &DihedralCosines,
    low_deg: f64,
    weight: impl Fn(usize) -> f32 + Sync,
) -> Vec<CreaseCandidate> {
    const CHUNK: usize = 1 << 12;
    let low_cosine = cos(low_deg.to_radians()) as f32;
    let fold = |edge: usize| {
        let cosine = turns.at(mesh, edge);
        if cosine.is_nan() || cosine >= low_cosine {
            return None;
        }
        let dihedral = turns.dihedral(mesh, edge);
        let turn = dihedral.map_or_else(|| turn_degrees(cosine), |dihedral| dihedral.sure_turn(mesh));
        let turn = turn * weight(edge);
        (turn > low_deg as f32).then_some(CreaseCandidate { edge: edge as u32, turn })
    };
    let chunks = mesh.edges.len().div_ceil(CHUNK);
    let found: Vec<Vec<CreaseCandidate>> = (0..chunks)
        .into_par_iter()
        .with_max_len(1)
        .map(|k| (k * CHUNK..((k + 1) * CHUNK).min(mesh.edges.len())).filter_map(fold).collect())
        .collect();
    concatenate(&found)
}

impl<'a> CreaseCandidates<'a> {
    /// Keeps the candidates that share a vertex with one that turns by at most `high_deg` degrees.
    /// [`Self::extensions`] needs no others, and most machined parts have few of them or none.
    pub(crate) fn near_weak_edges(mesh: &'a Mesh, mut folds: Vec<CreaseCandidate>, high_deg: f64) -> Self {
        let ends = |f: &CreaseCandidate| mesh.edges.vertices[f.edge as usize].map(|v| v as usize);
        let faint: Vec<&CreaseCandidate> = folds.iter().filter(|f| f.turn <= high_deg as f32).collect();
        if faint.is_empty() {
            return Self::new(mesh, Vec::new());
        }
        let mut is_near = vec![false; mesh.positions.len()];
        faint.into_iter().flat_map(ends).for_each(|v| is_near[v] = true);
        folds.retain(|f| ends(f).iter().any(|v| is_near[*v]));
        Self::new(mesh, folds)
    }

    /// Sorts candidate ends by vertex.
    pub(crate) fn new(mesh: &'a Mesh, folds: Vec<CreaseCandidate>) -> Self {
        let vertices = |f: &CreaseCandidate| mesh.edges.vertices[f.edge as usize];
        let of_fold = |(fold, id): (&CreaseCandidate, u32)| {
            let [a, b] = vertices(fold);
            [(a as usize, id << 1), (b as usize, id << 1 | 1)]
        };
        let ends = csr_lists_from_pairs(mesh.positions.len(), folds.iter().zip(0..).flat_map(of_fold));
        Self { mesh, folds, ends }
    }

    /// The maximal chains that contain a candidate of more than `high_deg` degrees.
    pub(crate) fn chains(&self, high_deg: f64) -> Vec<CreaseChain> {
        let links = self.links();
        let mut taken = vec![false; self.folds.len()];
        let mut chains = Vec::new();
        for seed in 0..self.folds.len() {
            if taken[seed] || self.folds[seed].turn <= high_deg as f32 {
                continue;
            }
            taken[seed] = true;
            let (mut ahead, mut cosines, closed) = walk(&links, (seed << 1 | 1) as u32, &mut taken);
            let mut chain = Vec::new();
            if !closed {
                let (behind, more, _) = walk(&links, (seed << 1) as u32, &mut taken);
                chain.extend(behind.into_iter().rev());
                cosines += more;
            }
            chain.push(seed);
            chain.append(&mut ahead);
            let bends = chain.len() - usize::from(!closed);
            chains.push(CreaseChain {
                straightness: if bends == 0 { 1.0 } else { cosines / bends as f64 },
                folds: chain.into_iter().map(|i| self.folds[i]).collect(),
                closed,
            });
        }
        chains
    }

    /// Edges that extend creases which would end inside the surface.
    ///
    /// Starts at ends of candidates of more than `high_deg` degrees where no other such candidate ends.
    /// Follows paired candidates to the first vertex where one ends. An end that reaches none is not
    /// extended.
    pub(crate) fn extensions(&self, high_deg: f64) -> Vec<usize> {
        let is_high = |end: &u32| self.folds[(end >> 1) as usize].turn > high_deg as f32;
        // Skips the candidate that leads to this end.
        let meets = |end: u32| {
            self.ends.of(self.vertex(end)).iter().any(|other| other >> 1 != end >> 1 && is_high(other))
        };
        let walked_from = |from: u32| -> Vec<usize> {
            let (mut walked, mut pairs, mut end) = (Vec::new(), Vec::new(), from);
            loop {
                pairs.clear();
                self.pair_up(self.vertex(end), &mut pairs);
                let Some(next) = pairs.iter().find_map(|pair| pair.other(end)) else { return Vec::new() };
                walked.push(self.folds[(next >> 1) as usize].edge as usize);
                end = next ^ 1;
                if meets(end) {
                    return walked;
                }
            }
        };
        let ends = (0..2 * self.folds.len() as u32).into_par_iter().with_min_len(1 << 10);
        ends.filter(|end| is_high(end) && !meets(*end)).flat_map_iter(walked_from).collect()
    }

    /// For each candidate end, the end that continues it and the cosine of the bend between them.
    fn links(&self) -> Vec<Option<(u32, f32)>> {
        const CHUNK: usize = 1 << 12;
        let vertices = self.ends.count();
        let found: Vec<Vec<EndPair>> = (0..vertices.div_ceil(CHUNK))
            .into_par_iter()
            .with_max_len(1)
            .map(|k| {
                let mut pairs = Vec::new();
                (k * CHUNK..((k + 1) * CHUNK).min(vertices)).for_each(|v| self.pair_up(v, &mut pairs));
                pairs
            })
            .collect();
        let mut links = vec![None; 2 * self.folds.len()];
        for EndPair { ends: [a, b], cosine, .. } in found.into_iter().flatten() {
            links[a as usize] = Some((b, cosine as f32));
            links[b as usize] = Some((a, cosine as f32));
        }
        links
    }

    /// Adds the pairs of ends at a vertex that continue each other.
    fn pair_up(&self, vertex: usize, pairs: &mut Vec<EndPair>) {
        let ends = self.ends.of(vertex);
        if !(2..=MAX_JUNCTION_EDGES).contains(&ends.len()) {
            return;
        }
        let least = if ends.len() == 2 { MIN_CHAIN_COSINE } else { MIN_JUNCTION_COSINE };
        let mut candidates = Vec::new();
        for (i, a) in ends.iter().enumerate() {
            for b in &ends[i + 1..] {
                candidates.extend(self.pair(*a, *b, least));
            }
        }
        // Greedy matching, best pair first. Ties are broken by position, so that the order of the file has no
        // effect.
        candidates.sort_by(|a, b| b.rank.total_cmp(&a.rank).then_with(|| a.place.total_cmp(&b.place)));
        let first = pairs.len();
        for pair in candidates {
            if pairs[first..].iter().all(|p| p.ends.iter().all(|end| !pair.ends.contains(end))) {
                pairs.push(pair);
            }
        }
    }

    /// Two ends at one vertex as a pair, if one continues the other.
    fn pair(&self, a: u32, b: u32, least: f64) -> Option<EndPair> {
        let cosine = -self.away(a).dot(self.away(b));
        if cosine < least || !self.same_bend(a, b) {
            return None;
        }
        let [s, t] = [a, b].map(|end| f64::from(self.folds[(end >> 1) as usize].turn));
        let middle = [a, b].map(|end| self.mesh.positions[self.vertex(end ^ 1)]);
        let place = (middle[0] + middle[1]).dot(DVec3::new(1.0, 0.618, 0.414));
        Some(EndPair { ends: [a, b], cosine, rank: cosine * s.min(t) / s.max(t), place })
    }

    fn vertex(&self, end: u32) -> usize {
        let fold = self.folds[(end >> 1) as usize];
        self.mesh.edges.vertices[fold.edge as usize][(end & 1) as usize] as usize
    }

    /// Unit direction of a candidate away from one of its vertices.
    fn away(&self, end: u32) -> DVec3 {
        let [near, far] = [end, end ^ 1].map(|end| self.mesh.positions[self.vertex(end)]);
        (far - near).normalize_or_zero()
    }

    /// Whether two candidates are both ridges or both valleys, seen from one side of the surface.
    fn same_bend(&self, a: u32, b: u32) -> bool {
        let [(a, outward_a), (b, outward_b)] = [a, b].map(|end| self.bend(end));
        a * b * outward_a.dot(outward_b) >= 0.0
    }

    /// Sign of the bend (negative for a ridge, positive for a valley, 0 if undecided), and a direction
    /// between the two face normals. The sign is as seen from the side of that direction.
    fn bend(&self, end: u32) -> (f64, DVec3) {
        let fold = self.folds[(end >> 1) as usize];
        let Some(dihedral) = Dihedral::at(self.mesh, fold.edge as usize) else { return (0.0, DVec3::ZERO) };
        if fold.turn > MAX_SIGNED_TURN_DEG {
            return (0.0, DVec3::ZERO);
        }
        let [a, b] = dihedral.normals(self.mesh);
        let near = self.mesh.positions[self.vertex(end)];
        let corners = self.mesh.corners(FaceId(dihedral.faces[1])).map(|p| p - near);
        (corners.iter().sum::<DVec3>().dot(a).signum(), a + b)
    }
}

/// Follows links from a candidate end. Returns the candidates on the way, the sum of the cosines of the bends
/// between them, and whether the chain closes.
fn walk(links: &[Option<(u32, f32)>], from: u32, taken: &mut [bool]) -> (Vec<usize>, f64, bool) {
    let (mut walked, mut cosines, mut end) = (Vec::new(), 0.0, from);
    while let Some((next, cosine)) = links[end as usize] {
        cosines += f64::from(cosine);
        let fold = (next >> 1) as usize;
        if taken[fold] {
            return (walked, cosines, true);
        }
        taken[fold] = true;
        walked.push(fold);
        end = next ^ 1;
    }
    (walked, cosines, false)
}

/// Two candidate ends at one vertex.
struct EndPair {
    ends: [u32; 2],
    /// Cosine of the bend between them.
    cosine: f64,
    /// Quality of the pair: straightness times similarity of the turns.
    rank: f64,
    /// Position key that breaks ties.
    place: f64,
}

impl EndPair {
    /// The end paired with `end`.
    fn other(&self, end: u32) -> Option<u32> {
        let [a, b] = self.ends;
        (a == end).then_some(b).or((b == end).then_some(a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;
    use crate::mesh::Soup;

    /// Sheet of squares with random heights, so that its edges turn by different angles.
    fn rough_sheet(seed: u64, height: f64) -> Mesh {
        const N: u32 = 40;
        let up = |k: u32| height * (hash(seed, &[u64::from(k)]) as f64 / u64::MAX as f64 - 0.5);
        let point = |k: u32| DVec3::new(f64::from(k % N), f64::from(k / N), up(k));
        let squares = (0..N * (N - 1)).filter(|k| k % N + 1 < N);
        let triangles = squares.flat_map(|a| [[a, a + 1, a + N + 1], [a, a + N + 1, a + N]]).collect();
        Mesh::build(Soup { positions: (0..N * N).map(point).collect(), triangles, ..Soup::default() })
    }

    #[test]
    fn crease_extensions_near_weak_edges_match_all_candidates() {
        let mut walked = 0;
        for (seed, height) in (0..60).zip([0.2, 0.5, 0.8, 1.2, 2.0].into_iter().cycle()) {
            let mesh = rough_sheet(seed, height);
            let turns = DihedralCosines::of(&mesh);
            let all = folds(&mesh, &turns, 20.0);
            let expected = CreaseCandidates::new(&mesh, all.clone()).extensions(40.0);
            assert_eq!(
                CreaseCandidates::near_weak_edges(&mesh, all, 40.0).extensions(40.0),
                expected,
                "{seed}"
            );
            walked += expected.len();
        }
        assert!(walked > 100, "{walked}");
    }
}
