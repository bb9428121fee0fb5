//! [`FaceBuffer`]: which face is in front at each pixel of a view.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::Screen;
use super::screen::is_small;

/// Triangles handled by one task.
const TASK: usize = 1 << 13;

/// The face nearest to the eye at the centre of each pixel, row after row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceBuffer {
    /// Pixels in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    cells: Vec<Cell>,
    /// Slope of the front face in each pixel, [`ScreenPlane::slope`](super::screen::ScreenPlane).
    slopes: Vec<[f32; 2]>,
    fragments: Vec<Vec<Fragment>>,
}

/// What is in front at a pixel. The bits of its nearness, which order positive numbers, stand
/// above those of the face, inverted, and of whether that is averted; all zero if there is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell(u64);

impl Cell {
    #[inline]
    fn new(nearness: f32, face: u32, facing: bool) -> Self {
        Self(u64::from(nearness.to_bits()) << 32 | u64::from(!(face << 1 | u32::from(!facing))))
    }

    /// Whether there is a face at all.
    #[inline]
    #[must_use]
    pub fn is_filled(self) -> bool {
        self.0 != 0
    }

    /// The face.
    #[inline]
    #[must_use]
    pub fn face(self) -> u32 {
        !(self.0 as u32) >> 1
    }

    /// Whether the face turns its outside to the eye.
    #[inline]
    #[must_use]
    pub fn is_facing(self) -> bool {
        self.0 & 1 == 1
    }

    /// How near the face is at the pixel, on the screen's scale from 0 to 1.
    #[inline]
    #[must_use]
    pub fn nearness(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }
}

/// A small triangle at one pixel, in front or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// The pixel.
    pub pixel: u32,
    /// The face.
    pub face: u32,
    /// How near it is there.
    pub nearness: f32,
}

impl FaceBuffer {
    /// Draws all triangles of a screen.
    ///
    /// The nearer face wins, of equally near ones that of the lesser id, whatever the order and
    /// the number of threads.
    #[must_use]
    pub fn new(screen: &Screen) -> Self {
        let cells: Vec<AtomicU64> = (0..screen.columns * screen.rows).map(|_| AtomicU64::new(0)).collect();
        let count = screen.triangle_count();
        let fragments = (0..count.div_ceil(TASK))
            .into_par_iter()
            .map(|task| {
                let mut fragments = Vec::with_capacity(TASK);
                for id in task * TASK..((task + 1) * TASK).min(count) {
                    draw(screen, id, &cells, &mut fragments);
                }
                fragments
            })
            .collect();
        let cells: Vec<Cell> = cells.into_iter().map(|cell| Cell(cell.into_inner())).collect();
        let slopes = slopes(screen, &cells);
        Self { columns: screen.columns, rows: screen.rows, cells, slopes, fragments }
    }

    /// What is in front at a pixel.
    #[inline]
    #[must_use]
    pub fn front(&self, pixel: usize) -> Cell {
        self.cells[pixel]
    }

    /// How the nearness of the face in front changes per pixel to the right and down.
    #[inline]
    #[must_use]
    pub fn slope(&self, pixel: usize) -> [f32; 2] {
        self.slopes[pixel]
    }

    /// All small triangles at all pixels, in lists that follow each other in mesh order.
    #[must_use]
    pub fn fragments(&self) -> &[Vec<Fragment>] {
        &self.fragments
    }
}

/// Draws one triangle.
#[inline]
fn draw(screen: &Screen, id: usize, cells: &[AtomicU64], fragments: &mut Vec<Fragment>) {
    let (corners, face) = screen.triangle(id);
    let Some(pixel_box) = screen.pixel_box(&corners) else { return };
    let facing = screen.is_facing(face);
    let put = |pixel: usize, q: f32| {
        let Cell(cell) = Cell::new(q, face, facing);
        // Most triangles lose, and looking is cheaper than writing.
        if cell > cells[pixel].load(Ordering::Relaxed) {
            cells[pixel].fetch_max(cell, Ordering::Relaxed);
        }
    };
    if is_small(pixel_box) {
        screen.cover_few(&corners, pixel_box, |pixel, nearness| {
            put(pixel, nearness);
            fragments.push(Fragment { pixel: pixel as u32, face, nearness });
        });
    } else {
        screen.cover(&corners, pixel_box, put);
    }
}

/// The slope of the face in front at each pixel.
fn slopes(screen: &Screen, cells: &[Cell]) -> Vec<[f32; 2]> {
    let mut slopes = vec![[0.0; 2]; cells.len()];
    slopes.par_chunks_mut(screen.columns).zip(cells.par_chunks(screen.columns)).for_each(|(slopes, cells)| {
        let mut last = (u32::MAX, [0.0; 2]);
        for (slope, cell) in slopes.iter_mut().zip(cells) {
            if cell.is_filled() {
                if cell.face() != last.0 {
                    last = (cell.face(), screen.plane(cell.face()).slope);
                }
                *slope = last.1;
            }
        }
    });
    slopes
}
