//! Straight segments of chains.

use kurbo::Point;

/// A segment and the number of its chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    pub chain: u32,
    pub from: Point,
    pub to: Point,
}

/// The point of a segment nearest to a given point.
pub(crate) fn nearest_on(from: Point, to: Point, p: Point) -> Point {
    let along = to - from;
    let length2 = along.hypot2();
    if length2 == 0.0 {
        return from;
    }
    from + along * ((p - from).dot(along) / length2).clamp(0.0, 1.0)
}
