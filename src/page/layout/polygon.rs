//! [`ConvexPolygon`]: convex polygons with clipping and separation tests.
//!
//! Clipping by a half plane follows Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.

use kurbo::{BezPath, Point, Rect, Vec2};

use crate::geometry::plane::polyline_path::polygon;
use crate::geometry::plane::polylines::bounds;
use crate::page::tolerances::MAX_OUTWARD_CROSS_PRODUCT_MM2;

/// A half plane: the points `p` with `(p - point) · normal >= 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HalfPlane {
    /// A point on the boundary line.
    pub point: Point,
    /// Unit normal into the half plane.
    pub normal: Vec2,
}

impl HalfPlane {
    /// Signed distance of a point from the boundary, positive inside.
    #[must_use]
    pub(crate) fn depth(&self, p: Point) -> f64 {
        (p - self.point).dot(self.normal)
    }

    /// The half plane mirrored at a vertical line.
    #[must_use]
    pub(crate) fn mirrored(self, x: f64) -> Self {
        let point = Point::new(2.0 * x - self.point.x, self.point.y);
        Self { point, normal: Vec2::new(-self.normal.x, self.normal.y) }
    }
}

/// A convex polygon, clockwise with y down; may be empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ConvexPolygon(pub Vec<Point>);

impl From<Rect> for ConvexPolygon {
    fn from(r: Rect) -> Self {
        Self([(r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1)].map(Point::from).to_vec())
    }
}

impl ConvexPolygon {
    /// The part of the polygon in a half plane.
    #[must_use]
    pub(crate) fn cut(&self, side: &HalfPlane) -> Self {
        let mut kept = Vec::with_capacity(self.0.len() + 1);
        for (a, b) in self.sides() {
            let (from, to) = (side.depth(a), side.depth(b));
            if from >= 0.0 {
                kept.push(a);
            }
            if (from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0) {
                kept.push(a.lerp(b, from / (from - to)));
            }
        }
        if kept.len() < 3 { Self::default() } else { Self(kept) }
    }

    /// The polygon with all sides moved inwards.
    #[must_use]
    pub(crate) fn inset(&self, by: f64) -> Self {
        let sides: Vec<(Point, Point)> = self.sides().collect();
        sides.iter().filter(|(a, b)| a != b).fold(self.clone(), |rest, (a, b)| {
            let way = (*b - *a).normalize();
            let normal = Vec2::new(-way.y, way.x);
            rest.cut(&HalfPlane { point: *a + normal * by, normal })
        })
    }

    /// The sides in order.
    pub(crate) fn sides(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let ends = self.0.iter().cycle().skip(1);
        self.0.iter().copied().zip(ends.copied())
    }

    /// The area.
    #[must_use]
    pub(crate) fn area(&self) -> f64 {
        let Some(first) = self.0.first() else { return 0.0 };
        self.sides().map(|(a, b)| (a - *first).cross(b - *first)).sum::<f64>() / 2.0
    }

    /// The bounding box.
    #[must_use]
    pub(crate) fn bounds(&self) -> Rect {
        bounds(self.0.iter().copied()).unwrap_or_default()
    }

    /// Whether a point is inside or on the boundary.
    #[must_use]
    pub(crate) fn holds(&self, p: Point) -> bool {
        !self.0.is_empty()
            && self.sides().all(|(a, b)| (b - a).cross(p - a) >= -MAX_OUTWARD_CROSS_PRODUCT_MM2)
    }

    /// The intersection of two polygons.
    #[must_use]
    pub(crate) fn common(&self, other: &Self) -> Self {
        other.sides().filter(|(a, b)| a != b).fold(self.clone(), |rest, (a, b)| {
            let way = (b - a).normalize();
            rest.cut(&HalfPlane { point: a, normal: Vec2::new(-way.y, way.x) })
        })
    }

    /// Whether two polygons are closer than a gap. Only lines along their sides are tested as separators, so
    /// polygons near each other's corners count as closer.
    #[must_use]
    pub(crate) fn meets(&self, other: &Self, gap: f64) -> bool {
        !self.0.is_empty() && !other.0.is_empty() && !self.parts(other, gap) && !other.parts(self, gap)
    }

    /// Whether a line along a side of this polygon separates the other by at least a gap.
    fn parts(&self, other: &Self, gap: f64) -> bool {
        self.sides().filter(|(a, b)| a != b).any(|(a, b)| {
            let way = (b - a).normalize();
            other.0.iter().all(|p| way.cross(*p - a) <= -gap)
        })
    }

    /// The closed path of the boundary.
    #[must_use]
    pub(crate) fn path(&self) -> BezPath {
        polygon(self.0.iter().copied())
    }

    /// The polygon moved by a vector.
    #[must_use]
    pub(crate) fn moved(&self, by: Vec2) -> Self {
        Self(self.0.iter().map(|p| *p + by).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, side: f64) -> ConvexPolygon {
        Rect::new(x, 0.0, x + side, side).into()
    }

    #[test]
    fn convex_polygons_are_cut_inset_and_measured() {
        let square = square(0.0, 4.0);
        assert_eq!(square.area(), 16.0);
        let half = HalfPlane { point: Point::new(1.0, 0.0), normal: Vec2::new(1.0, 0.0) };
        assert_eq!(square.cut(&half).area(), 12.0);
        assert_eq!(square.inset(1.0).bounds(), Rect::new(1.0, 1.0, 3.0, 3.0));
        assert_eq!(square.inset(3.0), ConvexPolygon::default());
    }

    #[test]
    fn convex_polygons_meet_within_a_gap() {
        assert!(square(0.0, 2.0).meets(&square(1.0, 2.0), 0.0));
        assert!(!square(0.0, 2.0).meets(&square(3.0, 2.0), 0.5));
        assert!(square(0.0, 2.0).meets(&square(3.0, 2.0), 1.5));
        assert_eq!(square(0.0, 2.0).common(&square(1.0, 2.0)).area(), 2.0);
    }
}
