//! Polylines and rings of points: bounding boxes, areas and lengths.

use kurbo::{Point, Rect};

use super::planar_distance::length;

/// Bounding box of points; `None` if there are none.
pub(crate) fn bounds(points: impl IntoIterator<Item = Point>) -> Option<Rect> {
    let mut points = points.into_iter();
    let first = points.next()?;
    Some(points.fold(Rect::from_points(first, first), |bounds, p| bounds.union_pt(p)))
}

/// Signed area of a ring, which may repeat its first point.
pub(crate) fn ring_area(ring: &[Point]) -> f64 {
    let next = |k: usize| ring[(k + 1) % ring.len()];
    (0..ring.len()).map(|k| ring[k].to_vec2().cross(next(k).to_vec2())).sum::<f64>() / 2.0
}

/// Length of a polyline.
pub(crate) fn polyline_length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| length(pair[1] - pair[0])).sum()
}

/// Arc length at each point of a polyline.
pub(crate) fn arc_lengths(points: &[Point]) -> Vec<f64> {
    let mut arc = 0.0;
    let on_from_first = points.windows(2).map(|pair| {
        arc += length(pair[1] - pair[0]);
        arc
    });
    points.first().map(|_| 0.0).into_iter().chain(on_from_first).collect()
}
