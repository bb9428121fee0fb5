//! [`TilePiece`]: exact integer tests for crossings and contacts of border pieces on the grid.

use super::grid_tiles::GridPoint;

/// Largest squared distance of a point that lies on a piece, grid steps squared.
const MAX_ON_PIECE_DISTANCE2: f64 = 0.5;

/// Border piece in a tile, with everything that the tests need.
pub(crate) struct TilePiece {
    ends: [GridPoint; 2],
    low: GridPoint,
    high: GridPoint,
    pub number: u32,
    /// Number of the original piece that it was cut from.
    origin: u32,
}

impl TilePiece {
    pub(crate) fn new(ends: [GridPoint; 2], number: u32, origin: u32) -> Self {
        let [a, b] = ends;
        let of = |end: fn(i64, i64) -> i64| [end(a[0], b[0]), end(a[1], b[1])];
        Self { ends, low: of(i64::min), high: of(i64::max), number, origin }
    }

    /// Whether the bounding boxes of two pieces are at most one step apart.
    #[inline]
    pub(crate) fn is_near(&self, other: &Self) -> bool {
        let apart =
            |axis: usize| (self.high[axis] + 1 < other.low[axis]) | (other.high[axis] + 1 < self.low[axis]);
        !(apart(0) | apart(1))
    }

    /// Adds the points where two pieces have to be cut.
    pub(crate) fn meet(&self, other: &Self, cuts: &mut Vec<(u32, GridPoint)>) {
        // The crossing is rounded along the piece whose original came first.
        let order = |piece: &Self| (piece.origin, piece.number);
        let [first, second] = if order(self) < order(other) { [self, other] } else { [other, self] };
        let ([i, j], [a, b], [c, d]) = ([first.number, second.number], first.ends, second.ends);
        let before = cuts.len();
        for (piece, [a, b], p) in [(i, [a, b], c), (i, [a, b], d), (j, [c, d], a), (j, [c, d], b)] {
            if lies_on(a, b, p) {
                cuts.push((piece, p));
            }
        }
        if cuts.len() > before {
            return;
        }
        let sides = [orient(a, b, c), orient(a, b, d), orient(c, d, a), orient(c, d, b)];
        if sides[0].signum() * sides[1].signum() < 0 && sides[2].signum() * sides[3].signum() < 0 {
            let t = sides[2] as f64 / (sides[2] - sides[3]) as f64;
            let at = |k: usize| a[k] + ((b[k] - a[k]) as f64 * t).round() as i64;
            let p = [at(0), at(1)];
            for (piece, [a, b]) in [(i, [a, b]), (j, [c, d])] {
                if p != a && p != b {
                    cuts.push((piece, p));
                }
            }
        }
    }
}

/// Twice the signed area of a triangle, positive if it turns from x to y.
pub(crate) fn orient(a: GridPoint, b: GridPoint, c: GridPoint) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Dot product of a piece with the vector from its start to a point.
pub(crate) fn dot(a: GridPoint, b: GridPoint, p: GridPoint) -> i64 {
    (b[0] - a[0]) * (p[0] - a[0]) + (b[1] - a[1]) * (p[1] - a[1])
}

/// Whether a point lies on a piece and is not one of its ends.
pub(crate) fn lies_on(a: GridPoint, b: GridPoint, p: GridPoint) -> bool {
    let length2 = dot(a, b, b);
    let off = orient(a, b, p) as f64;
    // Early exit, since most points are far away.
    if off * off > MAX_ON_PIECE_DISTANCE2 * length2 as f64 || p == a || p == b {
        return false;
    }
    (1..length2).contains(&dot(a, b, p))
}

/// Squared distance to the nearest point of a piece, rounded to the grid, and that point.
pub(crate) fn foot(a: GridPoint, b: GridPoint, p: GridPoint) -> (f64, GridPoint) {
    let t = (dot(a, b, p) as f64 / (dot(a, b, b) as f64).max(1.0)).clamp(0.0, 1.0);
    let at = |k: usize| a[k] + ((b[k] - a[k]) as f64 * t).round() as i64;
    let foot = [at(0), at(1)];
    let (x, y) = ((foot[0] - p[0]) as f64, (foot[1] - p[1]) as f64);
    (x * x + y * y, foot)
}

/// Squared distance from a point to the bounding box of a piece.
pub(crate) fn box_distance2(a: GridPoint, b: GridPoint, p: GridPoint) -> f64 {
    let gap = |k: usize| (a[k].min(b[k]) - p[k]).max(p[k] - a[k].max(b[k])).max(0) as f64;
    gap(0) * gap(0) + gap(1) * gap(1)
}
