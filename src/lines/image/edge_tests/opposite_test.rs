//! Opposite test (Ishaya): pixels with different normals or depth on opposite sides.
//!
//! Source: Ishaya, Real-Time Cartoon Rendering with Direct-X 8.0 Hardware, GameDev.net 2003, listing 4: nine
//! instructions of a pixel shader, with the constants given there.

use crate::parallel::prelude::*;

use super::pixel_neighbours::around;
use crate::lines::image::ImageOptions;
use crate::view::raster::{NO_FRONT, NormalDepthMaps};

/// Half a step of the listing's hardware, which computes in steps of 1/256. Less than that has no effect.
const HALF_STEP: f32 = 1.0 / 512.0;

/// Flags of edge pixels, row by row.
///
/// 1. For each of the two pairs of opposite neighbours: n = clamp(4 (cos − t), 0, 1), with the cosine of
///    their normals. The threshold t is that for normals, minus a share of the depth at the left neighbour.
/// 2. N = clamp(4 n₁ n₂, 0, 1).
/// 3. A pixel is an edge if (1 − N) + d₁² + d₂² + 2c exceeds 1/2, with the depth differences d and the depth
///    threshold c.
#[must_use]
pub(crate) fn edges(maps: &NormalDepthMaps, options: &ImageOptions) -> Vec<bool> {
    let (columns, rows) = (maps.columns, maps.rows);
    let [normal, far, depth] =
        [options.opposite_normal, options.opposite_far, options.opposite_depth].map(|x| x as f32);
    let mut edges = vec![false; columns * rows];
    edges.par_chunks_mut(columns).enumerate().for_each(|(row, edges)| {
        for (column, edge) in edges.iter_mut().enumerate() {
            let at = around(columns, rows, column, row);
            if maps.is_bare(&at) {
                continue;
            }
            let [left, right, above, below] = [3, 5, 1, 7].map(|i| at[i]);
            let threshold = normal - far * maps.depths[left];
            let [n0, n1] = [cosine(maps, left, right), cosine(maps, above, below)]
                .map(|cosine| (4.0 * (cosine - threshold)).clamp(0.0, 1.0));
            let alike = (4.0 * n0 * n1).clamp(0.0, 1.0);
            let [d0, d1] = [maps.depths[left] - maps.depths[right], maps.depths[above] - maps.depths[below]];
            let sum = (1.0 - alike) + (d0 * d0 + depth) + (d1 * d1 + depth);
            *edge = sum > 0.5 + HALF_STEP;
        }
    });
    edges
}

/// Cosine between the normals of two pixels. Background agrees with background only.
#[inline]
fn cosine(maps: &NormalDepthMaps, a: usize, b: usize) -> f32 {
    if maps.faces[a] == NO_FRONT && maps.faces[b] == NO_FRONT {
        return 1.0;
    }
    let (a, b) = (maps.normals[a], maps.normals[b]);
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
