//! Dilation: wider lines in an image of edges.
//!
//! Source: Ishaya, Real-Time Cartoon Rendering with Direct-X 8.0 Hardware, listing 5: two pixel shaders that
//! sample four neighbours. In drawings lines have the width of their pen instead.

use super::{Dilation, ImageOptions};

/// Ink of each pixel of an edge image, 0 to 1, after the dilation passes of the options.
///
/// - Plain pass: a pixel becomes ink if a neighbour is.
/// - Smooth pass: a pixel gets half the sum of its neighbours' ink, at most 1.
///
/// No pass removes ink. There is none outside the image.
#[must_use]
pub(crate) fn dilate_ink(edges: &[bool], columns: usize, options: &ImageOptions) -> Vec<f32> {
    let mut ink: Vec<f32> = edges.iter().map(|edge| f32::from(u8::from(*edge))).collect();
    let rows = edges.len().checked_div(columns).unwrap_or(0);
    for _ in 0..options.passes {
        let before = ink.clone();
        for (pixel, ink) in ink.iter_mut().enumerate() {
            let (column, row) = (pixel % columns, pixel / columns);
            let beside = [
                (column > 0).then(|| pixel - 1),
                (column + 1 < columns).then(|| pixel + 1),
                (row > 0).then(|| pixel - columns),
                (row + 1 < rows).then(|| pixel + columns),
            ];
            let inks = beside.into_iter().flatten().map(|pixel| before[pixel]);
            let own = match options.dilation {
                Dilation::Plain => inks.fold(0.0_f32, f32::max).ceil(),
                Dilation::Smooth => (0.5 * inks.sum::<f32>()).min(1.0),
            };
            *ink = ink.max(own);
        }
    }
    ink
}
