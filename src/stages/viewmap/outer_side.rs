//! [`OuterSide`]: a line just beside a bounding segment, away from its surface, which says whether there is background there.

use glam::{DVec2, DVec3};

use super::limits::Limits;
use super::occlude::covered;
use super::occluders::{Occluder, Triangles};
use super::project::ImageSegment;
use crate::lines::NO_FACE;

/// A bounding segment, moved a little to its outer side.
#[derive(Debug, Clone, Copy)]
pub(super) struct OuterSide {
    ends: [u32; 2],
    line: [DVec2; 2],
    shift: DVec2,
}

impl OuterSide {
    /// That of a segment; none if it has no length or is hosted by no face.
    pub(super) fn new(segment: &ImageSegment, triangles: &Triangles) -> Option<Self> {
        let shift = outward(segment, triangles)? * triangles.limits.beside;
        let line = [segment.a, segment.b].map(|end| end.truncate() + shift);
        Some(Self { ends: segment.ends, line, shift })
    }

    /// The ends of the part of it that lies beside two points of the segment.
    #[inline]
    pub(super) fn beside(&self, from: DVec3, to: DVec3) -> [DVec2; 2] {
        [from, to].map(|end| end.truncate() + self.shift)
    }

    /// The range of the segment's parameters beside which a triangle lies, that has not both its ends as corners.
    #[inline]
    pub(super) fn range(&self, triangle: &Occluder, limits: &Limits) -> Option<(f64, f64)> {
        if self.ends.iter().all(|end| triangle.ids.contains(end)) {
            return None;
        }
        covered(self.line[0], self.line[1], &triangle.corners, limits)
    }
}

/// The unit vector across a segment, away from the faces that meet there.
fn outward(segment: &ImageSegment, triangles: &Triangles) -> Option<DVec2> {
    let along = (segment.b - segment.a).truncate();
    let across = along.perp().try_normalize()?;
    let height = |face: u32| height(segment, across, face, triangles);
    let face = *segment
        .hosts
        .iter()
        .filter(|f| **f != NO_FACE)
        .max_by(|a, b| height(**a).abs().total_cmp(&height(**b).abs()))?;
    Some(if height(face) > 0.0 { -across } else { across })
}

/// How far a face reaches to the side of a segment, at the corner farthest from it; 0 where that is cut off. A face beyond a needle
/// has corners on the segment's line that are no ends of it.
fn height(segment: &ImageSegment, across: DVec2, face: u32, triangles: &Triangles) -> f64 {
    let corners = triangles.mesh.triangles[face as usize].into_iter();
    let others = corners.filter(|v| !segment.ends.contains(v));
    let height = |v: u32| (triangles.view.points[v as usize] - segment.a).truncate().dot(across);
    let farthest = others.map(height).max_by(|a, b| a.abs().total_cmp(&b.abs()));
    farthest.filter(|h| h.is_finite()).unwrap_or(0.0)
}
