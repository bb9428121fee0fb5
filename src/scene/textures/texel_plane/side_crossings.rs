//! Crossings of borders with the sides of a triangle, identical for both triangles that share a side.

use glam::DVec2;
use robust::{Coord, orient2d};

use super::texel_borders::BorderSegment;
use crate::scene::tolerances::END_OF_SIDE;

/// Twice the signed area of a triangle, positive if it turns from x to y. The sign is exact.
pub(crate) fn doubled_area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let at = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(at(a), at(b), at(c))
}

/// A side of a triangle in the texel plane, directed from the end that comes first in space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TexelSide {
    pub from: DVec2,
    pub to: DVec2,
    /// Whether the triangle is on the side where [`doubled_area`] is not negative.
    pub inside: bool,
}

impl TexelSide {
    /// Whether a point is on the triangle's side of the line.
    pub(crate) fn admits(&self, p: DVec2) -> bool {
        (doubled_area(self.from, self.to, p) >= 0.0) == self.inside
    }

    /// Crossing of a border segment with the side: positions on the side and on the segment, 0 to 1.
    pub(crate) fn crossing(&self, [p, q]: BorderSegment) -> Option<(f64, f64)> {
        let (of_p, of_q) = (doubled_area(self.from, self.to, p), doubled_area(self.from, self.to, q));
        if (of_p >= 0.0) == (of_q >= 0.0) {
            return None;
        }
        let (of_from, of_to) = (doubled_area(p, q, self.from), doubled_area(p, q, self.to));
        if (of_from >= 0.0) == (of_to >= 0.0) {
            return None;
        }
        let part = of_from / (of_from - of_to);
        let part = if part < END_OF_SIDE {
            0.0
        } else if part > 1.0 - END_OF_SIDE {
            1.0
        } else {
            part
        };
        Some((part, of_p / (of_p - of_q)))
    }
}

/// Sorts crossings along a side and removes duplicates and ends.
pub(crate) fn sort_crossings(parts: &mut Vec<f64>) {
    parts.retain(|part| *part > 0.0 && *part < 1.0);
    parts.sort_unstable_by(f64::total_cmp);
    parts.dedup_by(|b, a| *b - *a < END_OF_SIDE);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texel_side_crossings_are_equal_from_both_triangles() {
        let (from, to) = (DVec2::new(1.0, 2.0), DVec2::new(4.0, 8.0));
        let border = [DVec2::new(0.0, 5.0), DVec2::new(5.0, 5.1)];
        let parts = [true, false].map(|inside| TexelSide { from, to, inside }.crossing(border));
        assert!(parts[0].is_some_and(|(part, _)| (0.5..0.53).contains(&part)));
        assert_eq!(parts[0], parts[1]);
        assert_eq!(TexelSide { from, to, inside: true }.crossing([from, from + DVec2::new(0.0, 9.0)]), None);
    }

    #[test]
    fn sort_crossings_orders_and_drops_ends_and_duplicates() {
        let mut parts = vec![1.0, 0.7, 0.2, 0.2 + 1e-12, 0.0];
        sort_crossings(&mut parts);
        assert_eq!(parts, [0.2, 0.7]);
    }
}
