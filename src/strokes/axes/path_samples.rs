//! The path of a chain as closely spaced points, with its corners and scene samples.

use kurbo::{BezPath, ParamCurve, PathSeg, Point, Vec2};

use crate::chains::{Chain, Sample};
use crate::geometry::plane::planar_distance::{length, unit};
use crate::geometry::plane::polylines::arc_lengths;

/// Cosine of the least turn that makes a corner, 20 degrees.
pub(crate) const CORNER_COSINE: f64 = 0.9397;

/// Points on a path, about `step` apart, and the indices where its segments meet in a corner. The last point
/// of a closed path equals its first.
pub(crate) fn dense(path: &BezPath, step: f64) -> (Vec<Point>, Vec<usize>) {
    let mut points: Vec<Point> = Vec::new();
    let mut corners = Vec::new();
    let mut last: Option<Vec2> = None;
    let mut begins: Option<Vec2> = None;
    for segment in path.segments() {
        let cubic = segment.to_cubic();
        let length = length(cubic.p1 - cubic.p0) + length(cubic.p2 - cubic.p1) + length(cubic.p3 - cubic.p2);
        let count = (length / step).ceil().clamp(1.0, 1e6) as usize;
        if points.is_empty() {
            points.push(segment.start());
        }
        let Some([leaves, arrives]) = tangents(&segment) else { continue };
        if last.is_some_and(|last| last.dot(leaves) < CORNER_COSINE) {
            corners.push(points.len() - 1);
        }
        begins.get_or_insert(leaves);
        last = Some(arrives);
        for k in 1..=count {
            let p = segment.eval(k as f64 / count as f64);
            if points.last() != Some(&p) {
                points.push(p);
            }
        }
    }
    let is_closed = points.len() > 2 && points.first() == points.last();
    if let (true, Some(begins), Some(ends)) = (is_closed, begins, last)
        && begins.dot(ends) < CORNER_COSINE
    {
        corners.insert(0, 0);
    }
    corners.dedup();
    (points, corners)
}

/// Unit directions at both ends; `None` for a segment without length.
fn tangents(segment: &PathSeg) -> Option<[Vec2; 2]> {
    let c = segment.to_cubic();
    let first = [c.p1, c.p2, c.p3].into_iter().map(|p| p - c.p0).find(|v| v.hypot2() > 0.0)?;
    let last = [c.p2, c.p1, c.p0].into_iter().map(|p| c.p3 - p).find(|v| v.hypot2() > 0.0)?;
    Some([unit(first), unit(last)])
}

/// The scene sample at each arc length of the path, which runs close to the chain's points.
pub(crate) fn samples(chain: &Chain, axis: &[Point], at: &[f64]) -> Vec<Sample> {
    let mut points = chain.points.clone();
    let mut samples = chain.samples.clone();
    if points.is_empty() || points.len() != samples.len() {
        return vec![Sample::new(0.0, 1.0); at.len()];
    }
    if chain.closed {
        // The path of a closed chain may start at another point.
        let away = |p: &Point| axis.first().map_or(0.0, |start| (*p - *start).hypot2());
        let nearest = (0..points.len()).min_by(|a, b| away(&points[*a]).total_cmp(&away(&points[*b])));
        points.rotate_left(nearest.unwrap_or(0));
        samples.rotate_left(nearest.unwrap_or(0));
        points.extend_from_within(..1);
        samples.extend_from_within(..1);
    }
    let own = arc_lengths(&points);
    let (Some(own_total), Some(total)) = (own.last(), at.last()) else { return Vec::new() };
    let scale = own_total / total.max(f64::MIN_POSITIVE);
    let mut side = 0;
    at.iter()
        .map(|arc| {
            let arc = arc * scale;
            while side + 2 < own.len() && own[side + 1] < arc {
                side += 1;
            }
            let next = (side + 1).min(own.len() - 1);
            let way = own[next] - own[side];
            let t = if way > 0.0 { ((arc - own[side]) / way).clamp(0.0, 1.0) } else { 0.0 };
            samples[side].lerp(samples[next], t)
        })
        .collect()
}
