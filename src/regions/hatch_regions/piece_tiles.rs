//! [`BorderPieceTiles`]: border pieces, indexed by the tiles of the page that they pass.

use kurbo::{Point, Vec2};

use super::border_piece::{BorderPiece, PAPER};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::regions::tolerances;

/// Grid of square tiles with the border pieces that pass each of them.
#[derive(Debug, Clone, Default)]
pub(crate) struct BorderPieceTiles {
    low: Vec2,
    tiles_per_unit: f64,
    across: [usize; 2],
    pieces: CsrLists<u32>,
}

/// Average number of pieces per tile.
const PIECES_PER_TILE: usize = 2;

/// Maximum number of tiles along an axis.
const MAX_TILES_PER_AXIS: f64 = 256.0;

impl BorderPieceTiles {
    pub(crate) fn new(pieces: &[BorderPiece]) -> Self {
        let ends = || pieces.iter().flat_map(|piece| piece.ends);
        let Some(first) = ends().next() else { return Self::default() };
        let (low, high) = ends().fold((first, first), |(low, high), p| {
            (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
        });
        let size = high - low;
        let wanted = ((pieces.len() / PIECES_PER_TILE).max(1) as f64).sqrt().clamp(1.0, MAX_TILES_PER_AXIS);
        let tiles_per_unit = wanted / size.x.max(size.y).max(f64::MIN_POSITIVE);
        let across = [size.x, size.y].map(|length| (length * tiles_per_unit) as usize + 1);
        let mut grid = Self { low: low.to_vec2(), tiles_per_unit, across, ..Self::default() };
        grid.pieces = csr_lists(across[0] * across[1], |put| {
            for (number, piece) in pieces.iter().enumerate() {
                grid.pass(piece.ends[0], piece.ends[1], |tile| put(tile, number as u32));
            }
        });
        grid
    }

    /// Visits each tile inside the grid that a segment passes.
    fn pass(&self, from: Point, to: Point, mut call: impl FnMut(usize)) {
        let at = |p: Point| (p.to_vec2() - self.low) * self.tiles_per_unit;
        let (mut a, mut b) = (at(from), at(to));
        if a.y > b.y {
            std::mem::swap(&mut a, &mut b);
        }
        let [columns, rows] = self.across;
        if columns == 0 || b.y < 0.0 || a.y >= rows as f64 {
            return;
        }
        let way = b - a;
        let (first, last) = (a.y.max(0.0) as usize, (b.y.max(0.0) as usize).min(rows - 1));
        for row in first..=last {
            // The range of the segment in this row, slightly widened against rounding.
            let x_at =
                |y: f64| if way.y > 0.0 { a.x + way.x * ((y - a.y) / way.y).clamp(0.0, 1.0) } else { a.x };
            let (x0, x1) = if way.y > 0.0 { (x_at(row as f64), x_at(row as f64 + 1.0)) } else { (a.x, b.x) };
            let (x0, x1) =
                (x0.min(x1) - tolerances::COLUMN_MARGIN_TILES, x0.max(x1) + tolerances::COLUMN_MARGIN_TILES);
            if x1 < 0.0 || x0 >= columns as f64 {
                continue;
            }
            for column in x0.max(0.0) as usize..=(x1 as usize).min(columns - 1) {
                call(row * columns + column);
            }
        }
    }

    /// Visits the pieces in the tiles that a segment passes, some of them more than once.
    pub(crate) fn visit(&self, from: Point, to: Point, mut call: impl FnMut(u32)) {
        self.pass(from, to, |tile| self.pieces.of(tile).iter().for_each(|number| call(*number)));
    }

    /// Pieces in the tiles that a box touches, ascending.
    pub(crate) fn near(&self, low: Point, high: Point) -> Vec<u32> {
        let at = |p: Point| (p.to_vec2() - self.low) * self.tiles_per_unit;
        let (low, high) = (at(low), at(high));
        let mut found = Vec::new();
        let [columns, rows] = self.across;
        if columns == 0 || high.x < 0.0 || high.y < 0.0 {
            return found;
        }
        for row in low.y.max(0.0) as usize..=(high.y as usize).min(rows - 1) {
            for column in low.x.max(0.0) as usize..=(high.x as usize).min(columns - 1) {
                found.extend_from_slice(self.pieces.of(row * columns + column));
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Cell at a point: the cell on the right of the next piece to the left.
    pub(crate) fn cell_at(&self, pieces: &[BorderPiece], p: Point) -> u32 {
        let at = (p.to_vec2() - self.low) * self.tiles_per_unit;
        let [columns, rows] = self.across;
        if columns == 0 || at.x < 0.0 || at.y < 0.0 || at.y >= rows as f64 {
            return PAPER;
        }
        let row = at.y as usize;
        for column in (0..=(at.x as usize).min(columns - 1)).rev() {
            let mut nearest: Option<(f64, u32)> = None;
            for number in self.pieces.of(row * columns + column) {
                let piece = &pieces[*number as usize];
                let [a, b] = piece.ends;
                if (a.y > p.y) == (b.y > p.y) {
                    continue;
                }
                let x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
                // A piece that crosses this height farther left is found in a later tile.
                let here =
                    (x - self.low.x) * self.tiles_per_unit >= column as f64 - tolerances::COLUMN_MARGIN_TILES;
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
