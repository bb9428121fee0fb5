//! Straight segments of chains, and the points of paths.

use kurbo::{BezPath, PathEl, Point, Rect};

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

/// Bounding box of points.
pub(crate) fn bounds<'a>(points: impl IntoIterator<Item = &'a Point>) -> Rect {
    let mut points = points.into_iter();
    let Some(first) = points.next() else { return Rect::ZERO };
    points.fold(Rect::from_points(*first, *first), |rect, p| rect.union_pt(*p))
}

/// All points of a path, including control points.
pub(crate) fn points(path: &BezPath) -> Vec<Point> {
    let mut points = Vec::new();
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(p) | PathEl::LineTo(p) => points.push(p),
            PathEl::QuadTo(c, p) => points.extend([c, p]),
            PathEl::CurveTo(c, d, p) => points.extend([c, d, p]),
            PathEl::ClosePath => {}
        }
    }
    points
}
