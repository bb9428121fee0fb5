//! What one triangle hides of one segment: an interval of its parameter, found exactly.
//!
//! In image space the segment is a straight line and the triangle a piece of a plane, so that
//! being inside the triangle and being behind its plane are linear in the parameter. The rules at
//! the limits:
//!
//! - A triangle that has both ends of the segment as corners, or is its host, never hides it.
//! - A point on the projected border of a triangle counts as covered: a back edge exactly behind
//!   a front one is hidden, and a line exactly behind the common edge of two faces does not leak.
//! - A surface that touches the line (within a tolerance of depth) does not hide it: lines on
//!   coplanar and touching faces are seen.
//! - A triangle that shares one end of the segment may come as near as rounding allows.
//! - A line that lies in the plane of a triangle, within the rounding of the file, is not hidden by it. Distances from the
//!   plane count, which are much shorter than differences of depth where the triangle is seen at a grazing angle.
//! - A triangle seen edge-on covers nothing.

use glam::{DVec2, DVec3};

use super::tiled_triangles::Occluder;
use crate::view::Frame;
use crate::visibility::graph::ViewVertexKind;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::view_tolerances::Limits;

/// Part of a segment's parameter range, with the reason for each end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where it starts.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
    /// What happens at the start: [`ViewVertexKind::TJunction`] or [`ViewVertexKind::Piercing`].
    pub start_kind: ViewVertexKind,
    /// What happens at the end.
    pub end_kind: ViewVertexKind,
}

/// The range of parameters over which the projected triangle covers the image segment p→q.
/// A border met counts as covered.
#[inline]
#[must_use]
pub fn covered(p: DVec2, q: DVec2, corners: &[DVec3; 3], limits: &Limits) -> Option<(f64, f64)> {
    let [a, b, c] = corners.map(DVec3::truncate);
    let sides = [(a, b - a), (b, c - b), (c, a - c)];
    let area = sides[0].1.perp_dot(c - a);
    let sign = area.signum();
    // Most triangles that are asked lie wholly on the far side of one of their sides, and most
    // others cover all that is asked; that much is seen without a square root, since the sum of
    // its coordinates is no shorter than a vector.
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

/// What a triangle hides of a segment between two of its parameters: that part of what it hides of the whole, so that it
/// does not matter how the segment is cut.
#[inline]
#[must_use]
pub fn hidden_interval(
    segment: &ImageSegment,
    (from, to): (f64, f64),
    triangle: &Occluder,
    frame: &Frame,
    limits: &Limits,
) -> Option<Interval> {
    let corners = &triangle.corners;
    let shared = segment.ends.map(|end| triangle.ids.iter().position(|id| *id == end));
    if shared[0].is_some() && shared[1].is_some() {
        return None;
    }
    let (start, end) = covered(segment.a.truncate(), segment.b.truncate(), corners, limits)?;
    if start > to || end < from {
        return None;
    }
    // Heights over the plane are measured from the shared corner, where they vanish exactly.
    let base = corners[shared[0].or(shared[1]).unwrap_or(0)];
    let (u, v) = (corners[1] - corners[0], corners[2] - corners[0]);
    let area = u.truncate().perp_dot(v.truncate());
    let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
    let nearest = corners[0].z.max(corners[1].z).max(corners[2].z);
    let farthest = corners[0].z.min(corners[1].z).min(corners[2].z);
    // A point that counts as covered may lie a little outside of the triangle, and then beyond its depths.
    let outside = limits.cover * slope.length();
    let at_corner = |end: usize| shared[end].is_some() && !segment.cut[end];
    let is_neighbour = shared[0].is_some() || shared[1].is_some();
    let lead = |t: f64| {
        let p = segment.at(t);
        // Steep triangles extrapolate badly: their plane counts only within their own depths.
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
        // From a shared corner the surface rises at once.
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
