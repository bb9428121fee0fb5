//! Label of each triangle. All triangles of a cell share one label, unless the cell's border has a gap.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use crate::geometry::lists::csr_lists::csr_lists_from_pairs;
use crate::regions::cells::triangulation::{OUTSIDE, Triangulation};

/// Cells per task.
const CELLS_PER_TASK: usize = 1 << 8;

/// Labels of the triangles of a cell.
enum CellLabels {
    /// One label for all.
    Uniform(u32),
    /// One label per triangle, because the border has a gap.
    PerTriangle(Vec<u32>),
}

/// Labels each triangle, given what is seen at its centre (`seen`).
///
/// - A cell takes the label that covers most of its area.
/// - If a triangle wider than `wide` differs, the cell's border has a gap. Then each wide triangle keeps its
///   own label.
/// - Narrow triangles are unreliable next to a border. They take the label of the neighbour across their
///   longest side.
///
/// Returns the labels and the number of cells with a gap.
pub(crate) fn label_cells(cut: &Triangulation, seen: &[u32], wide: f64) -> (Vec<u32>, u64) {
    let (cell_of, count) = cut.cells();
    let triangles = cell_of.iter().enumerate().map(|(triangle, cell)| (*cell as usize, triangle as u32));
    let cells = csr_lists_from_pairs(count, triangles);
    let decided: Vec<CellLabels> = (0..count)
        .into_par_iter()
        .with_min_len(CELLS_PER_TASK)
        .with_max_len(CELLS_PER_TASK)
        .map(|cell| label_cell(cut, cells.of(cell), seen, wide))
        .collect();
    let mut looks = seen.to_vec();
    let mut leaks = 0;
    for (cell, decided) in decided.into_iter().enumerate() {
        let triangles = cells.of(cell).iter().map(|triangle| *triangle as usize);
        match decided {
            CellLabels::Uniform(look) => triangles.for_each(|triangle| looks[triangle] = look),
            CellLabels::PerTriangle(own) => {
                leaks += 1;
                triangles.zip(own).for_each(|(triangle, look)| looks[triangle] = look);
            }
        }
    }
    (looks, leaks)
}

/// Labels a non-empty cell.
fn label_cell(cut: &Triangulation, triangles: &[u32], point_labels: &[u32], wide: f64) -> CellLabels {
    let mut areas: Vec<(u32, f64)> = Vec::new();
    for triangle in triangles {
        let triangle_label = point_labels[*triangle as usize];
        let area = cut.area2(*triangle as usize);
        match areas.iter_mut().find(|(known, _)| *known == triangle_label) {
            Some((_, sum)) => *sum += area,
            None => areas.push((triangle_label, area)),
        }
    }
    // The label of largest total area; the first one among equals.
    let (main_label, _) =
        areas.iter().fold(
            (OUTSIDE, f64::NEG_INFINITY),
            |best, (look, area)| {
                if best.1 >= *area { best } else { (*look, *area) }
            },
        );
    let differs = |t: &u32| point_labels[*t as usize] != main_label && cut.width(*t as usize) > wide;
    if triangles.iter().any(differs) {
        CellLabels::PerTriangle(spread_labels(cut, triangles, wide, point_labels))
    } else {
        CellLabels::Uniform(main_label)
    }
}

/// Labels of a cell with a gap: narrow triangles inherit from wide ones, across the longest sides first. A
/// sliver shares its long sides with its surroundings.
fn spread_labels(cut: &Triangulation, triangles: &[u32], wide: f64, seen: &[u32]) -> Vec<u32> {
    let is_wide = |triangle: &u32| cut.width(*triangle as usize) > wide;
    let sure: Vec<u32> = triangles.iter().copied().filter(is_wide).collect();
    let mut known: FxHashMap<u32, u32> = sure.iter().map(|t| (*t, seen[*t as usize])).collect();
    // Lengths as bits, which sort like positive numbers; ties are broken by triangle numbers.
    let mut open = BinaryHeap::new();
    let reach = |from: u32, known: &FxHashMap<u32, u32>, open: &mut BinaryHeap<_>| {
        for side in 0..3 {
            let next = cut.neighbours[from as usize][side];
            let goes_on = cut.borders[from as usize][side].is_none();
            if next != OUTSIDE && goes_on && !known.contains_key(&next) {
                open.push((cut.side(from as usize, side).to_bits(), Reverse([next, from])));
            }
        }
    };
    sure.iter().for_each(|triangle| reach(*triangle, &known, &mut open));
    while let Some((_, Reverse([next, from]))) = open.pop() {
        if !known.contains_key(&next)
            && let Some(look) = known.get(&from).copied()
        {
            known.insert(next, look);
            reach(next, &known, &mut open);
        }
    }
    triangles.iter().map(|t| known.get(t).copied().unwrap_or(seen[*t as usize])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::regions::arrangement::snap_rounding::Noded;

    #[test]
    fn slivers_take_the_label_along_their_long_sides() {
        // A sliver with its short side on a light triangle, and dark triangles along its long sides.
        let points = vec![[0, 0], [0, 20], [10, 9], [10, 11], [200, 10], [210, -200], [210, 220]];
        let cut = Triangulation::new(Noded { points, pieces: Vec::new() });
        let is_light = |corners: [u32; 3]| corners.iter().all(|corner| *corner < 4);
        let is_sliver = |corners: [u32; 3]| corners == [2, 4, 3];
        let seen: Vec<u32> = cut.triangles.iter().map(|t| u32::from(is_light(*t) || is_sliver(*t))).collect();
        assert_eq!(cut.triangles.iter().filter(|t| is_sliver(**t)).count(), 1, "{:?}", cut.triangles);
        let (looks, leaks) = label_cells(&cut, &seen, 3.0);
        assert_eq!(leaks, 1);
        for (corners, look) in cut.triangles.iter().zip(looks) {
            assert_eq!(look, u32::from(is_light(*corners)), "{corners:?}");
        }
    }

    #[test]
    fn stacked_slivers_take_the_label_of_the_wide_cell_beyond_them() {
        // Rows of slivers below two wide triangles. One of the two shares its long side with the rows.
        let rows = [0, 2, 4, 200].into_iter();
        let points: Vec<[i64; 2]> = rows.flat_map(|y| [[0, y], [200, y]]).collect();
        let cut = Triangulation::new(Noded { points, pieces: Vec::new() });
        let is_top = |corners: [u32; 3]| corners.contains(&6) || corners.contains(&7);
        let is_along = |corners: [u32; 3]| is_top(corners) && corners.contains(&4) && corners.contains(&5);
        let seen: Vec<u32> = cut.triangles.iter().map(|t| u32::from(is_along(*t))).collect();
        assert_eq!(cut.triangles.iter().filter(|t| !is_top(**t)).count(), 4, "{:?}", cut.triangles);
        let (looks, leaks) = label_cells(&cut, &seen, 3.0);
        assert_eq!(leaks, 1);
        for (corners, look) in cut.triangles.iter().zip(looks) {
            assert_eq!(look, u32::from(!is_top(*corners) || is_along(*corners)), "{corners:?}");
        }
    }
}
