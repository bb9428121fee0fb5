//! What each triangle between borders looks like: all of a cell looks alike, unless its border leaks.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::cells::{OUTSIDE, Triangulation};

/// Decides on a look for each triangle from what is seen in the middle of each (`seen`, numbers
/// below `looks`). A cell looks like most of its area. Only where a part of it wider than `wide` is
/// seen to differ do its borders leak; then each triangle keeps its own look, and narrow ones, which
/// cannot be trusted beside a border, take that of the neighbour over their longest side.
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

/// Gives the narrow triangles of a cell the looks of wide ones, handed on over the longest sides first: a sliver shares
/// its long sides with what is around it, and but a short one with what it would be a spike of.
fn spread(cut: &Triangulation, triangles: &[u32], wide: f64, looks: &mut [u32]) {
    let mut known = rustc_hash::FxHashSet::default();
    // Lengths as bits, which order positive numbers; of equal ones the first triangles.
    let mut open = BinaryHeap::new();
    let reach = |from: u32, open: &mut BinaryHeap<(u64, Reverse<[u32; 2]>)>| {
        for side in 0..3 {
            let next = cut.neighbours[from as usize][side];
            let goes_on = cut.borders[from as usize][side].is_none();
            if next != OUTSIDE && goes_on {
                open.push((cut.side(from as usize, side).to_bits(), Reverse([next, from])));
            }
        }
    };
    for triangle in triangles.iter().copied().filter(|t| cut.width(*t as usize) > wide) {
        known.insert(triangle);
        reach(triangle, &mut open);
    }
    while let Some((_, Reverse([next, from]))) = open.pop() {
        if known.insert(next) {
            looks[next as usize] = looks[from as usize];
            reach(next, &mut open);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::noding::Noded;

    #[test]
    fn slivers_look_like_what_is_along_them() {
        // A sliver with its short side at a light triangle on the left, and dark ones along its long sides.
        let points = vec![[0, 0], [0, 20], [10, 9], [10, 11], [200, 10], [210, -200], [210, 220]];
        let cut = Triangulation::new(Noded { points, pieces: Vec::new() });
        let is_light = |corners: [u32; 3]| corners.iter().all(|corner| *corner < 4);
        let is_sliver = |corners: [u32; 3]| corners == [2, 4, 3];
        let seen: Vec<u32> = cut.triangles.iter().map(|t| u32::from(is_light(*t) || is_sliver(*t))).collect();
        assert_eq!(cut.triangles.iter().filter(|t| is_sliver(**t)).count(), 1, "{:?}", cut.triangles);
        let (looks, leaks) = decide(&cut, &seen, 3.0);
        assert_eq!(leaks, 1);
        for (corners, look) in cut.triangles.iter().zip(looks) {
            assert_eq!(look, u32::from(is_light(*corners)), "{corners:?}");
        }
    }
}
