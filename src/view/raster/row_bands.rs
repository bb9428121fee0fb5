//! [`Bands`]: the triangles of a screen by the rows they lie in, so that rows can be drawn side by side.
//!
//! Sorting pays where each pixel is asked for more than its face as soon as it is drawn; a [`super::FaceBuffer`] alone is made
//! faster without.

use std::ops::Range;

use crate::parallel::prelude::*;

use super::Screen;
use super::depth_cell::{Cell, cell};
use crate::geometry::lists::csr_lists::{Grouped, grouped};

/// Rows of a band: few enough for a near cache, many enough that most triangles lie in one band.
const ROWS: usize = 16;

/// Triangles that are sorted by one task.
const TASK: usize = 1 << 13;

/// The triangles of a screen by the bands of rows they lie in.
pub(crate) struct Bands<'a> {
    screen: &'a Screen<'a>,
    /// Task after task, so that none has to wait for another.
    triangles: Vec<Grouped<u32>>,
}

impl<'a> Bands<'a> {
    pub fn new(screen: &'a Screen<'a>) -> Self {
        let count = screen.triangle_count();
        let of_task = |task: usize| {
            // Most triangles of a scan cover no pixel's centre, and are looked at no more.
            let covering = (task * TASK..((task + 1) * TASK).min(count)).filter_map(|id| {
                let rows = screen.rows_of(&screen.triangle(id).0)?;
                Some((id as u32, rows.start / ROWS..rows.end.div_ceil(ROWS)))
            });
            let covering: Vec<(u32, Range<usize>)> = covering.collect();
            grouped(screen.rows.div_ceil(ROWS), |put| {
                for (id, bands) in &covering {
                    bands.clone().for_each(|band| put(band, *id));
                }
            })
        };
        Self {
            screen,
            triangles: (0..count.div_ceil(TASK)).into_par_iter().with_max_len(1).map(of_task).collect(),
        }
    }

    /// Pixels of a band; the last one may have fewer.
    pub fn pixels(&self) -> usize {
        ROWS * self.screen.columns
    }

    /// The rows of a band.
    pub fn rows(&self, band: usize) -> Range<usize> {
        band * ROWS..((band + 1) * ROWS).min(self.screen.rows)
    }

    /// Draws a band: in `cells`, one a pixel, zero at first, stands what is in front.
    ///
    /// The nearer face wins, of equally near ones that of the lesser id, whatever the order.
    pub fn draw(&self, band: usize, cells: &mut [Cell]) {
        let first = band * self.pixels();
        for id in self.triangles.iter().flat_map(|of_task| of_task.of(band)) {
            let (corners, face) = self.screen.triangle(*id as usize);
            self.screen.cover_within(self.rows(band), &corners, |pixel, nearness| {
                let own = &mut cells[pixel - first];
                *own = (*own).max(cell(face, nearness));
            });
        }
    }
}
