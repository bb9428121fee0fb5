//! [`Arranged`]: facets gathered into clusters that can be painted one after the other.

use super::cluster_order::{Order, back_to_front};
use super::facet_cluster::{Cluster, Company, Fit, Neighbours, clusters};
use crate::images::facets::facet::Facet;
use crate::view::raster::Screen;

/// How far beside its place a picture may be seen, px.
pub(crate) const TOLERANCE_PX: f64 = 0.3;

/// A picture is seen in this many pieces at most. Where that is too few its tolerance is doubled, three times at most, and then the
/// smallest pieces are left out: there its mean colour is seen.
pub(crate) const MOST_PIECES: usize = 20_000;

/// The tolerance is doubled so often at most, that there are fewer pieces.
const MOST_DOUBLINGS: u32 = 3;

/// Clusters fall into smaller ones so often at most; what still covers each other in turn is painted from the farthest on.
const MOST_ROUNDS: u32 = 6;

/// Pieces smaller than this, px², are left out.
const LEAST_PIECE_PX2: f64 = 0.02;

/// Clusters in the order in which they are painted.
pub(crate) struct Arranged {
    pub clusters: Vec<Cluster>,
    /// How far beside its place the picture may be seen in them, px.
    pub tolerance: f64,
}

/// The clusters, where `fit` has a px as its tolerance. Those that cover each other in turn
/// fall into smaller ones, down to facets.
pub(crate) fn arranged(screen: &Screen, facets: &[Facet], neighbours: &Neighbours, fit: Fit) -> Arranged {
    let px = fit.tolerance;
    let mut doublings = 0;
    loop {
        let tolerance = TOLERANCE_PX * f64::from(1_u32 << doublings);
        let mut company = vec![Company::All; facets.len()];
        let mut rounds = 0;
        let arranged = loop {
            let mut found = clusters(facets, neighbours, &company, &Fit { tolerance: tolerance * px, ..fit });
            found.retain(|cluster| cluster.area(facets) > LEAST_PIECE_PX2 * px * px);
            let Order { numbers, in_turn } = back_to_front(screen, facets, &found);
            let mut any = false;
            for facet in in_turn.iter().flat_map(|number| &found[*number as usize].facets) {
                let own = &mut company[*facet as usize];
                any |= *own < Company::Alone;
                *own = if *own == Company::All { Company::Unparted } else { Company::Alone };
            }
            rounds += 1;
            if !any || rounds == MOST_ROUNDS {
                let mut found: Vec<Option<Cluster>> = found.into_iter().map(Some).collect();
                break numbers
                    .into_iter()
                    .filter_map(|number| found[number as usize].take())
                    .collect::<Vec<_>>();
            }
        };
        if arranged.len() <= MOST_PIECES || doublings == MOST_DOUBLINGS {
            return Arranged { clusters: arranged, tolerance };
        }
        doublings += 1;
    }
}
