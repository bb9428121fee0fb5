//! Lengths, distances and circles in the plane.

use std::f64::consts::TAU;

use kurbo::{Point, Vec2};

use crate::geometry::numbers::portable_math::atan2;

/// Length of a vector. The platform's `hypot` differs between machines.
#[must_use]
pub(crate) fn length(v: Vec2) -> f64 {
    v.hypot2().sqrt()
}

/// Unit vector of a direction; zero for the zero vector.
pub(crate) fn unit(v: Vec2) -> Vec2 {
    let length = length(v);
    if length > 0.0 { v / length } else { Vec2::ZERO }
}

/// Parameter of the point of a segment that is nearest to a point, 0 to 1.
#[inline]
pub(crate) fn nearest_parameter(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let length2 = way.hypot2();
    if length2 > 0.0 { ((p - a).dot(way) / length2).clamp(0.0, 1.0) } else { 0.0 }
}

/// Point of a segment that is nearest to a point.
#[inline]
pub(crate) fn nearest_on_segment(p: Point, a: Point, b: Point) -> Point {
    a + (b - a) * nearest_parameter(p, a, b)
}

/// Squared distance from a point to a segment.
#[must_use]
pub(crate) fn segment_distance_squared(p: Point, a: Point, b: Point) -> f64 {
    (p - nearest_on_segment(p, a, b)).hypot2()
}

/// Angle from one direction to another, turning from y to x, radians in (0, 2π].
pub(crate) fn turn_from_y_to_x(from: Vec2, to: Vec2) -> f64 {
    let angle = atan2(to.cross(from), to.dot(from));
    if angle > 0.0 { angle } else { angle + TAU }
}

/// Centre of the best circle through points, by least squares of the squared distances.
///
/// Source: Kåsa, A circle fitting procedure and its error analysis, 1976.
#[must_use]
pub(crate) fn fit_circle_centre(points: &[Point]) -> Option<Point> {
    let mean = points.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec2()) / points.len() as f64;
    let (mut xx, mut xy, mut yy, mut right) = (0.0, 0.0, 0.0, Vec2::ZERO);
    for p in points {
        let away = p.to_vec2() - mean;
        xx += away.x * away.x;
        xy += away.x * away.y;
        yy += away.y * away.y;
        right += away * away.hypot2() / 2.0;
    }
    let determinant = xx * yy - xy * xy;
    let to = Vec2::new(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / determinant;
    (determinant > 0.0 && to.is_finite()).then(|| (mean + to).to_point())
}
