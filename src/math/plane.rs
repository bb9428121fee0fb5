//! Lengths and distances in the plane.

use kurbo::{Point, Vec2};

/// Length of a vector; `hypot` of the platform differs between machines.
#[must_use]
pub fn length(v: Vec2) -> f64 {
    v.hypot2().sqrt()
}

/// Distance from a point to a segment, squared.
#[must_use]
pub fn distance2(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let length2 = way.hypot2();
    let t = if length2 > 0.0 { ((p - a).dot(way) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + way * t)).hypot2()
}
