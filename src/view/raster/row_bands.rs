//! [`RowBands`]: the triangles of a screen sorted by bands of rows, so that bands can be drawn in parallel.
//!
//! Sorting pays where pixels need more than their face right after drawing. A [`super::FaceBuffer`] alone is
//! faster without.

use std::ops::Range;

use crate::parallel::prelude::*;

use super::PixelGrid;
use super::depth_cell::{DepthCell, depth_cell};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};

/// Rows per band: few enough for the CPU cache, and enough that most triangles lie in one band.
const ROWS_PER_BAND: usize = 16;

/// Triangles per task of the sort.
const TRIANGLES_PER_TASK: usize = 1 << 13;

/// Triangles of a screen, by the bands of rows they overlap.
pub(crate) struct RowBands<'a> {
    screen: &'a PixelGrid<'a>,
    /// One list per task, so no task waits for another.
    triangles: Vec<CsrLists<u32>>,
}

impl<'a> RowBands<'a> {
    pub(crate) fn new(screen: &'a PixelGrid<'a>) -> Self {
        let count = screen.triangle_count();
        let of_task = |task: usize| {
            // Most triangles of a scan cover no pixel centre and are dropped here.
            let covering = (task * TRIANGLES_PER_TASK..((task + 1) * TRIANGLES_PER_TASK).min(count))
                .filter_map(|id| {
                    let rows = screen.rows_of(&screen.triangle(id).0)?;
                    Some((id as u32, rows.start / ROWS_PER_BAND..rows.end.div_ceil(ROWS_PER_BAND)))
                });
            let covering: Vec<(u32, Range<usize>)> = covering.collect();
            csr_lists(screen.rows.div_ceil(ROWS_PER_BAND), |put| {
                for (id, bands) in &covering {
                    bands.clone().for_each(|band| put(band, *id));
                }
            })
        };
        Self {
            screen,
            triangles: (0..count.div_ceil(TRIANGLES_PER_TASK))
                .into_par_iter()
                .with_max_len(1)
                .map(of_task)
                .collect(),
        }
    }

    /// Number of pixels in a band; the last one may have fewer.
    pub(crate) fn pixels(&self) -> usize {
        ROWS_PER_BAND * self.screen.columns
    }

    /// Rows of a band.
    pub(crate) fn rows(&self, band: usize) -> Range<usize> {
        band * ROWS_PER_BAND..((band + 1) * ROWS_PER_BAND).min(self.screen.rows)
    }

    /// Draws a band into `cells`, one per pixel, which must be zero at first.
    ///
    /// The nearer face wins; of equally near faces, the one with the smaller id. The order has no effect.
    pub(crate) fn draw(&self, band: usize, cells: &mut [DepthCell]) {
        let first = band * self.pixels();
        for id in self.triangles.iter().flat_map(|of_task| of_task.of(band)) {
            let (corners, face) = self.screen.triangle(*id as usize);
            self.screen.cover_within(self.rows(band), &corners, |pixel, nearness| {
                let own = &mut cells[pixel - first];
                *own = (*own).max(depth_cell(face, nearness));
            });
        }
    }
}
