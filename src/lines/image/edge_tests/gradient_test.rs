//! Gradient test (Scheelk): pixels where gradients of depth and normals change.
//!
//! Source: Scheelk, Non-Photorealistic Rendering, sections 3.4.3 (the gradient, an improved Sobel filter) and
//! 3.4.4 (its use), with the coefficients given there.

use std::ops::Range;

use crate::parallel::prelude::*;

use crate::lines::image::ImageOptions;
use crate::view::raster::{NO_FRONT, NormalDepthMaps};

/// Rows per task; their gradients fit into the cache.
const ROWS_PER_TASK: usize = 32;

/// Flags of edge pixels, row by row.
///
/// The gradient of a value X is the weighted mean of its differences to its neighbours A … H. Those with a
/// common side count twice: g = (|A − X| + 2|B − X| + … + |H − X|) / 8. For normals it is the mean over x, y
/// and z. With the largest and smallest gradient within 3 × 3 pixels, p = min(((`g_max` − `g_min`) / k)², 1).
/// A pixel is an edge if p of depth plus p of normals reaches the threshold. Outside the image the nearest
/// pixels are used.
#[must_use]
pub(crate) fn edges(maps: &NormalDepthMaps, options: &ImageOptions) -> Vec<bool> {
    let (columns, rows) = (maps.columns, maps.rows);
    let spans = spans(maps);
    let k = [options.gradient_depth as f32, options.gradient_normal as f32];
    let least = options.gradient_least as f32;
    let mut edges = vec![false; columns * rows];
    edges.par_chunks_mut(ROWS_PER_TASK * columns).enumerate().for_each_init(
        || [Gradients::default(), Gradients::default()],
        |[depths, normals], (band, edges)| {
            let own = band * ROWS_PER_TASK..((band + 1) * ROWS_PER_TASK).min(rows);
            let around = own.start.saturating_sub(1)..(own.end + 1).min(rows);
            depths.fill(&maps.depths, columns, &spans, around.clone());
            normals.fill(maps.normals.as_flattened(), columns, &spans, around);
            for (row, edges) in own.zip(edges.chunks_mut(columns)) {
                let Some([from, to]) = spans.around(row, 2) else { continue };
                let around = three(row, rows);
                let depth = changes(around.map(|row| depths.row(row)), [from, to], k[0]);
                let normal = changes(around.map(|row| normals.row(row)), [from, to], k[1]);
                for ((edge, depth), normal) in edges[from..to].iter_mut().zip(depth).zip(normal) {
                    *edge = depth + normal >= least;
                }
            }
        },
    );
    edges
}

/// For each row the first column with a face, and the one after the last.
struct Spans {
    rows: Vec<[usize; 2]>,
    columns: usize,
}

fn spans(maps: &NormalDepthMaps) -> Spans {
    let span = |faces: &[u32]| {
        let is_shown = |face: &u32| *face != NO_FRONT;
        let first = faces.iter().position(is_shown).unwrap_or(faces.len());
        [first, faces.iter().rposition(is_shown).map_or(first, |last| last + 1)]
    };
    Spans { rows: maps.faces.par_chunks(maps.columns).map(span).collect(), columns: maps.columns }
}

impl Spans {
    /// Columns within `far` pixels of a face in the rows within `far` of a row; none if there is no face.
    fn around(&self, row: usize, far: usize) -> Option<[usize; 2]> {
        let near = &self.rows[row.saturating_sub(far)..(row + far + 1).min(self.rows.len())];
        let shown = near.iter().filter(|[from, to]| from < to);
        let [from, to] = shown.fold([usize::MAX, 0], |[a, b], [from, to]| [a.min(*from), b.max(*to)]);
        (from < to).then(|| [from.saturating_sub(far), (to + far).min(self.columns)])
    }
}

/// The row above, the row itself and the row below, clamped to the image.
fn three(row: usize, rows: usize) -> [usize; 3] {
    [row.saturating_sub(1), row, (row + 1).min(rows - 1)]
}

/// Gradients of a range of rows.
#[derive(Default)]
struct Gradients {
    values: Vec<f32>,
    columns: usize,
    first: usize,
    sums: Vec<f32>,
    padded: [Vec<f32>; 3],
}

