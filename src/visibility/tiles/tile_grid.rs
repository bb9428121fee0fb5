//! Grid of square tiles over the image, with segment traversal.

use glam::{DVec2, DVec3};

/// Square tiles that cover a part of the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TileGrid {
    /// Number of tiles from left to right.
    pub columns: u32,
    /// Number of tiles from top to bottom.
    pub rows: u32,
    /// Side of a tile, user units.
    pub cell: f64,
    /// Top left corner of the first tile.
    origin: DVec2,
    per_cell: f64,
}

/// Block of tiles: first and last column, first and last row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TileBox {
    /// First column.
    pub left: u16,
    /// Last column.
    pub right: u16,
    /// First row.
    pub top: u16,
    /// Last row.
    pub bottom: u16,
}

impl TileBox {
    /// The empty block.
    pub(crate) const EMPTY: Self = Self { left: 1, right: 0, top: 1, bottom: 0 };

    /// Whether the block is empty.
    #[inline]
    #[must_use]
    pub(crate) const fn is_empty(self) -> bool {
        self.left > self.right
    }

    /// Intersection of two blocks.
    #[inline]
    #[must_use]
    pub(crate) fn within(self, other: Self) -> Self {
        let overlap = Self {
            left: self.left.max(other.left),
            right: self.right.min(other.right),
            top: self.top.max(other.top),
            bottom: self.bottom.min(other.bottom),
        };
        if overlap.left > overlap.right || overlap.top > overlap.bottom { Self::EMPTY } else { overlap }
    }

    /// Number of tiles.
    #[inline]
    #[must_use]
    pub(crate) fn area(self) -> u32 {
        if self.is_empty() {
            return 0;
        }
        (u32::from(self.right - self.left) + 1) * (u32::from(self.bottom - self.top) + 1)
    }
}

/// Columns and rows within a margin of a point, counted from 1. The values 0 and count + 1 stand for
/// positions outside the grid.
///
/// The ranges of several points combine to that of their bounding box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TileReach {
    from: [u16; 2],
    to: [u16; 2],
}

impl TileReach {
    /// Range of a point without image position; makes every combined range empty.
    pub(crate) const CUT: Self = Self { from: [0; 2], to: [u16::MAX; 2] };

    /// Combined range of the three corners of a triangle.
    #[inline]
    pub(crate) fn of_all([a, b, c]: [Self; 3]) -> Self {
        let min_index = |k: usize| a.from[k].min(b.from[k]).min(c.from[k]);
        let max_index = |k: usize| a.to[k].max(b.to[k]).max(c.to[k]);
        Self { from: [min_index(0), min_index(1)], to: [max_index(0), max_index(1)] }
    }
}

impl TileGrid {
    /// Range of a point with a margin of `slack` to all sides.
    #[inline]
    pub(crate) fn around(&self, point: DVec3, slack: f64) -> TileReach {
        let last = self.corner(self.columns, self.rows);
        let clamped_index = |x: f64, first: f64, last: f64, tile: u32, count: u32| {
            if x < first {
                0
            } else if x > last {
                count as u16 + 1
            } else {
                tile as u16 + 1
            }
        };
        let column = |x: f64| clamped_index(x, self.origin.x, last.x, self.column(x), self.columns);
        let row = |y: f64| clamped_index(y, self.origin.y, last.y, self.row(y), self.rows);
        let (low, high) = (point - slack, point + slack);
        TileReach { from: [column(low.x), row(low.y)], to: [column(high.x), row(high.y)] }
    }

    /// Tiles in a range; equals [`Self::tile_box`] of the bounding box of its points and margins.
    #[inline]
    pub(crate) fn tiles_within(&self, around: TileReach) -> TileBox {
        let ([left, top], [right, bottom]) = (around.from, around.to);
        let (columns, rows) = (self.columns as u16, self.rows as u16);
        let is_off = right == 0 || left > columns || bottom == 0 || top > rows;
        if is_off || right == u16::MAX {
            return TileBox::EMPTY;
        }
        TileBox {
            left: left.max(1) - 1,
            right: right.min(columns) - 1,
            top: top.max(1) - 1,
            bottom: bottom.min(rows) - 1,
        }
    }

    /// Tiles that the box from `low` to `high` meets.
    #[inline]
    #[must_use]
    pub(crate) fn tile_box(&self, low: DVec3, high: DVec3) -> TileBox {
        let (first, last) = (self.origin, self.corner(self.columns, self.rows));
        if high.x < first.x || low.x > last.x || high.y < first.y || low.y > last.y {
            return TileBox::EMPTY;
        }
        TileBox {
            left: self.column(low.x) as u16,
            right: self.column(high.x) as u16,
            top: self.row(low.y) as u16,
            bottom: self.row(high.y) as u16,
        }
    }

