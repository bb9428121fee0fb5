//! [`ClusterOrder`]: the order of painting clusters, so that each covers those behind it.

use super::facet_cluster::FacetCluster;
use crate::images::facets::facet::Facet;
use crate::images::facets::visible_faces::{pixel_of, sample_points};
use crate::images::tolerances;
use crate::view::raster::{PixelGrid, painter_order};

/// Order of painting clusters.
pub(crate) struct ClusterOrder {
    /// Indices of all clusters, the farthest first where the order is free.
    pub numbers: Vec<u32>,
    /// Indices of the clusters that cover each other cyclically, so that no order is correct for them.
    pub in_turn: Vec<u32>,
}

/// Sorts clusters from back to front.
pub(crate) fn back_to_front(screen: &PixelGrid, facets: &[Facet], clusters: &[FacetCluster]) -> ClusterOrder {
    const NO_CLUSTER: (f32, u32) = (f32::NEG_INFINITY, u32::MAX);
    let mut front: Vec<(f32, u32)> = vec![NO_CLUSTER; screen.columns * screen.rows];
    let corners = |facet: u32| facets[facet as usize].corners.map(|corner| screen.point(corner.image));
    let each = |call: &mut dyn FnMut(u32, usize, f32)| {
        for (number, cluster) in clusters.iter().enumerate() {
            for facet in &cluster.facets {
                screen.cover(&corners(*facet), |pixel, near| call(number as u32, pixel, near));
            }
        }
    };
    each(&mut |cluster, pixel, near| {
        if near > front[pixel].0 {
            front[pixel] = (near, cluster);
        }
    });
    let mut over: Vec<[u32; 2]> = Vec::new();
    each(&mut |cluster, pixel, near| {
        let (nearest, other) = front[pixel];
        if other != cluster
            && nearest - near > tolerances::MIN_NEARNESS_GAP
            && over.last() != Some(&[cluster, other])
        {
            over.push([cluster, other]);
        }
    });
    for (number, cluster) in clusters.iter().enumerate() {
        // Pieces of cut faces may fall between pixel centres.
        let cut = cluster.facets.iter().filter(|facet| facets[**facet as usize].is_cut());
        for point in cut.flat_map(|facet| sample_points(corners(*facet))) {
            let (nearest, other) = pixel_of(screen, point).map_or(NO_CLUSTER, |pixel| front[pixel]);
            if other as usize != number && nearest - point[2] > tolerances::MIN_NEARNESS_GAP {
                over.push([number as u32, other]);
            }
        }
    }
    over.sort_unstable();
    over.dedup();
    let middle = |facet: &u32| {
        let [a, b, c] = corners(*facet).map(|corner| corner[2]);
        ((a + b + c) / 3.0).max(0.0).to_bits()
    };
    let nearness: Vec<u32> =
        clusters.iter().map(|cluster| cluster.facets.iter().map(middle).max().unwrap_or_default()).collect();
    let numbers = painter_order::sorted(&nearness, &over);
    let mut place = vec![0; clusters.len()];
    numbers.iter().enumerate().for_each(|(at, number)| place[*number as usize] = at);
    let against = over.iter().filter(|[below, above]| place[*below as usize] > place[*above as usize]);
    let mut in_turn: Vec<u32> = against.flatten().copied().collect();
    in_turn.sort_unstable();
    in_turn.dedup();
    ClusterOrder { numbers, in_turn }
}
