//! [`Sides`]: the three sides of a triangle in the image, and which squares of a grid lie inside them.

use glam::{DVec2, DVec3};

use super::grid::{Grid, TileBox};

/// The three sides of a projected triangle as inward half planes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides([Side; 3]);

/// An inward half plane n·x + d > 0, solved for x.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// -1 where x is to be greater, 1 where it is to be less, 0 where n has no x.
    way: f64,
    /// x at y = 0 and how it grows with y; or d and the y of n.
    at: f64,
    along: f64,
    /// By how much x changes where a square that has its centre there is to be a length further inside, for each of its length.
    aside: f64,
}

impl Side {
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

impl Sides {
    pub(super) fn new(points: &[DVec3; 3]) -> Self {
        let [a, b, c] = points.map(DVec3::truncate);
        let sign = (b - a).perp_dot(c - a).signum();
        let side = |p: DVec2, q: DVec2| {
            let normal = (q - p).perp() * sign;
            Side::new(normal, -normal.dot(p))
        };
        Self([side(a, b), side(b, c), side(c, a)])
    }

    /// The columns of a row of tiles whose squares lie wholly inside all sides (`reach` is minus
    /// half a tile) or not wholly outside one (`reach` is half a tile or more).
    ///
    /// A square with half side h and centre c lies wholly inside a side n·x + d > 0 if
    /// n·c + d > h (|nx| + |ny|): solved for the x of the centre, row by row.
    #[inline]
    pub(super) fn columns(&self, grid: &Grid, tiles: TileBox, row: u16, reach: f64) -> std::ops::Range<u32> {
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
        // Rounding may not add a tile that is not filled, nor lose one that is met.
        let margin = if reach < 0.0 { 1e-6 } else { -1e-6 };
        let per_cell = 1.0 / grid.cell;
        let (left, right) = (f64::from(tiles.left), f64::from(tiles.right));
        let from = ((low - corner.x) * per_cell - 0.5 + margin).max(left);
        let to = ((high - corner.x) * per_cell - 0.5 - margin).min(right);
        if from > right || to < left {
            return 0..0;
        }
        // Between the bounds of the box, which are no less than 0, whole numbers are found by cutting off.
        let (first, last) = (from as u32, to as u32);
        let first = first + u32::from(f64::from(first) < from);
        first..(last + 1).max(first)
    }
}
