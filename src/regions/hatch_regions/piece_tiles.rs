//! [`BorderPieceTiles`]: border pieces, indexed by the tiles of the page that they pass.

use kurbo::{Point, Rect};

use super::border_piece::{BorderPiece, PAPER};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::plane::planar_grid::PlanarGrid;
use crate::geometry::plane::polylines::bounds;
use crate::geometry::tolerances::CELL_MARGIN;

/// Border pieces by the tiles of the page that they pass.
#[derive(Debug, Clone, Default)]
pub(crate) struct BorderPieceTiles {
    grid: PlanarGrid,
    pieces: CsrLists<u32>,
}

/// Average number of pieces per tile.
const PIECES_PER_TILE: usize = 2;

/// Maximum number of tiles along an axis.
const MAX_TILES_PER_AXIS: f64 = 256.0;

impl BorderPieceTiles {
    pub(crate) fn new(pieces: &[BorderPiece]) -> Self {
        let Some(bounds) = bounds(pieces.iter().flat_map(|piece| piece.ends)) else { return Self::default() };
        let wanted = ((pieces.len() / PIECES_PER_TILE).max(1) as f64).sqrt().clamp(1.0, MAX_TILES_PER_AXIS);
        let longer = bounds.width().max(bounds.height()).max(f64::MIN_POSITIVE);
        let grid = PlanarGrid::new(bounds, wanted / longer);
        let pieces = csr_lists(grid.count(), |put| {
            for (number, piece) in pieces.iter().enumerate() {
                grid.visit_passed(piece.ends[0], piece.ends[1], |tile| put(tile, number as u32));
            }
        });
        Self { grid, pieces }
    }

    /// Visits the pieces in the tiles that a segment passes, some of them more than once.
    pub(crate) fn visit(&self, from: Point, to: Point, mut call: impl FnMut(u32)) {
        let visit = |tile| self.pieces.of(tile).iter().for_each(|number| call(*number));
        self.grid.visit_passed(from, to, visit);
    }

    /// Pieces in the tiles that a box touches, ascending.
    pub(crate) fn near(&self, bounds: Rect) -> Vec<u32> {
        let rows = self.grid.rows_in(bounds);
        let mut found: Vec<u32> = rows.flat_map(|tiles| self.pieces.of_all(tiles)).copied().collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Cell at a point: the cell on the right of the next piece to the left.
    pub(crate) fn cell_at(&self, pieces: &[BorderPiece], p: Point) -> u32 {
        let left = Rect::new(f64::NEG_INFINITY, p.y, p.x, p.y);
        let Some(tiles) = self.grid.rows_in(left).next() else { return PAPER };
        for tile in tiles.clone().rev() {
            let column = (tile - tiles.start) as f64;
            let mut nearest: Option<(f64, u32)> = None;
            for number in self.pieces.of(tile) {
                let piece = &pieces[*number as usize];
                let [a, b] = piece.ends;
                if (a.y > p.y) == (b.y > p.y) {
                    continue;
                }
                let x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
                // A piece that crosses this height farther left is found in a later tile.
                let here = self.grid.place(Point::new(x, p.y)).x >= column - CELL_MARGIN;
                if here && x <= p.x && nearest.is_none_or(|(most, _)| x > most) {
                    // The point lies to the left of a piece that runs down the page.
                    nearest = Some((x, piece.sides[usize::from(b.y > a.y)]));
                }
            }
            if let Some((_, cell)) = nearest {
                return cell;
            }
        }
        PAPER
    }
}
