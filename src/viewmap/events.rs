//! Where the visibility of a contour of a rounded surface may change: in the image it meets a line
//! that bounds a surface, on the surface it meets an intersection.
//!
//! Source: Arthur Appel, "The notion of quantitative invisibility and the machine rendering of
//! solids", 1967: along a line the count changes where it passes under a contour, nowhere else.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::graph::ViewVertexKind;
use super::grid::Grid;
use super::grouped::bucket;
use super::project::ImageSegment;
use crate::lines::{FeatureSegment, LineKind, NO_FACE};
use crate::mesh::Mesh;
use crate::view::View;

/// A place on a contour of a rounded surface where its visibility may change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// The image segment it lies on.
    pub segment: u32,
    /// Where on it, 0 to 1.
    pub t: f64,
    /// What is there.
    pub kind: ViewVertexKind,
    /// On which side a nearer surface covers it: before (`false`) or after (`true`).
    pub covered: Option<bool>,
}

/// What the finder looks at.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub segments: &'a [ImageSegment],
    pub sources: &'a [FeatureSegment],
    /// See [`crate::lines::ContourCurve::advance`]; what runs backward never covers.
    pub advance: &'a [f32],
}

/// All events, by segment, then by place.
#[must_use]
pub(super) fn find(scene: &Scene, grid: &Grid) -> Vec<Event> {
    let kind = |s: &ImageSegment| scene.sources[s.source as usize].kind;
    let takes_part = |s: &ImageSegment| s.bounds || s.is_rounded() || kind(s) == LineKind::Intersection;
    let mut holds_rounded = vec![false; grid.len()];
    for s in scene.segments.iter().filter(|s| s.is_rounded()) {
        grid.walk(s.a, s.b, |tile, _, _| holds_rounded[tile] = true);
    }
    let items = bucket(grid.len(), |put| {
        for (i, s) in scene.segments.iter().enumerate().filter(|(_, s)| takes_part(s)) {
            grid.walk(s.a, s.b, |tile, _, _| {
                if holds_rounded[tile] {
                    put(tile, i as u32);
                }
            });
        }
    });
    let found: Vec<Vec<Event>> = (0..grid.len())
        .into_par_iter()
        .with_min_len(256)
        .map(|tile| {
            let mut events = Vec::new();
            let own = items.of(tile);
            for (k, i) in own.iter().enumerate().filter(|(_, i)| scene.segments[**i as usize].is_rounded()) {
                for (l, j) in own.iter().enumerate() {
                    // A pair of two rounded contours is looked at once.
                    if l > k || !scene.segments[*j as usize].is_rounded() {
                        events.extend(scene.meet(*i, *j));
                    }
                }
            }
            events
        })
        .collect();
    let mut events = found.concat();
    events
        .sort_by(|a, b| a.segment.cmp(&b.segment).then(a.t.total_cmp(&b.t)).then(a.covered.cmp(&b.covered)));
    // A pair that passes through two tiles together was found in both.
    events.dedup();
    events
}

impl Scene<'_> {
    /// The event where contour `i` meets line `j`, on the farther of them.
    fn meet(&self, i: u32, j: u32) -> Option<Event> {
        let (p, q) = (&self.segments[i as usize], &self.segments[j as usize]);
        if p.ends.iter().any(|end| q.ends.contains(end)) {
            return None;
        }
        let (s, t) = crossing(p, q)?;
        if self.sources[q.source as usize].kind == LineKind::Intersection {
            let on_one_face = q.hosts.contains(&p.hosts[0]);
            let kind = ViewVertexKind::Piercing;
            return on_one_face.then_some(Event { segment: i, t: s, kind, covered: None });
        }
        let nearness = |segment: &ImageSegment, t: f64| segment.a.z + (segment.b.z - segment.a.z) * t;
        let p_is_far = nearness(p, s) < nearness(q, t);
        let (far, near, at, far_id, near_id) = if p_is_far { (p, q, s, i, j) } else { (q, p, t, j, i) };
        if !far.is_rounded() || self.advance[near_id as usize] < 0.0 {
            return None;
        }
        let inward = self.inward(near)?;
        let along = (far.b - far.a).truncate();
        let covered = Some(along.dot(inward) > 0.0);
        Some(Event { segment: far_id, t: at, kind: ViewVertexKind::TJunction, covered })
    }

    /// A vector across a bounding segment, to the side where its surface lies in the image.
    fn inward(&self, near: &ImageSegment) -> Option<DVec2> {
        let across = (near.b - near.a).truncate().perp();
        if near.is_rounded() {
            return Some(-across);
        }
        let height = |face: &u32| {
            let corners = self.mesh.triangles[*face as usize];
            let third = corners.iter().find(|v| !near.ends.contains(v));
            let height = third.map(|v| (self.view.points[*v as usize] - near.a).truncate().dot(across));
            height.filter(|h| h.is_finite()).unwrap_or(0.0)
        };
        let heights = near.hosts.iter().filter(|f| **f != NO_FACE).map(height);
        let most = heights.max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        Some(if most > 0.0 { across } else { -across })
    }
}

/// Where two segments cross in the image. An end counts to one side only, so that a polyline that
/// crosses another in a corner does so once.
fn crossing(p: &ImageSegment, q: &ImageSegment) -> Option<(f64, f64)> {
    let [a, b, c, d] = [p.a, p.b, q.a, q.b].map(DVec3::truncate);
    let (u, v) = (b - a, d - c);
    let (from, to) = (v.perp_dot(a - c), v.perp_dot(b - c));
    if (from > 0.0) == (to > 0.0) {
        return None;
    }
    let (start, end) = (u.perp_dot(c - a), u.perp_dot(d - a));
    if (start > 0.0) == (end > 0.0) {
        return None;
    }
    Some((from / (from - to), start / (start - end)))
}
