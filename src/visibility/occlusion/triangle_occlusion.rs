//! Part of one segment that one triangle hides: an interval of its parameter, computed exactly.
//!
//! In image space the segment is straight and the triangle planar. So being inside the triangle and being
//! behind its plane are both linear in the parameter. Rules for limiting cases:
//!
//! - A triangle that hosts the segment, or has both its ends as corners, never hides it.
//! - A point on the projected border of a triangle counts as covered. So a back edge exactly behind a front
//!   edge is hidden, and a line exactly behind the common edge of two faces does not leak.
//! - A surface that touches the line, within a depth tolerance, does not hide it. So lines on coplanar and
//!   touching faces are visible.
//! - A triangle that shares one end of the segment has a tighter tolerance, only for rounding.
//! - A triangle does not hide a line in its plane, within the rounding of the file. Distances from the plane
//!   count, which at grazing angles are much shorter than differences of depth.
//! - A triangle seen edge-on covers nothing.

use glam::{DVec2, DVec3};

use super::tiled_triangles::Occluder;
use crate::view::Frame;
use crate::visibility::graph::ViewVertexKind;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::view_tolerances::ViewTolerances;

/// Part of a segment's parameter range, with the reason for each end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    /// Start parameter.
    pub start: f64,
    /// End parameter.
    pub end: f64,
    /// Reason for the start: [`ViewVertexKind::TJunction`] or [`ViewVertexKind::Piercing`].
    pub start_kind: ViewVertexKind,
    /// Reason for the end.
    pub end_kind: ViewVertexKind,
}

/// Range of parameters where the projected triangle covers the image segment p→q. The border counts as
/// covered.
#[inline]
#[must_use]
pub(crate) fn covered(
    p: DVec2,
    q: DVec2,
    corners: &[DVec3; 3],
    limits: &ViewTolerances,
) -> Option<(f64, f64)> {
    let [a, b, c] = corners.map(DVec3::truncate);
    let sides = [(a, b - a), (b, c - b), (c, a - c)];
    let area = sides[0].1.perp_dot(c - a);
    let sign = area.signum();
    // Most segments are entirely outside one side of the triangle, and most others entirely inside all sides.
    // Neither case needs a square root, because |x| + |y| is at least the length of a vector.
    let mut at_ends = [(0.0, 0.0); 3];
    let mut inside = true;
    for ((corner, side), at) in sides.iter().zip(&mut at_ends) {
        let (at_p, at_q) = (side.perp_dot(p - corner) * sign, side.perp_dot(q - corner) * sign);
        let slack = -limits.cover * (side.x.abs() + side.y.abs());
        if at_p < slack && at_q < slack {
            return None;
        }
        inside &= at_p >= 0.0 && at_q >= 0.0;
        *at = (at_p, at_q);
    }
    let longest = sides.iter().map(|(_, d)| d.length_squared()).fold(0.0, f64::max);
    if area * area <= limits.height * limits.height * longest {
        return None;
    }
    if inside {
        return Some((0.0, 1.0));
    }
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for ((_, side), (at_p, at_q)) in sides.iter().zip(at_ends) {
        if at_p >= 0.0 && at_q >= 0.0 {
            continue;
        }
        let inward = 1.0 / side.length().max(f64::MIN_POSITIVE);
        let (at_p, at_q) = (at_p * inward + limits.cover, at_q * inward + limits.cover);
        if at_p < 0.0 {
            if at_q < 0.0 {
                return None;
            }
            start = start.max(at_p / (at_p - at_q));
        } else if at_q < 0.0 {
            end = end.min(at_p / (at_p - at_q));
        }
    }
    (start <= end).then_some((start, end))
}

/// Part of a segment between two parameters that a triangle hides.
///
/// It is the interval of the whole segment, clipped to the part. So the division of the segment does not
/// matter.
#[inline]
#[must_use]
pub(crate) fn hidden_interval(
    segment: &ImageSegment,
    part: (f64, f64),
    triangle: &Occluder,
    frame: &Frame,
    limits: &ViewTolerances,
) -> Option<Interval> {
    let range = covered_range(segment, part, &triangle.corners, limits)?;
    hidden_range(segment, part, range, triangle, frame, limits)
}

