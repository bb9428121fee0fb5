//! [`Sides`]: the three sides of a triangle in the image, and which squares of a grid lie inside them.

use glam::{DVec2, DVec3};

use super::grid::{Grid, TileBox};

/// The three sides of a projected triangle as inward half planes: positive inside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    normals: [DVec2; 3],
    offsets: [f64; 3],
}

impl Sides {
    pub(super) fn new(points: &[DVec3; 3]) -> Self {
        let [a, b, c] = points.map(DVec3::truncate);
        let sign = (b - a).perp_dot(c - a).signum();
        let normal = |p: DVec2, q: DVec2| (q - p).perp() * sign;
        let normals = [normal(a, b), normal(b, c), normal(c, a)];
        Self { normals, offsets: [-normals[0].dot(a), -normals[1].dot(b), -normals[2].dot(c)] }
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
        for (n, d) in self.normals.iter().zip(self.offsets) {
            let rest = n.y * y + d + reach * (n.x.abs() + n.y.abs());
            if n.x > 0.0 {
                low = low.max(-rest / n.x);
            } else if n.x < 0.0 {
                high = high.min(-rest / n.x);
            } else if rest < 0.0 {
                return 0..0;
            }
        }
        // Rounding may not add a tile that is not filled, nor lose one that is met.
        let margin = if reach < 0.0 { 1e-6 } else { -1e-6 };
        let first = ((low - corner.x) / grid.cell - 0.5 + margin).ceil().max(f64::from(tiles.left));
        let last = ((high - corner.x) / grid.cell - 0.5 - margin).floor().min(f64::from(tiles.right));
        if first <= last { first as u32..last as u32 + 1 } else { 0..0 }
    }
}
