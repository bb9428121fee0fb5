//! Welds corners at one position to one point, only for the order of collapses.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::collapse_record::NO_INDEX;
use crate::mesh::weld::nearby_vertices::join_nearby;

/// Points that differ in position or group.
#[derive(Debug, Default)]
pub(crate) struct Weld {
    numbers: FxHashMap<(u32, [u64; 3]), u32>,
    points: Vec<DVec3>,
}

impl Weld {
    /// Number of the point at a position, added if it is new.
    pub(crate) fn point(&mut self, group: u32, place: DVec3) -> u32 {
        // Positive and negative zero are the same coordinate.
        let place = place + 0.0;
        *self.numbers.entry((group, place.to_array().map(f64::to_bits))).or_insert_with(|| {
            self.points.push(place);
            self.points.len() as u32 - 1
        })
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// Positions of the points.
    pub(crate) fn into_points(self) -> Vec<DVec3> {
        self.points
    }
}

/// Joins points on open edges whose distance is at most their reach; returns the representative of each
/// point.
///
/// The corners of adjacent CAD faces often differ in their last bits. Returns `None` if nothing is joined.
pub(crate) fn join_near_points(points: &[DVec3], corners: &[[u32; 3]], reaches: &[f64]) -> Option<Vec<u32>> {
    // At a point that is surrounded by faces, each neighbour is once the next corner and once the last one.
    let mut open = vec![0_u32; points.len()];
    let mut add = |point: u32, other: u32, sign: u32| {
        let mixed = other.wrapping_add(1).wrapping_mul(0x9e37_79b1);
        open[point as usize] = open[point as usize].wrapping_add(sign.wrapping_mul(mixed ^ mixed >> 15));
    };
    for &[a, b, c] in corners.iter().filter(|corners| corners[0] != NO_INDEX) {
        for (point, next, last) in [(a, b, c), (b, c, a), (c, a, b)] {
            add(point, next, 1);
            add(point, last, u32::MAX);
        }
    }
    let candidates: Vec<u32> = (0..points.len() as u32).filter(|point| open[*point as usize] != 0).collect();
    let reaches: Vec<f64> = candidates.iter().map(|point| reaches[*point as usize]).collect();
    join_nearby(points, &candidates, &reaches)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weld_gives_equal_positions_of_one_group_one_point() {
        let mut weld = Weld::default();
        let places = [DVec3::X, DVec3::ZERO, DVec3::X, -DVec3::ZERO];
        assert_eq!(places.map(|place| weld.point(0, place)), [0, 1, 0, 1]);
        assert_eq!([weld.point(1, DVec3::X), weld.point(1, DVec3::X), weld.point(0, DVec3::Y)], [2, 2, 3]);
        assert_eq!(weld.into_points(), [DVec3::X, DVec3::ZERO, DVec3::X, DVec3::Y]);
    }
    #[test]
    fn join_near_points_joins_open_edges_within_tolerance() {
        let far = DVec3::new(1e-9, -1e-9, 0.0);
        let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + far, DVec3::Y + far, DVec3::ONE];
        let corners = [[0, 1, 2], [4, 3, 5], [NO_INDEX; 3]];
        assert_eq!(join_near_points(&points, &corners, &[1e-8; 6]), Some(vec![0, 1, 2, 1, 2, 5]));
        assert_eq!(join_near_points(&points, &corners, &[1e-10; 6]), None);
        // A closed surface has no open edges, so it is not joined to anything, however close.
        let closed = [[0, 2, 1], [0, 1, 5], [1, 2, 5], [2, 0, 5]];
        assert_eq!(join_near_points(&points, &closed, &[9.0; 6]), None);
    }
}
