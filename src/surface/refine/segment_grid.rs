//! `faces_near_segments`: faces near some short segments, by a bit grid, so that a few rays need no tree over the
//! whole mesh.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::Mesh;
use crate::mesh::tolerances;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Number of cells on each axis of the grid, equal to the bits of a word.
const CELLS_PER_AXIS: usize = 64;

/// Maximum number of grid rows that a segment or face is compared with. Above it, a face counts as near.
const MAX_ROWS: usize = 256;

/// The faces that any of the segments may meet, ascending. May contain others.
pub(crate) fn faces_near_segments(mesh: &Mesh, segments: &[[DVec3; 2]]) -> Vec<u32> {
    let (middle, radius) = mesh.extents.ball();
    // Exceeds all rounding errors.
    let slack = tolerances::RAY_BOX_OF_MESH * (radius + middle.length());
    let faces = 0..mesh.triangles.len() as u32;
    let Some(grid) = SegmentBitGrid::around(segments, slack) else { return faces.collect() };
    let places: Vec<PointCell> =
        mesh.positions.par_iter().with_min_len(MIN_TASK_ITEMS).map(|p| grid.place(*p)).collect();
    let is_near = |face: &u32| {
        let [a, b, c] = mesh.triangles[*face as usize];
        grid.holds(places[a as usize], places[b as usize], places[c as usize])
    };
    faces.into_par_iter().with_min_len(MIN_TASK_ITEMS).filter(is_near).collect()
}

/// Position of a point in a grid.
#[derive(Debug, Clone, Copy)]
struct PointCell {
    cell: [u8; 3],
    /// One bit for each side of the grid that the point lies outside.
    beyond: u8,
}

/// Grid with the cells touched by the boxes of some segments.
struct SegmentBitGrid {
    low: DVec3,
    high: DVec3,
    cells_per_unit: DVec3,
    /// One word per row along x.
    rows: Vec<u64>,
}

impl SegmentBitGrid {
    /// Builds the grid; `None` if a segment touches too many rows.
    fn around(segments: &[[DVec3; 2]], slack: f64) -> Option<Self> {
        let boxes = segments.iter().map(|[a, b]| (a.min(*b) - slack, a.max(*b) + slack));
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = boxes.clone().fold(nothing, |all, own| (all.0.min(own.0), all.1.max(own.1)));
        let cells_per_unit = CELLS_PER_AXIS as f64 / (high - low).max(DVec3::splat(f64::MIN_POSITIVE));
        let mut grid = Self { low, high, cells_per_unit, rows: vec![0; CELLS_PER_AXIS * CELLS_PER_AXIS] };
        for (low, high) in boxes {
            let (first, last) = (grid.cell(low), grid.cell(high));
            if rows(first, last) > MAX_ROWS {
                return None;
            }
            for (y, z) in (first[1]..=last[1]).flat_map(|y| (first[2]..=last[2]).map(move |z| (y, z))) {
                grid.rows[z * CELLS_PER_AXIS + y] |= bits(first[0], last[0]);
            }
        }
        Some(grid)
    }

    fn cell(&self, p: DVec3) -> [usize; 3] {
        // Points outside are clamped to the outermost cells.
        ((p - self.low) * self.cells_per_unit).to_array().map(|x| (x as usize).min(CELLS_PER_AXIS - 1))
    }

    #[inline]
    fn place(&self, p: DVec3) -> PointCell {
        let [x, y, z] = self.cell(p);
        let (below, above) = (p.cmplt(self.low).bitmask(), p.cmpgt(self.high).bitmask());
        PointCell { cell: [x as u8, y as u8, z as u8], beyond: (below | above << 3) as u8 }
    }

    /// Whether the box around three points may touch one of the segments.
    #[inline]
    fn holds(&self, a: PointCell, b: PointCell, c: PointCell) -> bool {
        if a.beyond & b.beyond & c.beyond != 0 {
            return false;
        }
        let (mut first, mut last) = ([0; 3], [0; 3]);
        for axis in 0..3 {
            let [a, b, c] = [a.cell[axis], b.cell[axis], c.cell[axis]];
            (first[axis], last[axis]) = (usize::from(a.min(b).min(c)), usize::from(a.max(b).max(c)));
        }
        rows(first, last) > MAX_ROWS
            || (first[2]..=last[2]).any(|z| {
                (first[1]..=last[1]).any(|y| self.rows[z * CELLS_PER_AXIS + y] & bits(first[0], last[0]) != 0)
            })
    }
}

fn rows(first: [usize; 3], last: [usize; 3]) -> usize {
    (last[1] - first[1] + 1) * (last[2] - first[2] + 1)
}

/// One bit for each cell from `first` to `last` of a row.
fn bits(first: usize, last: usize) -> u64 {
    (u64::MAX >> (CELLS_PER_AXIS - 1 - (last - first))) << first
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{FaceId, Soup};

    #[test]
    fn faces_near_segments_includes_every_touched_face() {
        // A plane of unit squares, with segments that cross it, lie in it, or end before it.
        let n = 100;
        let mut soup = Soup::default();
        for k in 0..n * n {
            let (x, y) = (f64::from(k % n), f64::from(k / n));
            let first = soup.positions.len() as u32;
            soup.positions
                .extend([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(u, v)| DVec3::new(x + u, y + v, 0.0)));
            soup.triangles.push([first, first + 1, first + 2]);
        }
        let mesh = Mesh::build(soup);
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z) - mesh.origin;
        let segments = [
            [at(3.2, 3.3, -1.0), at(3.2, 3.3, 1.0)],
            [at(50.1, 70.1, 0.0), at(54.3, 70.1, 0.0)],
            [at(90.1, 10.1, 0.5), at(90.1, 10.1, 3.0)],
        ];
        let near = faces_near_segments(&mesh, &segments);
        let middles: Vec<DVec3> = near
            .iter()
            .map(|face| mesh.corners(FaceId(*face)).iter().sum::<DVec3>() / 3.0 + mesh.origin)
            .collect();
        let is_near = |x: f64, y: f64| middles.iter().any(|p| (p.x - x).abs() < 0.5 && (p.y - y).abs() < 0.5);
        assert!(is_near(3.3, 3.3) && (0..5).all(|k| is_near(50.3 + f64::from(k), 70.3)));
        assert!(near.windows(2).all(|pair| pair[0] < pair[1]) && near.len() < 100, "{}", near.len());
    }
}
