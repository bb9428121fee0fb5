//! [`PlanarGrid`]: square cells over a box of the plane, for lookup by position.
//!
//! Cells are numbered row by row. The grid holds no items: its users keep a list for each cell.

use std::ops::Range;

use kurbo::{Point, Rect, Vec2};

use crate::geometry::tolerances::CELL_MARGIN;

/// Square cells over a box.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PlanarGrid {
    low: Vec2,
    cells_per_unit: f64,
    /// Columns and rows; 0 in the default grid, which has no cells.
    across: [usize; 2],
}

impl PlanarGrid {
    /// A grid over a box. Its cells have a side of 1 / `cells_per_unit`.
    pub(crate) fn new(bounds: Rect, cells_per_unit: f64) -> Self {
        let across = [bounds.width(), bounds.height()].map(|size| (size * cells_per_unit) as usize + 1);
        Self { low: bounds.origin().to_vec2(), cells_per_unit, across }
    }

    /// Number of cells.
    pub(crate) fn count(&self) -> usize {
        self.across[0] * self.across[1]
    }

    /// Position in cells, from the first corner of the grid.
    pub(crate) fn place(&self, p: Point) -> Vec2 {
        (p.to_vec2() - self.low) * self.cells_per_unit
    }

    /// Column and row of the cell at a point. Outside the grid, those of the nearest cell.
    pub(crate) fn cell(&self, p: Point) -> [usize; 2] {
        let at = self.place(p);
        [(at.x, self.across[0]), (at.y, self.across[1])]
            .map(|(x, count)| (x.max(0.0) as usize).min(count.saturating_sub(1)))
    }

    /// Whether a point lies in one of the cells.
    pub(crate) fn holds(&self, p: Point) -> bool {
        let at = self.place(p);
        at.x >= 0.0 && at.y >= 0.0 && at.x < self.across[0] as f64 && at.y < self.across[1] as f64
    }

    /// Number of the cell in a column and row.
    pub(crate) fn number(&self, [column, row]: [usize; 2]) -> usize {
        row * self.across[0] + column
    }

    /// Cells that a box overlaps: a range of numbers for each row.
    pub(crate) fn rows_in(&self, bounds: Rect) -> impl Iterator<Item = Range<usize>> + use<> {
        let (low, high) = (self.place(bounds.origin()), self.place(Point::new(bounds.x1, bounds.y1)));
        let range = |low: f64, high: f64, count: usize| {
            let end = if high < 0.0 { 0 } else { (high as usize).saturating_add(1).min(count) };
            (low.max(0.0) as usize).min(end)..end
        };
        let (columns, rows) = (range(low.x, high.x, self.across[0]), range(low.y, high.y, self.across[1]));
        let stride = self.across[0];
        rows.map(move |row| row * stride + columns.start..row * stride + columns.end)
    }

    /// Calls `visit` for the cells that a segment passes.
    pub(crate) fn visit_passed(&self, from: Point, to: Point, mut visit: impl FnMut(usize)) {
        let (mut a, mut b) = (self.place(from), self.place(to));
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
            let (x0, x1) = (x0.min(x1) - CELL_MARGIN, x0.max(x1) + CELL_MARGIN);
            if x1 < 0.0 || x0 >= columns as f64 {
                continue;
            }
            for column in x0.max(0.0) as usize..=(x1 as usize).min(columns - 1) {
                visit(row * columns + column);
            }
        }
    }

    /// Number of rings that cover the grid around any of its cells.
    pub(crate) fn ring_count(&self) -> usize {
        self.across[0].max(self.across[1])
    }

    /// Cells of a ring around a cell, row by row. Ring 0 is the cell itself.
    pub(crate) fn ring(&self, [column, row]: [usize; 2], ring: usize) -> impl Iterator<Item = usize> + use<> {
        let [columns, rows] = self.across;
        (row.saturating_sub(ring)..(row + ring + 1).min(rows)).flat_map(move |y| {
            let step = if y.abs_diff(row) == ring { 1 } else { 2 * ring };
            let across = (column..=column + 2 * ring).step_by(step).filter_map(move |x| x.checked_sub(ring));
            across.filter(move |x| *x < columns).map(move |x| y * columns + x)
        })
    }

    /// Distance from a point of the middle cell within which nothing lies in a ring or outside it.
    pub(crate) fn ring_distance(&self, ring: usize) -> f64 {
        ring.saturating_sub(1) as f64 / self.cells_per_unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_and_rows_of_a_grid_cover_each_cell_once() {
        let grid = PlanarGrid::new(Rect::new(2.0, 3.0, 8.5, 7.5), 1.0);
        assert_eq!(grid.count(), 7 * 5);
        for p in [(2.0, 3.0), (4.2, 6.9), (9.0, 1.0)].map(Point::from) {
            let rings = (0..=grid.ring_count()).flat_map(|ring| grid.ring(grid.cell(p), ring));
            let mut cells: Vec<usize> = rings.collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..35).collect::<Vec<_>>());
        }
        let all: Vec<usize> = grid.rows_in(Rect::new(-9.0, -9.0, 99.0, 99.0)).flatten().collect();
        assert_eq!(all, (0..35).collect::<Vec<_>>());
        assert_eq!(grid.rows_in(Rect::new(-9.0, 4.0, 1.0, 5.0)).flatten().count(), 0);
        let mut passed = Vec::new();
        grid.visit_passed(Point::new(2.5, 3.5), Point::new(4.5, 4.5), |cell| passed.push(cell));
        assert!([0, 1, 8, 9].iter().all(|cell| passed.contains(cell)) && passed.len() <= 5, "{passed:?}");
    }
}
