//! [`TriangleHalfPlanes`]: the sides of a triangle in the image as half planes, and the squares of a grid row inside them.

use glam::{DVec2, DVec3};

use super::tile_grid::{TileBox, TileGrid};
use crate::visibility::tolerances;

/// The three sides of a projected triangle as inward half planes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TriangleHalfPlanes([SideHalfPlane; 3]);

/// Inward half plane n·x + d > 0, solved for x.
#[derive(Debug, Clone, Copy)]
struct SideHalfPlane {
    /// −1 if x must be greater, 1 if it must be less, 0 if n has no x component.
    way: f64,
    /// x at y = 0 and its growth with y. Without x component of n: d and the y component.
    at: f64,
    along: f64,
    /// Change in x of a square's centre per unit of length that the square must be farther inside.
    aside: f64,
}

impl SideHalfPlane {
    fn new(n: DVec2, d: f64) -> Self {
        let aside = n.x.abs() + n.y.abs();
        let solved = Self { way: -n.x.signum(), at: -d / n.x, along: -n.y / n.x, aside: aside / n.x };
        if n.x != 0.0 && solved.at.is_finite() && solved.along.is_finite() {
            solved
        } else {
            Self { way: 0.0, at: d, along: n.y, aside }
        }
    }
}

impl TriangleHalfPlanes {
    pub(crate) fn new(points: &[DVec3; 3]) -> Self {
        let [a, b, c] = points.map(DVec3::truncate);
        let sign = (b - a).perp_dot(c - a).signum();
        let side = |p: DVec2, q: DVec2| {
            let normal = (q - p).perp() * sign;
            SideHalfPlane::new(normal, -normal.dot(p))
        };
        Self([side(a, b), side(b, c), side(c, a)])
    }

    /// Columns of a grid row whose squares are entirely inside all sides (`reach` is minus half a tile), or
    /// not entirely outside one (`reach` is half a tile or more).
    ///
    /// A square with half side h and centre c is entirely inside a side n·x + d > 0 if n·c + d > h (|nx| +
    /// |ny|). This is solved for the x of the centre, row by row.
    #[inline]
    pub(crate) fn columns(
        &self,
        grid: &TileGrid,
        tiles: TileBox,
        row: u16,
        reach: f64,
    ) -> std::ops::Range<u32> {
        let corner = grid.corner(0, u32::from(row));
        let y = corner.y + grid.cell / 2.0;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for side in &self.0 {
            let x = side.at + side.along * y - reach * side.aside;
            if side.way < 0.0 {
                low = low.max(x);
            } else if side.way > 0.0 {
                high = high.min(x);
            } else if side.at + side.along * y + reach * side.aside < 0.0 {
                return 0..0;
            }
        }
        // Rounding must not add a tile that is not filled, nor lose one that is met.
        let margin =
            if reach < 0.0 { tolerances::COLUMN_ROUNDING_TILES } else { -tolerances::COLUMN_ROUNDING_TILES };
        let per_cell = 1.0 / grid.cell;
        let (left, right) = (f64::from(tiles.left), f64::from(tiles.right));
        let from = ((low - corner.x) * per_cell - 0.5 + margin).max(left);
        let to = ((high - corner.x) * per_cell - 0.5 - margin).min(right);
        if from > right || to < left {
            return 0..0;
        }
        // The bounds are not negative, so truncation finds whole numbers.
        let (first, last) = (from as u32, to as u32);
        let first = first + u32::from(f64::from(first) < from);
        first..(last + 1).max(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    #[test]
    fn triangle_columns_match_a_test_of_each_tile() {
        let mut dice = Dice::new(3);
        let grid = TileGrid::new(DVec2::ZERO, DVec2::splat(64.0), 64);
        let (mut filled, mut met) = (0, 0);
        for _ in 0..300 {
            let points = [0; 3].map(|_| dice.point(40.0) + DVec3::splat(32.0));
            let sides = TriangleHalfPlanes::new(&points);
            let [a, b, c] = points.map(DVec3::truncate);
            let orientation = (b - a).perp_dot(c - a).signum();
            // Smallest distance of a point from the sides, positive inside.
            let inside = |p: DVec2| {
                let of_side = |q: DVec2, r: DVec2| (r - q).normalize().perp_dot(p - q) * orientation;
                of_side(a, b).min(of_side(b, c)).min(of_side(c, a))
            };
            let low = points[0].min(points[1]).min(points[2]);
            let high = points[0].max(points[1]).max(points[2]);
            let tiles = grid.tile_box(low, high);
            if tiles.is_empty() {
                continue;
            }
            for row in tiles.top..=tiles.bottom {
                let [full, some] =
                    [-0.5, 0.5].map(|reach| sides.columns(&grid, tiles, row, reach * grid.cell));
                for column in u32::from(tiles.left)..=u32::from(tiles.right) {
                    let corner = grid.corner(column, u32::from(row));
                    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
                    let depth = corners
                        .map(|(x, y)| inside(corner + DVec2::new(x, y) * grid.cell))
                        .into_iter()
                        .fold(f64::INFINITY, f64::min);
                    // In between, rounding decides.
                    assert!(depth < 1e-4 || full.contains(&column), "{points:?} at {row}, {column}");
                    assert!(depth > -1e-4 || !full.contains(&column), "{points:?} at {row}, {column}");
                    let middle = inside(corner + grid.cell / 2.0);
                    assert!(middle < 0.0 || some.contains(&column), "{points:?} at {row}, {column}");
                    filled += usize::from(full.contains(&column));
                    met += usize::from(some.contains(&column));
                }
            }
        }
        assert!(filled > 10_000 && met > filled + 5_000, "{filled} of {met}");
    }
}
