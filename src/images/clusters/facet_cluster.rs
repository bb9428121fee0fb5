//! [`FacetCluster`]: adjacent facets that share one affine map or one colour.

use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

use super::affine_fit::{AffineFit, AffineSums};
use crate::colour::srgb::Colour;
use crate::images::facets::facet::{Facet, FacetCorner};
use crate::mesh::PartId;

/// Adjacent facets that share one affine map or one colour.
#[derive(Debug, Clone)]
pub(crate) struct FacetCluster {
    /// Indices of its facets.
    pub facets: Vec<u32>,
    pub shows: ClusterPaint,
    pub part: PartId,
}

impl FacetCluster {
    /// Area on the page.
    pub(crate) fn area(&self, facets: &[Facet]) -> f64 {
        self.facets.iter().map(|facet| facets[*facet as usize].area2().abs() / 2.0).sum()
    }
}

/// Contents of a cluster.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ClusterPaint {
    /// The picture.
    Picture(AffineFit),
    /// One colour.
    Colour(Colour),
}

/// Error in texels that always counts as correct, however large the texels appear.
const MAX_ERROR_TEXELS: f64 = 0.02;

/// Largest number of corners of a cluster, which bounds the cost of checking all of them again.
const MAX_CORNERS: usize = 160;

/// Which of its neighbours a facet may be gathered with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum MergeRule {
    /// All, unless another face passes between them.
    All,
    /// Only those that the line of another face does not separate from it.
    Unparted,
    /// None.
    Alone,
}

/// Facets that share a side.
pub(crate) struct FacetNeighbours {
    /// Facets across the three sides of each facet; [`NO_FACET`] where there are none.
    across: Vec<[u32; 3]>,
    /// Number of each corner; equal for corners at the same image-space point.
    pub corners: Vec<[u32; 3]>,
}

/// Stands for the absence of a facet.
const NO_FACET: u32 = u32::MAX;

impl FacetNeighbours {
    /// Two facets of one part are neighbours if they share two corners and no other face passes between them.
    pub(crate) fn of(facets: &[Facet]) -> Self {
        let mut points: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        let mut point = |p: DVec3| {
            let next = points.len() as u32;
            *points.entry(p.to_array().map(f64::to_bits)).or_insert(next)
        };
        let corners: Vec<[u32; 3]> =
            facets.iter().map(|facet| facet.corners.map(|corner| point(corner.image))).collect();
        let mut across = vec![[NO_FACET; 3]; facets.len()];
        let mut open: FxHashMap<(PartId, [u32; 2]), (u32, usize)> = FxHashMap::default();
        for (number, corner_ids) in corners.iter().enumerate() {
            for side in (0..3).filter(|side| !facets[number].is_wall(*side)) {
                let mut ends = [corner_ids[side], corner_ids[(side + 1) % 3]];
                ends.sort_unstable();
                let key = (facets[number].part, ends);
                match open.remove(&key) {
                    Some((neighbour, neighbour_side)) => {
                        across[number][side] = neighbour;
                        across[neighbour as usize][neighbour_side] = number as u32;
                    }
                    None => {
                        open.insert(key, (number as u32, side));
                    }
                }
            }
        }
        Self { across, corners }
    }

    /// The facet across a side.
    pub(crate) fn beyond(&self, facet: u32, side: usize) -> Option<u32> {
        Some(self.across[facet as usize][side]).filter(|neighbour| *neighbour != NO_FACET)
    }

    /// Neighbours that a facet may be gathered with.
    fn company<'a>(
        &'a self,
        facet: u32,
        facets: &'a [Facet],
        merge_rules: &'a [MergeRule],
    ) -> impl Iterator<Item = u32> + 'a {
        let rule = merge_rules[facet as usize];
        (0..3).filter_map(move |side| {
            let neighbour = self.beyond(facet, side)?;
            match rule.max(merge_rules[neighbour as usize]) {
                MergeRule::All => Some(neighbour),
                MergeRule::Unparted => Some(neighbour).filter(|_| !facets[facet as usize].is_parted(side)),
                MergeRule::Alone => None,
            }
        })
    }
}

/// Requirements on a cluster.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClusterFit {
    /// Largest displacement of the picture on the page, user units.
    pub tolerance: f64,
    /// Largest extent of its places in x and y, texels.
    pub spans: [Option<f64>; 2],
    /// Distance outside its facets where the map must still be correct, user units.
    pub reach: f64,
    /// Whether the view is in perspective.
    pub perspective: bool,
}

/// Gathers facets into clusters, starting from the largest facets, with the neighbours that each of them may
/// have.
pub(crate) fn clusters(
    facets: &[Facet],
    neighbours: &FacetNeighbours,
    merge_rules: &[MergeRule],
    fit: &ClusterFit,
) -> Vec<FacetCluster> {
    let neighbours_of = |facet: u32| neighbours.company(facet, facets, merge_rules);
    let mut is_assigned = vec![false; facets.len()];
    let mut found = Vec::new();
    let mut seeds: Vec<u32> = (0..facets.len() as u32).collect();
    seeds.sort_by(|a, b| {
        let area = |facet: &u32| facets[*facet as usize].area2().abs();
        area(b).total_cmp(&area(a)).then(a.cmp(b))
    });
    for seed in seeds {
        if is_assigned[seed as usize] {
            continue;
        }
        let facet = &facets[seed as usize];
        let cluster = match facet.colour {
            Some(colour) => of_colour(facets, neighbours_of, seed, colour, &mut is_assigned),
            None => of_picture(facets, (neighbours, &neighbours_of), seed, fit, &mut is_assigned),
        };
        found.extend(cluster);
    }
    found
}

