//! [`OuterSides`]: lines slightly next to a segment, on the sides that its own faces leave open. They show
//! whether background is there.
//!
//! A contour or a border has one such side. A crease between two visible faces has none. A segment whose
//! faces are all edge-on has two.

use glam::{DVec2, DVec3};

use super::interval_sweep::sweep;
use super::tiled_triangles::TiledTriangles;
use super::triangle_occlusion::{Interval, covered};
use crate::visibility::graph::ViewVertexKind;
use crate::visibility::projection::host_sides::HostedLine;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::view_tolerances::ViewTolerances;

/// Segment shifted slightly to one side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OuterSide {
    line: [DVec2; 2],
    shift: DVec2,
}

/// Open sides of a segment: to the left and to the right of its direction in the image (y down).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct OuterSides([Option<OuterSide>; 2]);

impl OuterSides {
    /// Open sides of a segment; none if it has no length or no own face.
    pub(crate) fn of(segment: &ImageSegment, triangles: &TiledTriangles) -> Self {
        let TiledTriangles { mesh, view, limits, .. } = triangles;
        let ImageSegment { a, b, ends, hosts, .. } = *segment;
        let hosted = HostedLine { line: [a, b], ends, hosts };
        let Some(across) = hosted.across() else { return Self::default() };
        let covered = hosted.covered_sides(across, mesh, view, limits.side_offset);
        let side = |is_covered: bool, shift: DVec2| {
            (!is_covered)
                .then(|| OuterSide { line: [segment.a, segment.b].map(|end| end.truncate() + shift), shift })
        };
        Self([side(covered[0], -across * limits.side_offset), side(covered[1], across * limits.side_offset)])
    }

    /// Iterates over the open sides.
    pub(crate) fn open(&self) -> impl Iterator<Item = &OuterSide> {
        self.0.iter().flatten()
    }
}

impl OuterSide {
    /// Ends of the shifted line next to two points of the segment.
    #[inline]
    pub(crate) fn shifted_ends(&self, from: DVec3, to: DVec3) -> [DVec2; 2] {
        [from, to].map(|end| end.truncate() + self.shift)
    }

    /// Range of the segment's parameter where a triangle lies next to it on this side.
    #[inline]
    pub(crate) fn range(&self, corners: &[DVec3; 3], limits: &ViewTolerances) -> Option<(f64, f64)> {
        covered(self.line[0], self.line[1], corners, limits)
    }
}

/// Interval where a surface lies next to the segment.
pub(crate) fn backdrop(start: f64, end: f64) -> Interval {
    let kind = ViewVertexKind::Backdrop;
    Interval { start, end, start_kind: kind, end_kind: kind }
}

/// Intersection of two sets of ranges, ascending.
pub(crate) fn common(
    mut first: Vec<Interval>,
    mut second: Vec<Interval>,
) -> impl Iterator<Item = (f64, f64)> {
    let union = |intervals: &mut Vec<Interval>| {
        let mut layers = Vec::new();
        sweep(intervals, 0.0, false, &mut layers);
        layers
    };
    let (first, second) = (union(&mut first), union(&mut second));
    first.into_iter().flat_map(move |one| {
        let Interval { start, end, .. } = one.interval;
        let from = second.partition_point(|other| other.interval.end <= start);
        let others: Vec<(f64, f64)> = second[from..]
            .iter()
            .map(|other| (other.interval.start, other.interval.end))
            .take_while(|other| other.0 < end)
            .map(|other| (other.0.max(start), other.1.min(end)))
            .collect();
        others
    })
}