    /// Tiles of a block, row by row, with their top left corners.
    #[inline]
    pub(crate) fn tiles_of(&self, tiles: TileBox) -> impl Iterator<Item = (usize, DVec2)> + '_ {
        (u32::from(tiles.top)..=u32::from(tiles.bottom)).flat_map(move |row| {
            (u32::from(tiles.left)..=u32::from(tiles.right))
                .map(move |column| (self.tile(column, row), self.corner(column, row)))
        })
    }

    /// Grid of about `across` tiles along the longer side of the box from `low` to `high`.
    #[must_use]
    pub(crate) fn new(low: DVec2, high: DVec2, across: u32) -> Self {
        let size = (high - low).max(DVec2::ZERO);
        let cell = (size.max_element() / f64::from(across.max(1))).max(f64::MIN_POSITIVE);
        let count = |length: f64| ((length / cell).ceil() as u32).clamp(1, across.max(1));
        Self { columns: count(size.x), rows: count(size.y), cell, origin: low, per_cell: 1.0 / cell }
    }

    /// Grid of tiles with a given side, from `low` on, that contains `high`.
    #[must_use]
    pub(crate) fn of_cells(low: DVec2, high: DVec2, cell: f64) -> Self {
        let count = |length: f64| ((length / cell) as u32).saturating_add(1);
        let size = high - low;
        Self { columns: count(size.x), rows: count(size.y), cell, origin: low, per_cell: 1.0 / cell }
    }

    /// This grid with `across` finer tiles along each side of every tile.
    #[must_use]
    pub(crate) fn refined(&self, across: u32) -> Self {
        let cell = self.cell / f64::from(across);
        let (columns, rows) = (self.columns * across, self.rows * across);
        Self { columns, rows, cell, origin: self.origin, per_cell: 1.0 / cell }
    }

    /// Grid over one tile of this one, with `across` tiles along its sides.
    #[must_use]
    pub(crate) fn of_tile(&self, tile: usize, across: u32) -> Self {
        let tile = tile as u32;
        let low = self.corner(tile % self.columns, tile / self.columns);
        let cell = self.cell / f64::from(across);
        Self { columns: across, rows: across, cell, origin: low, per_cell: 1.0 / cell }
    }

    /// Number of tiles.
    #[must_use]
    pub(crate) fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// Index of the tile in a column and row.
    #[inline]
    #[must_use]
    pub(crate) fn tile(&self, column: u32, row: u32) -> usize {
        row as usize * self.columns as usize + column as usize
    }

    /// Column that contains x, clamped to the grid.
    #[inline]
    #[must_use]
    pub(crate) fn column(&self, x: f64) -> u32 {
        (((x - self.origin.x) * self.per_cell).max(0.0) as u32).min(self.columns - 1)
    }

    /// Row that contains y, clamped to the grid.
    #[inline]
    #[must_use]
    pub(crate) fn row(&self, y: f64) -> u32 {
        (((y - self.origin.y) * self.per_cell).max(0.0) as u32).min(self.rows - 1)
    }

    /// Top left corner of a tile.
    #[inline]
    #[must_use]
    pub(crate) fn corner(&self, column: u32, row: u32) -> DVec2 {
        self.origin + DVec2::new(f64::from(column), f64::from(row)) * self.cell
    }

    /// Calls `visit(tile, t0, t1)` for the tiles along the image segment a→b, in order. The parameter ranges
    /// join without gap or overlap.
    ///
    /// Source: Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing", 1987.
    #[inline]
    pub(crate) fn walk(&self, a: DVec3, b: DVec3, mut visit: impl FnMut(usize, f64, f64)) {
        let (mut column, mut row) = (self.column(a.x), self.row(a.y));
        let (last_column, last_row) = (self.column(b.x), self.row(b.y));
        let d = b - a;
        let axis = |from: u32, to: u32, origin: f64, start: f64, delta: f64| {
            if from == to {
                return (0i64, f64::INFINITY, 0.0);
            }
            let step = if to > from { 1i64 } else { -1 };
            let border = origin + f64::from(from + u32::from(to > from)) * self.cell;
            (step, (border - start) / delta, (self.cell / delta).abs())
        };
        let (step_x, mut next_x, stride_x) = axis(column, last_column, self.origin.x, a.x, d.x);
        let (step_y, mut next_y, stride_y) = axis(row, last_row, self.origin.y, a.y, d.y);
        let mut t = 0.0;
        while (column, row) != (last_column, last_row) {
            let along_x = row == last_row || (column != last_column && next_x <= next_y);
            let end = if along_x { next_x } else { next_y }.clamp(t, 1.0);
            visit(self.tile(column, row), t, end);
            t = end;
            if along_x {
                column = (i64::from(column) + step_x) as u32;
                next_x += stride_x;
            } else {
                row = (i64::from(row) + step_y) as u32;
                next_y += stride_y;
            }
        }
        visit(self.tile(column, row), t, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> TileGrid {
        TileGrid::new(DVec2::ZERO, DVec2::new(100.0, 60.0), 10)
    }

    #[test]
    fn walk_visits_the_tiles_of_a_segment_in_order() {
        let grid = grid();
        assert_eq!((grid.columns, grid.rows), (10, 6));
        for (a, b) in [
            ((5.0, 5.0), (95.0, 55.0)),
            ((95.0, 50.0), (3.0, 7.0)),
            ((20.0, 0.0), (20.0, 60.0)),
            ((10.0, 10.0), (0.0, 0.0)),
        ] {
            let (a, b) = (DVec3::new(a.0, a.1, 0.0), DVec3::new(b.0, b.1, 0.0));
            let mut at = 0.0;
            grid.walk(a, b, |tile, t0, t1| {
                assert_eq!(t0, at);
                at = t1;
                let middle = a + (b - a) * ((t0 + t1) / 2.0);
                if t1 - t0 > 1e-9 {
                    assert_eq!(tile, grid.tile(grid.column(middle.x), grid.row(middle.y)));
                }
            });
            assert_eq!(at, 1.0);
        }
    }
}
