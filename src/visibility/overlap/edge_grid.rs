//! [`EdgeGrid`]: lines of view edges, looked up by the tiles that they pass.

use glam::DVec3;
use kurbo::{Point, Vec2};

use super::edge_line::{EdgeLine, vector};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::parallel::prelude::*;
use crate::visibility::tiles::tile_grid::TileGrid;

/// Lines per task of the grid traversal.
pub(super) const LINES_PER_TASK: usize = 1 << 11;

/// Lines in a grid of tiles.
pub(crate) struct EdgeGrid {
    grid: TileGrid,
    in_tile: CsrLists<u32>,
}

impl EdgeGrid {
    /// Finds the tiles of lines, whose sides are at least `min_side` long; `None` without lines.
    pub(crate) fn new(lines: &[EdgeLine], min_side: f64) -> Option<Self> {
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let ends = lines.iter().map(EdgeLine::ends);
        let (low, high) = ends.fold(nothing, |(low, high), [p, q]| (low.min(p).min(q), high.max(p).max(q)));
        let size = (high - low).max_element();
        if !size.is_finite() {
            return None;
        }
        let max_across = (size / min_side).max(1.0) as u32;
        let across = ((lines.len() as f64).sqrt() as u32 * 2).clamp(16, 1024).min(max_across);
        let grid = TileGrid::new(low.truncate(), high.truncate(), across);
        let walked: Vec<Vec<(u32, u32)>> = lines
            .par_chunks(LINES_PER_TASK)
            .enumerate()
            .map(|(chunk, lines)| {
                let mut passed = Vec::with_capacity(2 * lines.len());
                for (line, number) in lines.iter().zip((chunk * LINES_PER_TASK) as u32..) {
                    let [p, q] = line.ends();
                    grid.walk(p, q, |tile, _, _| passed.push((tile as u32, number)));
                }
                passed
            })
            .collect();
        let passed = walked.iter().flatten().map(|(tile, number)| (*tile as usize, *number));
        let in_tile = csr_lists_from_pairs(grid.len(), passed);
        Some(Self { grid, in_tile })
    }

    /// Lines that pass a tile, ascending.
    pub(crate) fn lines_in(&self, tile: usize) -> &[u32] {
        self.in_tile.of(tile)
    }

    /// Calls `visit` for the tiles that a line or one of its parallels shifted by `across` passes.
    pub(crate) fn walk_beside(&self, ends: [Point; 2], across: Vec2, mut visit: impl FnMut(usize)) {
        for shift in [Vec2::ZERO, across, -across] {
            let [p, q] = ends.map(|end| vector(end + shift));
            self.grid.walk(p, q, |tile, _, _| visit(tile));
        }
    }
}
