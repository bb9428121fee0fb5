//! Pixels around which gradients change: the inker of Scheelk.
//!
//! Source: Scheelk, Non-Photorealistic Rendering, section 3.4.3 (the gradient, an improved Sobel filter) and 3.4.4 (what becomes of
//! it), with the coefficients given there.

use rayon::prelude::*;

use super::ImageOptions;
use crate::raster::{Maps, NO_FRONT};

/// Which pixels are edges, row after row.
///
/// The gradient of a value X is the mean of its differences to A … H around it, those beside it counted twice:
/// g = (|A − X| + 2|B − X| + … + |H − X|) / 8. Of normals it is the mean of those of x, y and z. With the largest and the
/// smallest within 3 × 3 pixels p = min(((`g_max` − `g_min`) / k)², 1), and a pixel is an edge where p of depth and p of normals
/// together reach the least. Beyond the picture all is as on its rim.
#[must_use]
pub fn edges(maps: &Maps, options: &ImageOptions) -> Vec<bool> {
    let columns = maps.columns;
    let spans = spans(maps);
    let depths = gradients(&maps.depths, columns, &spans);
    let normals = gradients(maps.normals.as_flattened(), columns, &spans);
    let k = [options.gradient_depth as f32, options.gradient_normal as f32];
    let least = options.gradient_least as f32;
    let mut edges = vec![false; maps.faces.len()];
    edges.par_chunks_mut(columns).enumerate().for_each(|(row, edges)| {
        let Some([from, to]) = spans.around(row, 2) else { return };
        let depth = changes(&depths, columns, row, [from, to], k[0]);
        let normal = changes(&normals, columns, row, [from, to], k[1]);
        for ((edge, depth), normal) in edges[from..to].iter_mut().zip(depth).zip(normal) {
            *edge = depth + normal >= least;
        }
    });
    edges
}

/// The first column of each row with a face, and the one after the last.
struct Spans {
    rows: Vec<[usize; 2]>,
    columns: usize,
}

fn spans(maps: &Maps) -> Spans {
    let span = |faces: &[u32]| {
        let is_shown = |face: &u32| *face != NO_FRONT;
        let first = faces.iter().position(is_shown).unwrap_or(faces.len());
        [first, faces.iter().rposition(is_shown).map_or(first, |last| last + 1)]
    };
    Spans { rows: maps.faces.par_chunks(maps.columns).map(span).collect(), columns: maps.columns }
}

impl Spans {
    /// The columns that are no farther than so many pixels from a face, from a row's place; none if it has none.
    fn around(&self, row: usize, far: usize) -> Option<[usize; 2]> {
        let near = &self.rows[row.saturating_sub(far)..(row + far + 1).min(self.rows.len())];
        let shown = near.iter().filter(|[from, to]| from < to);
        let [from, to] = shown.fold([usize::MAX, 0], |[a, b], [from, to]| [a.min(*from), b.max(*to)]);
        (from < to).then(|| [from.saturating_sub(far), (to + far).min(self.columns)])
    }
}

/// The numbers of the rows above a row, of itself, and below.
fn three(row: usize, rows: usize) -> [usize; 3] {
    [row.saturating_sub(1), row, (row + 1).min(rows - 1)]
}

/// The gradient at each pixel of an image of one or several values a pixel, over which its mean is taken.
fn gradients(values: &[f32], columns: usize, spans: &Spans) -> Vec<f32> {
    let rows = spans.rows.len();
    let channels = values.len() / (columns * rows);
    let mut gradients = vec![0.0; columns * rows];
    let wide = columns * channels;
    gradients.par_chunks_mut(columns).enumerate().for_each(|(row, gradients)| {
        let Some([from, to]) = spans.around(row, 1) else { return };
        // One pixel more to both sides, so that no pixel between has to ask for the rim.
        let padded = three(row, rows).map(|row| {
            let row = &values[row * wide..(row + 1) * wide];
            let mut padded = Vec::with_capacity((to - from + 2) * channels);
            let first = from.saturating_sub(1) * channels;
            padded.extend_from_slice(&row[first..first + channels]);
            padded.extend_from_slice(&row[from * channels..to * channels]);
            let last = to.min(columns - 1) * channels;
            padded.extend_from_slice(&row[last..last + channels]);
            padded
        });
        let count = (to - from) * channels;
        // Slices of one length, so that many pixels are taken at a time.
        let side = |row: usize, right: usize| &padded[row][right * channels..right * channels + count];
        let (a, b, c) = (side(0, 0), side(0, 1), side(0, 2));
        let (d, x, e) = (side(1, 0), side(1, 1), side(1, 2));
        let (f, g, h) = (side(2, 0), side(2, 1), side(2, 2));
        let mut sums = vec![0.0_f32; count];
        for i in 0..count {
            let x = x[i];
            let (a, b, c) = ((a[i] - x).abs(), (b[i] - x).abs(), (c[i] - x).abs());
            let (d, e) = ((d[i] - x).abs(), (e[i] - x).abs());
            let (f, g, h) = ((f[i] - x).abs(), (g[i] - x).abs(), (h[i] - x).abs());
            sums[i] = (a + 2.0 * b + c + 2.0 * d + 2.0 * e + f + 2.0 * g + h) / 8.0;
        }
        for (gradient, sums) in gradients[from..to].iter_mut().zip(sums.chunks_exact(channels)) {
            *gradient = sums.iter().sum::<f32>() / channels as f32;
        }
    });
    gradients
}

/// p of some pixels of a row: how much gradients differ within 3 × 3 pixels.
fn changes(gradients: &[f32], columns: usize, row: usize, [from, to]: [usize; 2], k: f32) -> Vec<f32> {
    let rows = gradients.len() / columns;
    let [above, own, below] = three(row, rows).map(|row| &gradients[row * columns..(row + 1) * columns]);
    let (first, end) = (from.saturating_sub(1), (to + 1).min(columns));
    let (above, own, below) = (&above[first..end], &own[first..end], &below[first..end]);
    // Comparisons, since `min` and `max` ask for NaN.
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
