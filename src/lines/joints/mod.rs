//! Joints: lines where parts of one material meet and their surfaces continue in one plane. A style may leave
//! them out.
//!
//! A joint is no edge of the union of the parts in any view, so the faces around the line in space decide:
//!
//! 1. The faces that reach a line are those whose plane holds a stretch of it and that cover one side of it,
//!    or both.
//! 2. The line is cut where such a stretch ends.
//! 3. On each piece the faces are rays in the plane across the line. They show whether a surface ends or
//!    turns there.
//!
//! An edge that is a joint for a part of its length keeps the rest.
//!
//! Files, in reading order: [`joint_pieces`] faces near a line and its pieces; [`ray_fan`] the test of one
//! piece.

mod joint_pieces;
mod ray_fan;

use std::ops::Range;

use crate::parallel::prelude::*;
use glam::DVec3;

use self::joint_pieces::{JointFaces, JointPiece};
use super::{FeatureLines, FeatureSegment, LineKind, Role};
use crate::mesh::Mesh;

/// Maximum number of face tests in total, and the minimum budget per line. A line with more faces nearby is
/// kept.
const MAX_FACE_TESTS: usize = 100_000_000;
const MIN_TESTS_PER_LINE: usize = 1000;

/// Removes the joints from the lines of a view. `kinds` holds a number per paint; parts of one kind look the
/// same.
///
/// With `keep` joints stay as borders between regions, of kind [`LineKind::Isophote`]. Their indices are
/// returned, ascending.
pub(crate) fn remove_joints(mesh: &Mesh, lines: &mut FeatureLines, kinds: &[u32], keep: bool) -> Vec<u32> {
    let Some(faces) = JointFaces::new(mesh, kinds) else { return Vec::new() };
    let most = (MAX_FACE_TESTS / lines.segments.len().max(1)).max(MIN_TESTS_PER_LINE);
    let pieces: Vec<Option<Vec<JointPiece>>> = lines
        .segments
        .par_iter()
        .map(|segment| {
            let ends = segment.ends.map(|end| lines.position(mesh, end));
            may_be_joint(segment).then(|| faces.pieces(segment.part, ends, most)).flatten()
        })
        .collect();
    if pieces.iter().all(Option::is_none) {
        return Vec::new();
    }
    let first_point = mesh.positions.len() + lines.points.len();
    let mut split = Split { keep, first_point, added: Vec::new(), borders: Vec::new(), points: Vec::new() };
    for (segment, pieces) in lines.segments.iter().zip(&pieces) {
        if let Some(pieces) = pieces {
            let ends = segment.ends.map(|end| lines.position(mesh, end));
            split.add(segment, ends, pieces);
        }
    }
    // Curves contain no lines that are cut, so their segments stay consecutive.
    let mut before = 0u32;
    let places: Vec<u32> = pieces
        .iter()
        .map(|pieces| {
            before += u32::from(pieces.is_none());
            before - u32::from(pieces.is_none())
        })
        .collect();
    let place = |at: u32| places.get(at as usize).copied().unwrap_or(before);
    for curve in &mut lines.curves {
        let Range { start, end } = curve.segments;
        curve.segments = place(start)..place(end);
    }
    let mut own = pieces.iter();
    lines.segments.retain(|_| own.next().is_some_and(Option::is_none));
    lines.segments.append(&mut split.added);
    let first = lines.segments.len() as u32;
    let borders = first..first + split.borders.len() as u32;
    lines.segments.append(&mut split.borders);
    lines.points.append(&mut split.points);
    borders.collect()
}

/// Whether a line of this kind may be a joint.
fn may_be_joint(segment: &FeatureSegment) -> bool {
    use LineKind::{Border, Contour, Crease, Intersection, Material};
    let is_kind = matches!(segment.kind, Contour | Border | Crease | Material | Intersection);
    is_kind && segment.role == Role::Line
}

/// Pieces of the lines that were cut.
struct Split {
    keep: bool,
    first_point: usize,
    added: Vec<FeatureSegment>,
    borders: Vec<FeatureSegment>,
    points: Vec<DVec3>,
}

impl Split {
    fn add(&mut self, segment: &FeatureSegment, [a, b]: [DVec3; 2], pieces: &[JointPiece]) {
        let mut from = segment.ends[0];
        for (number, piece) in pieces.iter().enumerate() {
            let to = if number + 1 == pieces.len() {
                segment.ends[1]
            } else if let Some(vertex) = piece.vertex {
                vertex
            } else {
                self.points.push(a.lerp(b, piece.end));
                (self.first_point + self.points.len() - 1) as u32
            };
            let own = FeatureSegment { ends: [from, to], ..*segment };
            if !piece.is_joint {
                self.added.push(own);
            } else if self.keep {
                self.borders.push(FeatureSegment { kind: LineKind::Isophote, smooth: false, ..own });
            }
            from = to;
        }
    }
}
