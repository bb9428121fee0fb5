//! Flat faces: which lattice points lie on wide flat faces. Stroke directions of their neighbours do not
//! apply there.
//!
//! 1. Connected points of one facet with nearly equal normals form a patch.
//! 2. A patch is wide if some point is at least three points away from everything else.
//! 3. Patches that continue each other without an edge are slightly curved, and thus not flat.

use glam::DVec3;

use super::page_lattice::LightLattice;
use crate::regions::tolerances;

/// Largest difference between normals on a flat face and the normal of its first point. It excludes gently
/// curved faces.
const MAX_FACE_NORMAL_DISTANCE: f64 = 0.01;

/// Minimum distance, in lattice points, from the innermost point of a wide face to its border.
const MIN_DEPTH_POINTS: u16 = 3;

/// Whether each lattice point lies on a wide flat face. `normals` are not smoothed, and zero where no surface
/// is seen.
pub(crate) fn flat_points(samples: &LightLattice, normals: &[DVec3]) -> Vec<bool> {
    let (patches, count) = patches(samples, normals);
    let depths = depths(samples, &patches);
    let mut is_flat = vec![false; count as usize + 1];
    for (patch, depth) in patches.iter().zip(&depths) {
        is_flat[*patch as usize] |= *patch != 0 && *depth >= MIN_DEPTH_POINTS;
    }
    // Patches that continue each other without an edge are slightly curved.
    for k in 0..patches.len() {
        let beside =
            [(k % samples.columns + 1 < samples.columns).then_some(k + 1), Some(k + samples.columns)];
        for next in beside.into_iter().flatten().filter(|next| *next < patches.len()) {
            let goes_on = samples.facets[next] == samples.facets[k]
                && near(normals, k, next, tolerances::MAX_NEIGHBOUR_NORMAL_DISTANCE);
            if goes_on && patches[next] != patches[k] {
                is_flat[patches[k] as usize] = false;
                is_flat[patches[next] as usize] = false;
            }
        }
    }
    patches.iter().map(|patch| is_flat[*patch as usize]).collect()
}

/// Whether two normals differ by less than `far`.
fn near(normals: &[DVec3], a: usize, b: usize, far: f64) -> bool {
    (normals[a] - normals[b]).length_squared() < far * far
}

/// Patch of each point, from 1 (0 where no surface is seen), and the number of patches.
fn patches(samples: &LightLattice, normals: &[DVec3]) -> (Vec<u32>, u32) {
    let (columns, rows) = (samples.columns, samples.rows);
    let mut patches = vec![0; normals.len()];
    let mut count = 0;
    let mut open = Vec::new();
    for first in 0..normals.len() {
        if patches[first] != 0 || samples.facets[first] == 0 || normals[first] == DVec3::ZERO {
            continue;
        }
        count += 1;
        patches[first] = count;
        open.push(first);
        while let Some(k) = open.pop() {
            let (column, row) = (k % columns, k / columns);
            let beside = [
                (column > 0).then(|| k - 1),
                (column + 1 < columns).then_some(k + 1),
                (row > 0).then(|| k - columns),
                (row + 1 < rows).then_some(k + columns),
            ];
            for next in beside.into_iter().flatten() {
                if patches[next] == 0
                    && samples.facets[next] == samples.facets[first]
                    && near(normals, k, next, tolerances::MAX_NEIGHBOUR_NORMAL_DISTANCE)
                    && near(normals, first, next, MAX_FACE_NORMAL_DISTANCE)
                {
                    patches[next] = count;
                    open.push(next);
                }
            }
        }
    }
    (patches, count)
}

/// Distance from each point to the next one outside its patch, in lattice points, with diagonal steps counted
/// as one.
fn depths(samples: &LightLattice, patches: &[u32]) -> Vec<u16> {
    let (columns, rows) = (samples.columns, samples.rows);
    let mut depths = vec![u16::MAX; patches.len()];
    let mut pass = |order: &mut dyn Iterator<Item = usize>, back: isize| {
        for k in order {
            let (column, row) = ((k % columns) as isize, (k / columns) as isize);
            let mut least = depths[k];
            for (right, down) in [(-1, 0), (-1, -1), (0, -1), (1, -1)] {
                let (x, y) = (column + right * back, row + down * back);
                if x < 0 || y < 0 || x >= columns as isize || y >= rows as isize {
                    least = 1;
                    continue;
                }
                let next = y as usize * columns + x as usize;
                least =
                    least.min(if patches[next] == patches[k] { depths[next].saturating_add(1) } else { 1 });
            }
            depths[k] = least;
        }
    };
    pass(&mut (0..patches.len()), 1);
    pass(&mut (0..patches.len()).rev(), -1);
    depths
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flat points of a page with one facet and the given normals.
    fn flat_points_of_page(columns: usize, rows: usize, normal: impl Fn(usize, usize) -> DVec3) -> Vec<bool> {
        let count = columns * rows;
        let samples = LightLattice { columns, rows, facets: vec![1; count], ..LightLattice::default() };
        let normals: Vec<DVec3> = (0..count).map(|k| normal(k % columns, k / columns)).collect();
        flat_points(&samples, &normals)
    }

    #[test]
    fn flat_points_reach_the_edge_between_two_walls() {
        let slanted = DVec3::new(0.0, 0.3, 1.0).normalize();
        let found = flat_points_of_page(20, 20, |_, row| if row < 10 { DVec3::Z } else { slanted });
        assert!(found.iter().all(|flat| *flat));
    }

    #[test]
    fn bent_and_narrow_surfaces_have_no_flat_points() {
        let along = |angle: f64| DVec3::new(angle, 0.0, 1.0).normalize();
        assert!(!flat_points_of_page(20, 20, |column, _| along(0.02 * column as f64)).contains(&true));
        // A bend too gentle to detect between neighbours.
        assert!(!flat_points_of_page(60, 20, |column, _| along(0.0008 * column as f64)).contains(&true));
        // Strips of a tessellated cylinder.
        assert!(!flat_points_of_page(40, 40, |column, _| along(0.1 * (column / 4) as f64)).contains(&true));
    }
}
