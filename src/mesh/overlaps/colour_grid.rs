//! [`faces_near_other_colours`]: faces near faces of another colour, by a coarse grid over the mesh.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::{FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Number of grid cells on each axis.
const CELLS_PER_AXIS: usize = 64;

/// Limit on the number of cells that all faces touch: per face on average, and a minimum. Above it, every
/// face counts as near.
const MAX_CELLS_PER_FACE: usize = 64;
const MIN_CELL_BUDGET: usize = 1 << 22;

/// Contents of a cell with no colour, and with several.
const NO_COLOUR: u32 = u32::MAX;
const SEVERAL_COLOURS: u32 = u32::MAX - 1;

/// For each face, whether a face of another colour touches one of its cells. `colour` returns a number for
/// each face, from 0.
pub(crate) fn faces_near_other_colours(mesh: &Mesh, colour: impl Fn(u32) -> u32) -> Vec<bool> {
    let count = mesh.triangles.len();
    let half = DVec3::splat(mesh.extents.diagonal / 2.0).max(DVec3::splat(f64::MIN_POSITIVE));
    let low = mesh.extents.middle - half;
    let per_unit = CELLS_PER_AXIS as f64 / (2.0 * half);
    let range = |face: u32| {
        let [a, b, c] = mesh.corners(FaceId(face));
        let contact = mesh.extent(FaceId(face)).contact;
        let cell = |p: DVec3| {
            ((p - low) * per_unit).to_array().map(|x| (x.max(0.0) as usize).min(CELLS_PER_AXIS - 1))
        };
        (cell(a.min(b).min(c) - contact), cell(a.max(b).max(c) + contact))
    };
    let cells = |face: u32| {
        let ([x0, y0, z0], [x1, y1, z1]) = range(face);
        let rows =
            (z0..=z1).flat_map(move |z| (y0..=y1).map(move |y| (z * CELLS_PER_AXIS + y) * CELLS_PER_AXIS));
        rows.flat_map(move |row| row + x0..=row + x1)
    };
    let mut left = MIN_CELL_BUDGET.max(MAX_CELLS_PER_FACE * count);
    let mut found = vec![NO_COLOUR; CELLS_PER_AXIS * CELLS_PER_AXIS * CELLS_PER_AXIS];
    for face in 0..count as u32 {
        let own = colour(face);
        for cell in cells(face) {
            let there = &mut found[cell];
            *there = if *there == NO_COLOUR || *there == own { own } else { SEVERAL_COLOURS };
            left = left.saturating_sub(1);
        }
        if left == 0 {
            return vec![true; count];
        }
    }
    let faces = (0..count as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    faces.map(|face| cells(face).any(|cell| found[cell] == SEVERAL_COLOURS)).collect()
}
