//! [`ContourSpurs`]: contour spurs, where the mesh contour leaves the smooth contour for a few edges and returns to
//! the same place.
//!
//! Thin faces seen edge-on stick out of the contour like saw teeth, and often only one side of a tooth is
//! visible. The smooth contour passes below and replaces them.

use crate::parallel::prelude::*;

use super::contour_matching::{ContourMatcher, ContourPosition};
use crate::lines::Role;
use crate::visibility::projection::image_segments::ImageSegment;

/// Largest number of edges of a spur.
const MAX_SPUR_EDGES: usize = 12;

/// Graph of the mesh contour, visible and hidden parts alike.
pub(crate) struct ContourSpurs<'a> {
    matcher: &'a ContourMatcher<'a>,
    segments: &'a [ImageSegment],
    /// Vertices with the mesh contour segments that end there, sorted by vertex.
    ends: Vec<(u32, u32)>,
}

impl<'a> ContourSpurs<'a> {
    pub(crate) fn new(court: &'a ContourMatcher<'a>, segments: &'a [ImageSegment]) -> Self {
        let mesh_contours =
            segments.iter().enumerate().filter(|(_, s)| matches!(s.role, Role::MeshContour { .. }));
        let mut ends: Vec<(u32, u32)> =
            mesh_contours.flat_map(|(id, s)| s.ends.map(|end| (end, id as u32))).collect();
        ends.par_sort_unstable();
        Self { matcher: court, segments, ends }
    }

    /// Whether a mesh contour segment is part of a spur. `is_seen(chain, from, to)` must hold for the curve
    /// along its base.
    pub(crate) fn contains(&self, id: u32, is_seen: impl Fn(u32, f64, f64) -> bool) -> bool {
        let Some((p, first_distance)) = self.walk(id, 0) else { return false };
        let Some((q, second_distance)) = self.walk(id, 1) else { return false };
        let total_length = first_distance + second_distance + self.segments[id as usize].length();
        p.chain == q.chain
            && self.matcher.contour_chains[p.chain as usize].between(p.arc_length, q.arc_length)
                <= total_length
            && { is_seen(p.chain, p.arc_length.min(q.arc_length), p.arc_length.max(q.arc_length)) }
    }

    /// First place on a curve along the mesh contour from one end of a segment, with the distance to it.
    fn walk(&self, id: u32, end: usize) -> Option<(ContourPosition, f64)> {
        let mut distance = 0.0;
        let (mut at, mut vertex) = (id, self.segments[id as usize].ends[end]);
        let mut passed = vec![id];
        while passed.len() <= MAX_SPUR_EDGES {
            let segment = &self.segments[at as usize];
            let point = if segment.ends[0] == vertex { segment.a } else { segment.b };
            if let Some(position) = self.matcher.match_point(segment, point) {
                return Some((position, distance));
            }
            let first = self.ends.partition_point(|(of, _)| *of < vertex);
            let vertex_ends = self.ends[first..].iter().take_while(|(of, _)| *of == vertex);
            let next = vertex_ends.map(|(_, id)| *id).find(|id| !passed.contains(id))?;
            let ends = self.segments[next as usize].ends;
            vertex = if ends[0] == vertex { ends[1] } else { ends[0] };
            distance += self.segments[next as usize].length();
            at = next;
            passed.push(next);
        }
        None
    }
}