/// Range of parameters where a projected triangle covers a segment, or `None` if it covers nothing of the part.
#[inline]
#[must_use]
pub(crate) fn covered_range(
    segment: &ImageSegment,
    (from, to): (f64, f64),
    corners: &[DVec3; 3],
    limits: &ViewTolerances,
) -> Option<(f64, f64)> {
    covered(segment.a.truncate(), segment.b.truncate(), corners, limits)
        .filter(|(start, end)| *start <= to && *end >= from)
}

/// Part of a segment that a triangle hides, within the range that the triangle covers.
#[inline]
#[must_use]
pub(crate) fn hidden_range(
    segment: &ImageSegment,
    (from, to): (f64, f64),
    (start, end): (f64, f64),
    triangle: &Occluder,
    frame: &Frame,
    limits: &ViewTolerances,
) -> Option<Interval> {
    let corners = &triangle.corners;
    let shared = segment.ends.map(|end| triangle.ids.iter().position(|id| *id == end));
    if shared[0].is_some() && shared[1].is_some() {
        return None;
    }
    // Heights over the plane are measured from the shared corner, where they are exactly zero.
    let base = corners[shared[0].or(shared[1]).unwrap_or(0)];
    let (u, v) = (corners[1] - corners[0], corners[2] - corners[0]);
    let area = u.truncate().perp_dot(v.truncate());
    let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
    let nearest = corners[0].z.max(corners[1].z).max(corners[2].z);
    let farthest = corners[0].z.min(corners[1].z).min(corners[2].z);
    // A covered point may be slightly outside the triangle, and then outside its range of depths.
    let outside = limits.cover * slope.length();
    let at_corner = |end: usize| shared[end].is_some() && !segment.cut[end];
    let is_neighbour = shared[0].is_some() || shared[1].is_some();
    let lead = |t: f64| {
        let p = segment.at(t);
        // The plane of a steep triangle extrapolates badly, so it counts only within the triangle's own
        // depths.
        let plane = base.z + slope.dot(p.truncate() - base.truncate());
        let within = plane.clamp(farthest, nearest);
        let plane = if within - plane <= outside { plane.min(within) } else { within };
        plane - p.z - limits.step(p.z, &triangle.slack, is_neighbour, frame)
    };
    let (at_start, at_end) = (lead(start), lead(end));
    let mut hidden =
        Interval { start, end, start_kind: ViewVertexKind::TJunction, end_kind: ViewVertexKind::TJunction };
    if at_start <= 0.0 && at_end <= 0.0 {
        return None;
    }
    let is_in_plane = |t: f64| {
        let p = segment.at(t);
        let plane = base.z + slope.dot(p.truncate() - base.truncate());
        let depth = triangle.slack.in_plane * frame.steepness(DVec3::new(p.x, p.y, plane), slope);
        (plane - p.z).abs() <= frame.nearness_step(p.z, depth)
    };
    if is_in_plane(start) && is_in_plane(end) {
        return None;
    }
    let span = end - start;
    if at_start <= 0.0 {
        let t = start + span * (at_start / (at_start - at_end));
        // From a shared corner the surface rises at once, so the line does not pierce it.
        if !(at_corner(0) && start == 0.0) {
            (hidden.start, hidden.start_kind) = (t, ViewVertexKind::Piercing);
        }
    } else if at_end <= 0.0 && !(at_corner(1) && end == 1.0) {
        let t = start + span * (at_start / (at_start - at_end));
        (hidden.end, hidden.end_kind) = (t, ViewVertexKind::Piercing);
    }
    if hidden.start < from {
        (hidden.start, hidden.start_kind) = (from, ViewVertexKind::TJunction);
    }
    if hidden.end > to {
        (hidden.end, hidden.end_kind) = (to, ViewVertexKind::TJunction);
    }
    (hidden.start <= hidden.end).then_some(hidden)
}