impl Gradients {
    /// Computes the gradients of an image with one or several values per pixel, as the mean over these.
    fn fill(&mut self, image: &[f32], columns: usize, spans: &Spans, rows: Range<usize>) {
        (self.columns, self.first) = (columns, rows.start);
        self.values.clear();
        self.values.resize(rows.len() * columns, 0.0);
        for row in rows {
            if let Some(span) = spans.around(row, 1) {
                self.fill_row(image, spans.rows.len(), row, span);
            }
        }
    }

    fn fill_row(&mut self, image: &[f32], rows: usize, row: usize, [from, to]: [usize; 2]) {
        let Self { values, columns, first, sums, padded } = self;
        let channels = image.len() / (*columns * rows);
        let wide = *columns * channels;
        let count = (to - from) * channels;
        let image = three(row, rows).map(|row| &image[row * wide..(row + 1) * wide]);
        // One pixel more on both sides, so that inner pixels need no bounds check.
        let around = if from > 0 && to < *columns {
            image.map(|row| &row[(from - 1) * channels..(to + 1) * channels])
        } else {
            for (padded, row) in padded.iter_mut().zip(image) {
                padded.clear();
                let before = from.saturating_sub(1) * channels;
                padded.extend_from_slice(&row[before..before + channels]);
                padded.extend_from_slice(&row[from * channels..to * channels]);
                let behind = to.min(*columns - 1) * channels;
                padded.extend_from_slice(&row[behind..behind + channels]);
            }
            [&*padded[0], &*padded[1], &*padded[2]]
        };
        // Slices of equal length, so that the loop is vectorized.
        let side = |row: usize, right: usize| &around[row][right * channels..right * channels + count];
        let (a, b, c) = (side(0, 0), side(0, 1), side(0, 2));
        let (d, x, e) = (side(1, 0), side(1, 1), side(1, 2));
        let (f, g, h) = (side(2, 0), side(2, 1), side(2, 2));
        sums.resize(count, 0.0);
        let sums = &mut sums[..count];
        for i in 0..count {
            let x = x[i];
            let (a, b, c) = ((a[i] - x).abs(), (b[i] - x).abs(), (c[i] - x).abs());
            let (d, e) = ((d[i] - x).abs(), (e[i] - x).abs());
            let (f, g, h) = ((f[i] - x).abs(), (g[i] - x).abs(), (h[i] - x).abs());
            sums[i] = (a + 2.0 * b + c + 2.0 * d + 2.0 * e + f + 2.0 * g + h) / 8.0;
        }
        let start = (row - *first) * *columns;
        for (value, sums) in values[start + from..start + to].iter_mut().zip(sums.chunks_exact(channels)) {
            *value = sums.iter().sum::<f32>() / channels as f32;
        }
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.values[(row - self.first) * self.columns..(row - self.first + 1) * self.columns]
    }
}

/// p of a range of pixels in a row, from the gradients of three rows.
fn changes([above, own, below]: [&[f32]; 3], [from, to]: [usize; 2], k: f32) -> Vec<f32> {
    let (first, end) = (from.saturating_sub(1), (to + 1).min(own.len()));
    let (above, own, below) = (&above[first..end], &own[first..end], &below[first..end]);
    // Comparisons instead of `min` and `max`, which check for NaN.
    let min = |a: f32, b: f32| if a < b { a } else { b };
    let max = |a: f32, b: f32| if a > b { a } else { b };
    let (mut low, mut high) = (vec![0.0_f32; end - first], vec![0.0_f32; end - first]);
    for i in 0..end - first {
        low[i] = min(min(above[i], own[i]), below[i]);
        high[i] = max(max(above[i], own[i]), below[i]);
    }
    let of = |column: usize| {
        let (a, b, c) =
            (column.max(first + 1) - 1 - first, column - first, (column + 1).min(end - 1) - first);
        let share = (max(max(high[a], high[b]), high[c]) - min(min(low[a], low[b]), low[c])) / k;
        min(share * share, 1.0)
    };
    (from..to).map(of).collect()
}
