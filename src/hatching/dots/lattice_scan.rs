//! [`LatticeScan`]: the cells that the rows of a rotated lattice pass through.
//!
//! Each row is intersected with the border pieces that cross it. The cost of finding the cells of all lattice
//! points therefore depends on the borders, not on the number of points.

use crate::parallel::prelude::*;
use kurbo::{Point, Vec2};

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::hatching::tolerances;
use crate::regions::HatchRegions;
use crate::regions::hatch_regions::border_piece::PAPER;

/// Square lattice, rotated and placed on the page.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lattice {
    pub origin: Point,
    /// Unit vector along the rows. Columns run a quarter turn from it, from x to y.
    along: Vec2,
    /// Distance between neighbouring points, user units.
    pub step: f64,
}

impl Lattice {
    /// A lattice whose rows run at `angle` radians from the x axis, turning from x to y.
    pub(crate) fn new(origin: Point, angle: f64, step: f64) -> Self {
        Self { origin, along: Vec2::new(cos(angle), sin(angle)), step }
    }

    /// Lattice coordinates of a page point, in steps along rows and columns.
    pub(crate) fn place(&self, p: Point) -> Point {
        let from = p - self.origin;
        Point::new(self.along.dot(from) / self.step, self.along.cross(from) / self.step)
    }

    /// The page point at lattice coordinates.
    pub(crate) fn point(&self, x: f64, y: f64) -> Point {
        let across = Vec2::new(-self.along.y, self.along.x);
        self.origin + (self.along * x + across * y) * self.step
    }
}

/// Crossing of a row from one cell into the next.
#[derive(Debug, Clone, Copy)]
struct RowCrossing {
    x: f64,
    /// Change of x with y. It orders crossings at the same position.
    slope: f64,
    before: u32,
    after: u32,
}

/// The rows of a lattice, and the cells that they pass through.
#[derive(Debug, Clone, Default)]
pub(crate) struct LatticeScan {
    /// Number of the first row.
    pub first: i64,
    crossings: CsrLists<RowCrossing>,
}

impl LatticeScan {
    /// Scans a ground along the rows of a lattice.
    pub(crate) fn new(ground: &HatchRegions, grid: &Lattice) -> Self {
        let placed: Vec<[Point; 2]> = ground
            .pieces
            .par_iter()
            .with_min_len(256)
            .map(|piece| piece.ends.map(|p| grid.place(p)))
            .collect();
        let heights = || placed.iter().flatten().map(|p| p.y);
        let low = heights().fold(f64::INFINITY, f64::min).ceil();
        let high = heights().fold(f64::NEG_INFINITY, f64::max).floor();
        if !(low <= high && high - low < MAX_ROWS) {
            return Self::default();
        }
        let first = low as i64;
        // A row meets a piece from its lower end up to, but not including, its upper end.
        let rows = |[a, b]: [Point; 2]| {
            let (low, high) = (a.y.min(b.y).ceil() as i64, a.y.max(b.y).ceil() as i64);
            (low - first) as usize..(high - first) as usize
        };
        let mut crossings = csr_lists((high as i64 - first) as usize + 1, |put| {
            for (piece, ends) in ground.pieces.iter().zip(&placed) {
                // A piece that runs towards greater y has its first side at smaller x.
                let [a, b] = *ends;
                let (low, high, [before, after]) =
                    if a.y < b.y { (a, b, piece.sides) } else { (b, a, [piece.sides[1], piece.sides[0]]) };
                let slope = (high.x - low.x) / (high.y - low.y);
                for row in rows(*ends) {
                    let y = (first + row as i64) as f64;
                    put(row, RowCrossing { x: low.x + (y - low.y) * slope, slope, before, after });
                }
            }
        });
        for row in 0..crossings.count() {
            order(crossings.of_mut(row));
        }
        Self { first, crossings }
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.crossings.count()
    }

