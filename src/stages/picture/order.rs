//! The order in which clusters are painted, so that each covers those behind it.

use super::cluster::Cluster;
use super::facet::Facet;
use crate::raster::{Screen, painter};

/// Nearness, 0 to 1 over the whole depth of the view, that differs by less is equal: neighbours share the pixels along their sides.
const SAME_NEARNESS: f32 = 1e-5;

/// The numbers of clusters, the farthest first where it makes no difference.
pub(super) fn back_to_front(screen: &Screen, facets: &[Facet], clusters: &[Cluster]) -> Vec<u32> {
    let mut front: Vec<(f32, u32)> = vec![(f32::NEG_INFINITY, u32::MAX); screen.columns * screen.rows];
    let mut nearness = vec![0_u32; clusters.len()];
    let each = |call: &mut dyn FnMut(u32, usize, f32)| {
        for (number, cluster) in clusters.iter().enumerate() {
            for facet in &cluster.facets {
                let corners = facets[*facet as usize].corners.map(|corner| screen.point(corner.image));
                screen.cover(&corners, |pixel, near| call(number as u32, pixel, near));
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
        if other != cluster && nearest - near > SAME_NEARNESS && over.last() != Some(&[cluster, other]) {
            over.push([cluster, other]);
        }
    });
    over.sort_unstable();
    over.dedup();
    for (nearness, cluster) in nearness.iter_mut().zip(clusters) {
        let of = |facet: &u32| {
            let [a, b, c] = facets[*facet as usize].corners.map(|corner| screen.point(corner.image)[2]);
            ((a + b + c) / 3.0).max(0.0).to_bits()
        };
        *nearness = cluster.facets.iter().map(of).max().unwrap_or_default();
    }
    painter::sorted(&nearness, &over)
}
