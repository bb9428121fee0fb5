//! What each triangle between borders looks like: all of a cell looks alike, unless its border leaks.

use std::collections::VecDeque;

use super::cells::{OUTSIDE, Triangulation};

/// Decides on a look for each triangle from what is seen in the middle of each (`seen`, numbers
/// below `looks`). A cell looks like most of its area. Only where a part of it wider than `wide` is
/// seen to differ do its borders leak; then each triangle keeps its own look, and narrow ones, which
/// cannot be trusted beside a border, take that of a neighbour.
///
/// Gives the looks and the number of cells that leak.
pub(super) fn decide(cut: &Triangulation, seen: &[u32], wide: f64) -> (Vec<u32>, u64) {
    let (cell_of, count) = cut.cells();
    let mut of_cell: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (triangle, cell) in cell_of.iter().enumerate() {
        of_cell[*cell as usize].push(triangle as u32);
    }
    let mut looks = seen.to_vec();
    let mut leaks = 0;
    let mut areas: Vec<(u32, f64)> = Vec::new();
    for triangles in of_cell {
        areas.clear();
        for triangle in &triangles {
            let look = seen[*triangle as usize];
            let area = cut.area2(*triangle as usize);
            match areas.iter_mut().find(|(known, _)| *known == look) {
                Some((_, sum)) => *sum += area,
                None => areas.push((look, area)),
            }
        }
        // The greatest area; of equal ones the first seen.
        let most = areas.iter().fold(None, |most: Option<(u32, f64)>, (look, area)| match most {
            Some((_, greatest)) if greatest >= *area => most,
            _ => Some((*look, *area)),
        });
        let Some((most, _)) = most else { continue };
        let differs = |t: &u32| seen[*t as usize] != most && cut.width(*t as usize) > wide;
        if triangles.iter().any(differs) {
            leaks += 1;
            spread(cut, &triangles, wide, &mut looks);
        } else {
            for triangle in &triangles {
                looks[*triangle as usize] = most;
            }
        }
    }
    (looks, leaks)
}

/// Gives the narrow triangles of a cell the looks of the wide ones beside them.
fn spread(cut: &Triangulation, triangles: &[u32], wide: f64, looks: &mut [u32]) {
    let is_wide = |t: u32| cut.width(t as usize) > wide;
    let mut open: VecDeque<u32> = triangles.iter().copied().filter(|t| is_wide(*t)).collect();
    let mut known: rustc_hash::FxHashSet<u32> = open.iter().copied().collect();
    while let Some(triangle) = open.pop_front() {
        for side in 0..3 {
            let next = cut.neighbours[triangle as usize][side];
            let goes_on = cut.borders[triangle as usize][side].is_none();
            if next != OUTSIDE && goes_on && known.insert(next) {
                looks[next as usize] = looks[triangle as usize];
                open.push_back(next);
            }
        }
    }
}
