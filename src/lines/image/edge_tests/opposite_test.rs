//! Pixels on whose opposite sides normals or depth differ: the inker of Ishaya.
//!
//! Source: Ishaya, Real-Time Cartoon Rendering with Direct-X 8.0 Hardware, GameDev.net 2003, listing 4: nine instructions of a pixel
//! shader, with the constants given there.

use crate::parallel::prelude::*;

use super::pixel_neighbours::around;
use crate::lines::image::ImageOptions;
use crate::view::raster::{Maps, NO_FRONT};

/// The hardware of the listing computes in steps of 1/256: what is less than half of one is nothing.
const HALF_STEP: f32 = 1.0 / 512.0;

/// Which pixels are edges, row after row.
///
/// For the two pairs of opposite neighbours the cosine of their normals, less a threshold t, is four times taken and clamped to 0 … 1;
/// the two are multiplied, and again four times taken and clamped: n. t is the threshold for normals less what depth takes off,
/// asked at the first pixel of the four. A pixel is an edge where (1 − n) + d₁² + d₂² + 2c, with the differences of depth d
/// and their threshold c, is above a half.
#[must_use]
pub fn edges(maps: &Maps, options: &ImageOptions) -> Vec<bool> {
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

/// The cosine between the normals of two pixels; background agrees with background, and with nothing else.
#[inline]
fn cosine(maps: &Maps, a: usize, b: usize) -> f32 {
    if maps.faces[a] == NO_FRONT && maps.faces[b] == NO_FRONT {
        return 1.0;
    }
    let (a, b) = (maps.normals[a], maps.normals[b]);
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
