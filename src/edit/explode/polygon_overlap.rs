//! [`TriangleOverlap`]: intersection of two triangles in the plane, and its area.

use glam::DVec2;

/// Convex polygon of at most 8 corners. Two triangles intersect in at most 6, and each of two further cuts
/// adds one.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TriangleOverlap {
    corners: [DVec2; 8],
    count: usize,
}

impl TriangleOverlap {
    fn push(&mut self, corner: DVec2) {
        if let Some(slot) = self.corners.get_mut(self.count) {
            *slot = corner;
            self.count += 1;
        }
    }
}

impl std::ops::Deref for TriangleOverlap {
    type Target = [DVec2];

    fn deref(&self) -> &[DVec2] {
        &self.corners[..self.count]
    }
}

/// Intersection of two counter-clockwise triangles.
pub(crate) fn common(one: &[DVec2; 3], other: &[DVec2; 3]) -> TriangleOverlap {
    // Most triangles with overlapping boxes are separated by a side of one of them.
    let are_parted = |one: &[DVec2; 3], other: &[DVec2; 3]| {
        (0..3).any(|k| {
            let (from, to) = (one[k], one[(k + 1) % 3]);
            other.iter().all(|p| (to - from).perp_dot(*p - from) <= 0.0)
        })
    };
    if are_parted(one, other) || are_parted(other, one) {
        return TriangleOverlap::default();
    }
    let mut polygon = TriangleOverlap::default();
    other.iter().for_each(|p| polygon.push(*p));
    for k in 0..3 {
        let (from, to) = (one[k], one[(k + 1) % 3]);
        polygon = cut(&polygon, |p| (to - from).perp_dot(*p - from));
        if polygon.len() < 3 {
            break;
        }
    }
    polygon
}

/// Part of a convex polygon where a linear function is not negative. Source: Sutherland and Hodgman,
/// Reentrant polygon clipping, 1974.
pub(crate) fn cut(polygon: &[DVec2], side: impl Fn(&DVec2) -> f64) -> TriangleOverlap {
    let mut left = TriangleOverlap::default();
    let Some(last) = polygon.last() else { return left };
    let (mut before, mut side_before) = (*last, side(last));
    for corner in polygon {
        let own = side(corner);
        if (own >= 0.0) != (side_before >= 0.0) {
            left.push(before.lerp(*corner, side_before / (side_before - own)));
        }
        if own >= 0.0 {
            left.push(*corner);
        }
        (before, side_before) = (*corner, own);
    }
    left
}

/// Area of a convex polygon.
pub(crate) fn area(polygon: &[DVec2]) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    let twice: f64 = polygon.windows(2).map(|pair| (pair[0] - *first).perp_dot(pair[1] - *first)).sum();
    twice.abs() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_of_a_triangle_and_its_mirror_image_is_a_hexagon() {
        let height = 3.0_f64.sqrt() / 2.0;
        let triangle =
            [DVec2::new(-0.5, -height / 3.0), DVec2::new(0.5, -height / 3.0), DVec2::new(0.0, height / 1.5)];
        let turned = triangle.map(|p| -p);
        let shared = common(&triangle, &turned);
        assert_eq!(shared.len(), 6);
        // The hexagon covers six of the nine small triangles.
        assert!((area(&shared) - height / 2.0 * 6.0 / 9.0).abs() < 1e-12);
        assert!((area(&cut(&shared, |p| p.x)) - area(&shared) / 2.0).abs() < 1e-12);
        assert!(common(&triangle, &triangle.map(|p| p + DVec2::X * 2.0)).len() < 3);
    }
}
