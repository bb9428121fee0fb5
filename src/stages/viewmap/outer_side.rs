//! [`OuterSides`]: lines just beside a segment, on the sides that none of its own faces covers. They show whether there is
//! background there.
//!
//! A contour and a border have one such side, a crease between two faces that are seen has none. A segment whose faces are all
//! edge-on has two.

use glam::{DVec2, DVec3};

use super::graph::ViewVertexKind;
use super::layers::sweep;
use super::limits::Limits;
use super::occlude::{Interval, covered};
use super::occluders::{Occluder, Triangles};
use super::project::ImageSegment;
use crate::lines::NO_FACE;
use crate::mesh::Mesh;
use crate::view::View;

/// A segment, moved a little to one side.
#[derive(Debug, Clone, Copy)]
pub(super) struct OuterSide {
    line: [DVec2; 2],
    shift: DVec2,
}

/// The sides of a segment that none of its own faces covers: to the left and to the right of its direction in the image (y
/// down).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct OuterSides(pub [Option<OuterSide>; 2]);

impl OuterSides {
    /// Those of a segment; none if it has no length or no own face.
    pub(super) fn of(segment: &ImageSegment, triangles: &Triangles) -> Self {
        let Triangles { mesh, view, limits, .. } = triangles;
        let Some(across) = across(segment) else { return Self::default() };
        let covered = own_cover(segment, across, mesh, view, limits.beside);
        let side = |is_covered: bool, shift: DVec2| {
            (!is_covered)
                .then(|| OuterSide { line: [segment.a, segment.b].map(|end| end.truncate() + shift), shift })
        };
        Self([side(covered[0], -across * limits.beside), side(covered[1], across * limits.beside)])
    }

    /// Those that there are.
    pub(super) fn open(&self) -> impl Iterator<Item = (usize, &OuterSide)> {
        self.0.iter().enumerate().filter_map(|(k, side)| Some((k, side.as_ref()?)))
    }
}

impl OuterSide {
    /// The ends of the part of it that lies beside two points of the segment.
    #[inline]
    pub(super) fn beside(&self, from: DVec3, to: DVec3) -> [DVec2; 2] {
        [from, to].map(|end| end.truncate() + self.shift)
    }

    /// The range of the segment's parameters beside which a triangle lies.
    #[inline]
    pub(super) fn range(&self, triangle: &Occluder, limits: &Limits) -> Option<(f64, f64)> {
        covered(self.line[0], self.line[1], &triangle.corners, limits)
    }
}

/// Whether the own faces of a segment leave a side of it open, so that there may be background beside it.
pub(super) fn may_bound(segment: &ImageSegment, mesh: &Mesh, view: &View, beside: f64) -> bool {
    across(segment).is_some_and(|across| own_cover(segment, across, mesh, view, beside) != [true; 2])
}

/// A range of parameters beside which a surface lies.
pub(super) fn backdrop(start: f64, end: f64) -> Interval {
    let kind = ViewVertexKind::Backdrop;
    Interval { start, end, start_kind: kind, end_kind: kind }
}

/// What two sets of ranges have in common, ascending.
pub(super) fn common(
    mut first: Vec<Interval>,
    mut second: Vec<Interval>,
) -> impl Iterator<Item = (f64, f64)> {
    let union = |intervals: &mut Vec<Interval>| {
        let mut layers = Vec::new();
        sweep(intervals, &[], 0.0, false, &mut layers);
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

/// The unit vector to the right of a segment, with y down.
fn across(segment: &ImageSegment) -> Option<DVec2> {
    (segment.b - segment.a).truncate().perp().try_normalize()
}

/// Whether the own faces of a segment cover its left side and its right side. Both count as covered if it has no own face.
fn own_cover(segment: &ImageSegment, across: DVec2, mesh: &Mesh, view: &View, beside: f64) -> [bool; 2] {
    let mut cover = [false; 2];
    let hosts = || segment.hosts.into_iter().filter(|face| *face != NO_FACE);
    if hosts().next().is_none() {
        return [true; 2];
    }
    for face in hosts() {
        let corners = mesh.triangles[face as usize];
        let others = corners.into_iter().filter(|v| !segment.ends.contains(v));
        for corner in others {
            let height = (view.points[corner as usize] - segment.a).truncate().dot(across);
            if height.is_finite() {
                cover[0] |= height < -beside;
                cover[1] |= height > beside;
            } else {
                // The near plane cuts the face: its winding shows on which side of an edge of its own it lies.
                match winding_side(segment.ends, corners, view.facing[face as usize]) {
                    Some(side) => cover[side] = true,
                    None => cover = [true; 2],
                }
            }
        }
    }
    cover
}

/// The side of one of its edges on which a face lies in the image; `None` if the edge is none of its own.
fn winding_side(ends: [u32; 2], corners: [u32; 3], is_facing: bool) -> Option<usize> {
    let place = |end: u32| corners.iter().position(|v| *v == end);
    let (from, to) = (place(ends[0])?, place(ends[1])?);
    let runs_forward = (from + 1) % 3 == to;
    // A face that turns its outside to the eye runs counterclockwise, and lies to the left of its edges.
    Some(usize::from(runs_forward != is_facing))
}
