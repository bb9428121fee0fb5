//! Welding of vertices within a tolerance.
//!
//! Exporters split vertices at normal and texture seams, STL has no connectivity, and corners of CAD faces
//! differ in their last bits. Vertices at equal positions are already joined when vertices are sorted.
//! [`join_nearby`] joins the rest within a tolerance. It examines only vertices on open edges, because a closed fan
//! of faces needs no join. Welding joins vertices, never faces, so parts stay separate.

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::geometry::lists::disjoint_sets::DisjointSets;

/// For each vertex, the smallest id of the vertices joined to it; `None` if nothing is joined.
///
/// Only `candidates` (ascending) are examined. Two of them are joined if their distance is at most the
/// greater of their `reaches`. Joins are transitive.
#[must_use]
pub(crate) fn join_nearby(positions: &[DVec3], candidates: &[u32], reaches: &[f64]) -> Option<Vec<u32>> {
    let tolerance = reaches.iter().copied().fold(0.0, f64::max);
    if tolerance <= 0.0 {
        return None;
    }
    // Cells are much larger than the tolerance, so that few points touch a second cell.
    let cell = tolerance * 16.0;
    let key = |p: DVec3| (p / cell).floor().to_array().map(|c| c as i64);
    let mut cells: FxHashMap<[i64; 3], Vec<(u32, f64)>> = FxHashMap::default();
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    for (&id, &reach) in candidates.iter().zip(reaches) {
        let p = positions[id as usize];
        let (low, high) = (key(p - tolerance), key(p + tolerance));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for &(other, other_reach) in cells.get(&[x, y, z]).map_or(&[][..], Vec::as_slice) {
                        let reach = reach.max(other_reach);
                        if positions[other as usize].distance_squared(p) <= reach * reach {
                            pairs.push([id, other]);
                        }
                    }
                }
            }
        }
        cells.entry(key(p)).or_default().push((id, reach));
    }
    if pairs.is_empty() {
        return None;
    }
    let joined = DisjointSets::new(positions.len(), |join| pairs.iter().for_each(|[a, b]| join(*a, *b)));
    Some(joined.into_representatives())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn join_nearby_merges_vertices_across_grid_cells() {
        let places: Vec<DVec3> = (0..200).map(|i| DVec3::new(f64::from(i) * 0.37, 0.0, 0.0)).collect();
        let mut doubled = places.clone();
        doubled.extend(places.iter().map(|p| *p + DVec3::splat(5e-7)));
        let all: Vec<u32> = (0..400).collect();
        let joined = join_nearby(&doubled, &all, &[1e-6; 400]).expect("pairs lie within the tolerance");
        assert!((0..200).all(|i| joined[i + 200] == i as u32));
        assert_eq!(join_nearby(&doubled, &all, &[1e-7; 400]), None);
        // The greater of two reaches applies.
        let reaches: Vec<f64> = (0..400).map(|i| if i < 100 { 1e-6 } else { 1e-9 }).collect();
        let joined = join_nearby(&doubled, &all, &reaches).expect("the first hundred pairs are joined");
        assert!((0..200).all(|i| (joined[i + 200] == i as u32) == (i < 100)));
    }
}