    /// The stretches of a row in cells other than paper: start, end and cell.
    pub(crate) fn stretches(&self, row: usize) -> impl Iterator<Item = (f64, f64, u32)> + '_ {
        let own = self.crossings.of(row);
        let pairs = own.windows(2).map(|pair| (pair[0].x, pair[1].x, pair[0].after));
        pairs.filter(|(from, to, cell)| *cell != PAPER && from < to)
    }
}

/// Sorts the crossings of a row. Where rounding leaves the order ambiguous, matching cells decide it.
fn order(row: &mut [RowCrossing]) {
    row.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.slope.total_cmp(&b.slope)).then(a.after.cmp(&b.after)));
    let mut cell = PAPER;
    for k in 0..row.len() {
        if row[k].before != cell {
            let near = |c: &RowCrossing| c.x - row[k].x < tolerances::CROSSING_MERGE_OF_STEP;
            let fits = row[k..].iter().take_while(|c| near(c)).position(|c| c.before == cell);
            if let Some(ahead) = fits {
                row[k..=k + ahead].rotate_right(1);
            }
        }
        cell = row[k].after;
    }
}

/// Greatest number of rows. A finer lattice gives an empty scan.
const MAX_ROWS: f64 = 65_536.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};
    use crate::mesh::{MaterialId, PaintId, PartId};
    use crate::regions::SurfaceLabel;
    use crate::regions::hatch_regions::border_piece::BorderPiece;
    use crate::regions::hatch_regions::hatch_map::HatchCell;

    const CELL: HatchCell = HatchCell {
        look: SurfaceLabel {
            part: PartId(0),
            material: MaterialId(0),
            paint: PaintId(0),
            tone: 0,
            bin: 0,
            cast: false,
        },
        facet: 1,
        area: 1.0,
    };

    /// Sectors around a point: cell k lies between corners k - 1 and k, with paper outside.
    fn sectors(corners: u64) -> HatchRegions {
        let middle = Point::new(50.0, 40.0);
        let corner = |k: u64| {
            let angle = std::f64::consts::TAU * (k % corners) as f64 / corners as f64;
            let far = 10.0 + 25.0 * unit_interval(hash(corners, &[k % corners]));
            middle + Vec2::new(cos(angle), sin(angle)) * far
        };
        let cell = |k: u64| ((k + corners - 1) % corners + 1) as u32;
        let pieces = (1..=corners).flat_map(|k| {
            let spoke = BorderPiece {
                ends: [middle, corner(k)],
                sides: [cell(k + 1), cell(k)],
                parts_surfaces: true,
            };
            let rim = BorderPiece {
                ends: [corner(k - 1), corner(k)],
                sides: [cell(k), PAPER],
                parts_surfaces: true,
            };
            [spoke, rim]
        });
        HatchRegions::of_pieces(vec![CELL; corners as usize + 1], pieces.collect())
    }

    #[test]
    fn lattice_rows_pass_through_the_cells_of_their_points() {
        for corners in [3, 5, 12, 80] {
            let ground = sectors(corners);
            for (angle, step) in [(0.0, 1.0), (0.7, 0.31), (-2.0, 2.5)] {
                // Rows of the first lattice pass exactly through the centre.
                let grid = Lattice::new(Point::new(0.0, 0.0), angle, step);
                let scan = LatticeScan::new(&ground, &grid);
                let mut inside = 0;
                for row in 0..scan.rows() {
                    let y = (scan.first + row as i64) as f64;
                    for (from, to, cell) in scan.stretches(row).filter(|(from, to, _)| to - from > 1e-3) {
                        for part in [0.01, 0.5, 0.99] {
                            let p = grid.point(from + (to - from) * part, y);
                            assert_eq!(ground.cell_at(p), cell, "{corners} {angle} {p:?}");
                            inside += 1;
                        }
                    }
                }
                assert!(inside > 20);
            }
        }
    }
}
