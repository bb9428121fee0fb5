//! Needles: contours of folds that are thinner than a pen wherever one looks at them.
//!
//! A face much longer than wide that turns from the eye makes a contour out to its tip and one back, the surface
//! going on on both sides. Of the two the nearer one is seen, and looks like a splinter. Where both lie in one stroke of
//! a pen, in the image and in space, and no other line ends at the tip, neither tells anything.

use glam::DVec3;

use super::project::ImageSegment;
use crate::lines::{FeatureLines, LineKind, NO_FACE, Role};
use crate::math::tolerance;
use crate::mesh::{FaceId, Mesh};
use crate::view::View;

/// A needle is at least this many times longer than wide.
const SLENDER: f64 = 3.0;

/// The feature segments that are a side of a needle, ascending.
pub(super) fn find(mesh: &Mesh, view: &View, lines: &FeatureLines, segments: &[ImageSegment]) -> Vec<u32> {
    let is_side = |s: &ImageSegment| {
        let source = &lines.segments[s.source as usize];
        source.kind == LineKind::Contour
            && s.role == Role::Line
            && s.cut == [false; 2]
            && !s.hosts.contains(&NO_FACE)
            && s.length() >= SLENDER * tolerance::NEEDLE_PX * view.frame.px()
    };
    let mut ends: Vec<(u32, u32)> = Vec::new();
    for (id, segment) in segments.iter().enumerate().filter(|(_, s)| is_side(s)) {
        ends.extend(segment.ends.map(|end| (end, id as u32)));
    }
    ends.sort_unstable();
    let mut found: Vec<(u32, [u32; 2])> = Vec::new();
    for tip in ends.chunk_by(|a, b| a.0 == b.0) {
        // Where another contour ends as well, it would end in nothing.
        let [(at, first), (_, second)] = *tip else { continue };
        if is_needle(mesh, view, lines, [first, second].map(|id| &segments[id as usize]), at) {
            found.push((at, [first, second]));
        }
    }
    let mut lines_at = vec![0u32; found.len()];
    if !found.is_empty() {
        for end in segments.iter().flat_map(|s| s.ends) {
            if let Ok(tip) = found.binary_search_by_key(&end, |(at, _)| *at) {
                lines_at[tip] += 1;
            }
        }
    }
    let bare = found.iter().zip(lines_at).filter(|(_, lines)| *lines == 2);
    let sides = bare.flat_map(|((_, sides), _)| sides.map(|id| segments[id as usize].source));
    let mut needles: Vec<u32> = sides.filter(|source| lines.segments[*source as usize].smooth).collect();
    needles.sort_unstable();
    needles.dedup();
    needles
}

/// Whether two contours that end in one vertex are the sides of a fold of which they lie in one stroke.
fn is_needle(mesh: &Mesh, view: &View, lines: &FeatureLines, pair: [&ImageSegment; 2], tip: u32) -> bool {
    let frame = &view.frame;
    let far = pair.map(|s| usize::from(s.ends[0] == tip));
    let along = [0, 1].map(|k| {
        let ends = [pair[k].a, pair[k].b].map(DVec3::truncate);
        ends[far[k]] - ends[1 - far[k]]
    });
    let lengths = along.map(|way| way.length());
    let (px, across) = (frame.px(), along[0].perp_dot(along[1]).abs());
    if along[0].dot(along[1]) <= 0.0 || across > tolerance::NEEDLE_PX * px * lengths[0].max(lengths[1]) {
        return false;
    }
    let feet = [0, 1].map(|k| lines.position(mesh, pair[k].ends[far[k]]));
    let depth = frame.depth(feet[0]).min(frame.depth(feet[1]));
    let base = feet[0].distance(feet[1]) / frame.px_at(depth) * px;
    base <= tolerance::NEEDLE_BASE_PX * px
        && SLENDER * base <= lengths[0].min(lengths[1])
        // A spike has two ridges for sides, and no back.
        && is_ridge(mesh, pair[0]) != is_ridge(mesh, pair[1])
}

/// Whether the second face beside a line falls away behind the outside of the first.
fn is_ridge(mesh: &Mesh, segment: &ImageSegment) -> bool {
    let [first, second] = segment.hosts;
    let third = mesh.triangles[second as usize].iter().find(|v| !segment.ends.contains(v));
    let [a, b, c] = mesh.corners(FaceId(first));
    let way = third.map_or(a, |v| mesh.positions[*v as usize]) - mesh.positions[segment.ends[0] as usize];
    (b - a).cross(c - a).dot(way) < 0.0
}
