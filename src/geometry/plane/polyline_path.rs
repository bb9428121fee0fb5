//! Paths of straight sides through points.

use kurbo::{BezPath, PathEl, Point};

/// The polyline through points.
pub(crate) fn polyline(points: &[Point]) -> BezPath {
    let mut path = BezPath::new();
    add_polyline(&mut path, points.iter().copied());
    path
}

/// The polygon with these corners.
pub(crate) fn polygon(corners: impl IntoIterator<Item = Point>) -> BezPath {
    let mut path = BezPath::new();
    add_polygon(&mut path, corners);
    path
}

/// Adds the polyline through points to a path. Returns whether there were any.
pub(crate) fn add_polyline(path: &mut BezPath, points: impl IntoIterator<Item = Point>) -> bool {
    let mut points = points.into_iter();
    let first = points.next();
    if let Some(first) = first {
        path.move_to(first);
        points.for_each(|p| path.line_to(p));
    }
    first.is_some()
}

/// Adds the polygon with these corners to a path.
pub(crate) fn add_polygon(path: &mut BezPath, corners: impl IntoIterator<Item = Point>) {
    if add_polyline(path, corners) {
        path.close_path();
    }
}

/// Subpaths of a path.
pub(crate) fn subpaths(path: &BezPath) -> Vec<BezPath> {
    let mut found: Vec<BezPath> = Vec::new();
    for element in path.elements() {
        match (element, found.last_mut()) {
            (PathEl::MoveTo(_), _) | (_, None) => found.push(BezPath::from_vec(vec![*element])),
            (_, Some(last)) => last.push(*element),
        }
    }
    found
}