/// Cluster of one colour around a facet.
fn of_colour<I: Iterator<Item = u32>>(
    facets: &[Facet],
    neighbours_of: impl Fn(u32) -> I,
    seed: u32,
    colour: Colour,
    is_assigned: &mut [bool],
) -> Option<FacetCluster> {
    let turn = facets[seed as usize].area2() > 0.0;
    let part = facets[seed as usize].part;
    is_assigned[seed as usize] = true;
    let mut members = vec![seed];
    let mut next = 0;
    while let Some(facet) = members.get(next).copied().filter(|_| members.len() < MAX_COLOUR_FACETS) {
        next += 1;
        for neighbour in neighbours_of(facet) {
            let neighbour_facet = &facets[neighbour as usize];
            let fits = neighbour_facet.colour == Some(colour) && (neighbour_facet.area2() > 0.0) == turn;
            if fits && !std::mem::replace(&mut is_assigned[neighbour as usize], true) {
                members.push(neighbour);
            }
        }
    }
    Some(FacetCluster { facets: members, shows: ClusterPaint::Colour(colour), part })
}

/// Largest number of facets in a cluster of one colour, so that clusters can be sorted by depth.
const MAX_COLOUR_FACETS: usize = 2000;

/// Cluster of one affine map around a facet; `None` if it cannot be seen.
fn of_picture<I: Iterator<Item = u32>>(
    facets: &[Facet],
    (neighbours, neighbours_of): (&FacetNeighbours, &impl Fn(u32) -> I),
    seed: u32,
    fit: &ClusterFit,
    is_assigned: &mut [bool],
) -> Option<FacetCluster> {
    is_assigned[seed as usize] = true;
    let first = &facets[seed as usize];
    let turn = first.area2() > 0.0;
    let mut grown = ClusterGrowth::new(first, neighbours.corners[seed as usize], fit);
    let mut map = grown.sums.solved()?;
    let mut members = vec![seed];
    let mut tried: FxHashSet<u32> = FxHashSet::default();
    let mut next = 0;
    while let Some(facet) = members.get(next).copied() {
        next += 1;
        for candidate in neighbours_of(facet) {
            let candidate_facet = &facets[candidate as usize];
            let fits = !is_assigned[candidate as usize]
                && candidate_facet.colour.is_none()
                && (candidate_facet.area2() > 0.0) == turn;
            if !fits || grown.corners.len() >= MAX_CORNERS || !tried.insert(candidate) {
                continue;
            }
            let numbers = neighbours.corners[candidate as usize];
            if let Some((wider, found)) = grown.with(candidate_facet, numbers, fit) {
                (grown, map) = (wider, found);
                is_assigned[candidate as usize] = true;
                members.push(candidate);
            }
        }
    }
    Some(FacetCluster { facets: members, shows: ClusterPaint::Picture(map), part: first.part })
}

/// Corners of a growing cluster.
#[derive(Clone)]
struct ClusterGrowth {
    sums: AffineSums,
    corners: Vec<(u32, FacetCorner)>,
    low: DVec2,
    high: DVec2,
}

impl ClusterGrowth {
    fn new(facet: &Facet, numbers: [u32; 3], fit: &ClusterFit) -> Self {
        let mut sums = AffineSums::about(&facet.corners[0]);
        let around = facet.around(fit.reach, fit.perspective);
        facet.corners.iter().chain(around.iter().flatten()).for_each(|corner| sums.add(corner));
        let [low, high] = facet.places();
        Self { sums, corners: numbers.into_iter().zip(facet.corners).collect(), low, high }
    }

    /// Cluster with one more facet. `None` if common corners show different places, or if no map is correct
    /// for all corners.
    fn with(&self, facet: &Facet, numbers: [u32; 3], fit: &ClusterFit) -> Option<(Self, AffineFit)> {
        let mut wider = self.clone();
        for (number, corner) in numbers.into_iter().zip(facet.corners) {
            match self.corners.iter().find(|(known, _)| *known == number) {
                Some((_, known)) if known.place == corner.place => {}
                Some(_) => return None,
                None => {
                    wider.sums.add(&corner);
                    wider.corners.push((number, corner));
                    wider.low = wider.low.min(corner.place);
                    wider.high = wider.high.max(corner.place);
                }
            }
        }
        let around = facet.around(fit.reach, fit.perspective);
        around.iter().flatten().for_each(|corner| wider.sums.add(corner));
        let wide = (wider.high - wider.low).to_array();
        if wide
            .into_iter()
            .zip(fit.spans)
            .any(|(wide, span)| span.is_some_and(|span| wide > span * 1.000_001))
        {
            return None;
        }
        let map = wider.sums.solved()?;
        let is_right = |(_, corner): &(u32, FacetCorner)| {
            let (page, texels) = map.error(corner);
            page <= fit.tolerance || texels <= MAX_ERROR_TEXELS
        };
        wider.corners.iter().all(is_right).then_some((wider, map))
    }
}
