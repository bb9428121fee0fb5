//! [`ClusterArrangement`]: facets gathered into clusters, in the order of painting.

use super::cluster_order::{ClusterOrder, back_to_front};
use super::facet_cluster::{ClusterFit, FacetCluster, FacetNeighbours, MergeRule, clusters};
use crate::images::facets::facet::Facet;
use crate::view::raster::PixelGrid;

/// Largest displacement of a picture on the page, px.
pub(crate) const TOLERANCE_PX: f64 = 0.3;

/// Largest number of pieces of a picture. If there are more, the tolerance is doubled, at most three times.
/// Then the smallest pieces are left out, and the mean colour shows there.
pub(crate) const MAX_PIECES: usize = 20_000;

/// Largest number of times the tolerance is doubled.
const MAX_DOUBLINGS: u32 = 3;

/// Largest number of rounds that split clusters. Clusters that still cover each other cyclically are painted
/// from the farthest on.
const MAX_ROUNDS: u32 = 6;

/// Area below which pieces are left out, px².
const MIN_PIECE_PX2: f64 = 0.02;

/// Clusters in the order of painting.
pub(crate) struct ClusterArrangement {
    pub clusters: Vec<FacetCluster>,
    /// Largest displacement of the picture in them, px.
    pub tolerance: f64,
}

/// Gathers facets into clusters in the order of painting; `fit` has one px as its tolerance. Clusters that
/// cover each other cyclically are split, down to single facets.
pub(crate) fn arrange_clusters(
    screen: &PixelGrid,
    facets: &[Facet],
    neighbours: &FacetNeighbours,
    fit: ClusterFit,
) -> ClusterArrangement {
    let px = fit.tolerance;
    let mut doublings = 0;
    loop {
        let tolerance = TOLERANCE_PX * f64::from(1_u32 << doublings);
        let mut company = vec![MergeRule::All; facets.len()];
        let mut rounds = 0;
        let arranged = loop {
            let mut found =
                clusters(facets, neighbours, &company, &ClusterFit { tolerance: tolerance * px, ..fit });
            found.retain(|cluster| cluster.area(facets) > MIN_PIECE_PX2 * px * px);
            let ClusterOrder { numbers, in_turn } = back_to_front(screen, facets, &found);
            let mut any = false;
            for facet in in_turn.iter().flat_map(|number| &found[*number as usize].facets) {
                let own = &mut company[*facet as usize];
                any |= *own < MergeRule::Alone;
                *own = if *own == MergeRule::All { MergeRule::Unparted } else { MergeRule::Alone };
            }
            rounds += 1;
            if !any || rounds == MAX_ROUNDS {
                let mut found: Vec<Option<FacetCluster>> = found.into_iter().map(Some).collect();
                break numbers
                    .into_iter()
                    .filter_map(|number| found[number as usize].take())
                    .collect::<Vec<_>>();
            }
        };
        if arranged.len() <= MAX_PIECES || doublings == MAX_DOUBLINGS {
            return ClusterArrangement { clusters: arranged, tolerance };
        }
        doublings += 1;
    }
}
