//! [`FaceBuffer`]: which face is in front at each pixel of a view.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::Screen;

/// Triangles handled by one task.
const TASK: usize = 1 << 13;

/// The face nearest to the eye at the centre of each pixel, row after row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaceBuffer {
    /// Pixels in a row.
    pub columns: usize,
    /// The bits of the nearness, which order positive numbers, above those of the face, inverted;
    /// zero where there is no face.
    cells: Vec<u64>,
}

impl FaceBuffer {
    /// Draws all triangles of a screen.
    ///
    /// The nearer face wins, of equally near ones that of the lesser id, whatever the order and
    /// the number of threads.
    #[must_use]
    pub fn new(screen: &Screen) -> Self {
        let cells: Vec<AtomicU64> =
            (0..screen.columns * screen.rows).map(|_| AtomicU64::new(0)).collect();
        let count = screen.triangle_count();
        (0..count.div_ceil(TASK)).into_par_iter().for_each(|task| {
            for id in task * TASK..((task + 1) * TASK).min(count) {
                let (corners, face) = screen.triangle(id);
                screen.cover(corners, |pixel, q| {
                    let cell = u64::from(q.to_bits()) << 32 | u64::from(!face);
                    // Most triangles lose, and looking is cheaper than writing.
                    if cell > cells[pixel].load(Ordering::Relaxed) {
                        cells[pixel].fetch_max(cell, Ordering::Relaxed);
                    }
                });
            }
        });
        Self { columns: screen.columns, cells: cells.into_iter().map(AtomicU64::into_inner).collect() }
    }

    /// Number of pixels.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there are no pixels.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The face in front at a pixel, and how near it is there on the screen's scale from 0 to 1.
    #[inline]
    #[must_use]
    pub fn front(&self, pixel: usize) -> Option<(u32, f32)> {
        let cell = self.cells[pixel];
        (cell != 0).then(|| (!(cell as u32), f32::from_bits((cell >> 32) as u32)))
    }
}
