//! [`GridTiles`]: border pieces by the tiles of the page that they pass, so that only neighbours are
//! compared.

use rustc_hash::FxHashMap;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};

/// Point of the grid.
pub(crate) type GridPoint = [i64; 2];

/// Average number of pieces per tile, over the whole page.
const PIECES_PER_TILE: usize = 1;

/// Approximate maximum number of tiles along an axis.
const MAX_TILES_PER_AXIS: usize = 1000;

/// Grid of tiles with the border pieces that pass each of them.
#[derive(Default)]
pub(crate) struct GridTiles {
    low: GridPoint,
    /// Width and height of tiles, as powers of two.
    shift: [u32; 2],
    across: GridPoint,
    first: CsrLists<u32>,
    /// Pieces that were added later; few.
    later: FxHashMap<u32, Vec<u32>>,
}

impl GridTiles {
    /// Tiles of the bounding box of the points, filled with `count` pieces.
    pub(crate) fn new(points: &[GridPoint], count: usize, ends: impl Fn(u32) -> [GridPoint; 2]) -> Self {
        let low = [0, 1].map(|k| points.iter().map(|p| p[k]).min().unwrap_or_default());
        let high = [0, 1].map(|k| points.iter().map(|p| p[k]).max().unwrap_or_default());
        let across = ((count / PIECES_PER_TILE) as f64).sqrt() as usize;
        let across = across.clamp(1, MAX_TILES_PER_AXIS) as i64;
        // Power of two nearest to the wanted size.
        let shift = [0, 1].map(|k| {
            let size = (high[k] - low[k]) / across + 1;
            let below = size.ilog2();
            if size * size > 2 << (2 * below) { below + 1 } else { below }
        });
        let across = [0, 1].map(|k| ((high[k] - low[k]) >> shift[k]) + 1);
        let tiles = Self { low, shift, across, ..Self::default() };
        let first = csr_lists((across[0] * across[1]) as usize, |put| {
            for piece in 0..count as u32 {
                tiles.each(ends(piece), |tile| put(tile as usize, piece));
            }
        });
        Self { first, ..tiles }
    }

    /// Adds a piece, and calls `touch` for each tile that it passes.
    pub(crate) fn add(&mut self, number: u32, ends: [GridPoint; 2], mut touch: impl FnMut(u32)) {
        let mut passed = Vec::new();
        self.each(ends, |tile| passed.push(tile));
        for tile in passed {
            self.later.entry(tile).or_default().push(number);
            touch(tile);
        }
    }

    /// Number of tiles.
    pub(crate) fn count(&self) -> usize {
        self.first.count()
    }

    /// Pieces that pass a tile.
    pub(crate) fn of(&self, tile: u32) -> impl Iterator<Item = u32> + '_ {
        self.first.of(tile as usize).iter().chain(self.later.get(&tile).into_iter().flatten()).copied()
    }

    /// Tiles within `reach` of a point.
    pub(crate) fn around(&self, p: GridPoint, reach: f64) -> impl Iterator<Item = u32> + '_ {
        let reach = reach.ceil() as i64;
        let range = |k: usize| self.place(p[k] - reach, k)..=self.place(p[k] + reach, k);
        let columns = range(0);
        range(1).flat_map(move |row| columns.clone().map(move |column| self.number(column, row)))
    }

    fn place(&self, x: i64, k: usize) -> i64 {
        ((x - self.low[k]) >> self.shift[k]).clamp(0, self.across[k] - 1)
    }

    fn number(&self, column: i64, row: i64) -> u32 {
        (row * self.across[0] + column) as u32
    }

    /// Visits each tile that a piece passes or touches.
    fn each(&self, [mut a, mut b]: [GridPoint; 2], mut call: impl FnMut(u32)) {
        if a[1] > b[1] {
            std::mem::swap(&mut a, &mut b);
        }
        let (first, last) = (self.place(a[1] - 1, 1), self.place(b[1] + 1, 1));
        for row in first..=last {
            let (x, y) = if first == last {
                (a[0], b[0])
            } else {
                // The part of the piece within this row, plus a margin.
                let top = self.low[1] + (row << self.shift[1]) - 2;
                let bottom = self.low[1] + ((row + 1) << self.shift[1]) + 2;
                let rise = (b[1] - a[1]).max(1) as f64;
                let at = |y: i64| {
                    let t = ((y - a[1]) as f64 / rise).clamp(0.0, 1.0);
                    a[0] as f64 + (b[0] - a[0]) as f64 * t
                };
                let (x, y) = if a[1] == b[1] { (a[0] as f64, b[0] as f64) } else { (at(top), at(bottom)) };
                (x.min(y).floor() as i64, x.max(y).ceil() as i64)
            };
            for column in self.place(x.min(y) - 2, 0)..=self.place(x.max(y) + 2, 0) {
                call(self.number(column, row));
            }
        }
    }
}
