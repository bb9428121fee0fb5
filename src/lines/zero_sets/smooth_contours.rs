//! Smooth contours of rounded surfaces: the zero set of n·v, joined into curves.
//!
//! On a mesh that approximates a rounded surface, the contour of the polyhedron zigzags along edges. The zero
//! set of the interpolated n·v crosses the faces as a smooth curve. This curve gives the shape; its
//! visibility follows from the mesh contour ([`crate::lines::Role::MeshContour`]).
//!
//! Source: Aaron Hertzmann and Denis Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, sections 4.1 and
//! 4.2. Deviation: points lie on arcs over the edges, and not on the edges themselves.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::zero_set::{self, EdgePoint, ZeroSet};
use crate::lines::{ContourCurve, FeatureLines, FeatureSegment, LineKind, Role};
use crate::mesh::Mesh;
use crate::surface::{EdgeArc, SmoothNormals};
use crate::view::View;

const NO_PIECE: u32 = u32::MAX;

/// Minimum number of points or pieces per task.
const MIN_ITEMS_PER_TASK: usize = 1 << 7;

/// Piece of a contour, with the facing side of the surface on its left, seen from outside.
#[derive(Debug, Clone, Copy)]
struct ContourPiece {
    segment: FeatureSegment,
    /// See [`ContourCurve::advance`].
    advance: f32,
}

/// Smooth contours of all rounded surfaces, and no other lines. `facing` is n·v, one per smooth vertex.
#[must_use]
pub(crate) fn find(mesh: &Mesh, view: &View, smooth: &SmoothNormals, facing: &[f64]) -> FeatureLines {
    // Degenerate faces have no side, but curves pass through them.
    let set = zero_set::trace(mesh, smooth, facing, |_| true);
    let first = mesh.positions.len() as u32;
    let point = |p: &EdgePoint| EdgeArc::over(mesh, smooth, p.between).at(p.t);
    let points: Vec<DVec3> = set.points.par_iter().with_min_len(MIN_ITEMS_PER_TASK).map(point).collect();
    let mut lines = FeatureLines { points, ..FeatureLines::default() };
    let position = |end: u32| lines.position(mesh, end);
    let pieces: Vec<ContourPiece> = set
        .segments
        .par_iter()
        .with_min_len(MIN_ITEMS_PER_TASK)
        .map(|s| {
            let ends = s.ends.map(|end| first + end);
            let advance = advance(view, smooth, &set, s.ends, ends.map(position));
            ContourPiece { segment: segment(mesh, ends, s.face), advance }
        })
        .collect();
    for (order, closed) in curves(&pieces, first) {
        let start = lines.segments.len() as u32;
        lines.segments.extend(order.iter().map(|p| pieces[*p as usize].segment));
        let advance = order.iter().map(|p| pieces[*p as usize].advance).collect();
        lines.curves.push(ContourCurve { segments: start..lines.segments.len() as u32, closed, advance });
    }
    lines
}

/// Sign of the radial curvature (DeCarlo et al. 2003, section 2), with a confidence. It is taken from the
/// piece itself, so that it changes exactly where the image of the piece turns back.
fn advance(view: &View, smooth: &SmoothNormals, set: &ZeroSet, ends: [u32; 2], [a, b]: [DVec3; 2]) -> f32 {
    let normal = |end: u32| {
        let point = &set.points[end as usize];
        let [n, m] = point.between.map(|v| smooth.normals[v as usize]);
        n.lerp(m, point.t)
    };
    let outward = normal(ends[0]) + normal(ends[1]);
    let across = outward.cross(b - a).dot(view.frame.to_eye((a + b) / 2.0));
    // The part of the piece along the normal is an artefact of the mesh, and lowers the confidence.
    let astray = outward.dot(b - a).abs();
    let said = (1.0 - astray / across.abs().max(f64::MIN_POSITIVE)).max(0.0);
    (said * across.signum()) as f32
}

/// Piece of a contour on a face.
fn segment(mesh: &Mesh, ends: [u32; 2], face: u32) -> FeatureSegment {
    FeatureSegment {
        both_seen: false,
        smooth: true,
        role: Role::SmoothContour,
        strength: 0.0,
        ..FeatureSegment::on_face(mesh, face, [face; 2], LineKind::Contour, ends)
    }
}

/// Curves as ordered pieces, and whether each is closed. Point ids start at `first`. Where several pieces
/// leave a point, the earliest unused one continues.
fn curves(pieces: &[ContourPiece], first: u32) -> Vec<(Vec<u32>, bool)> {
    let ends = |piece: &ContourPiece| piece.segment.ends.map(|end| (end - first) as usize);
    let count = pieces.iter().flat_map(ends).max().map_or(0, |last| last + 1);
    let mut leaving = vec![NO_PIECE; count];
    let mut next_leaving = vec![NO_PIECE; pieces.len()];
    let mut is_reached = vec![false; count];
    for (p, piece) in pieces.iter().enumerate().rev() {
        let [from, to] = ends(piece);
        next_leaving[p] = std::mem::replace(&mut leaving[from], p as u32);
        is_reached[to] = true;
    }
    let mut used = vec![false; pieces.len()];
    let mut found = Vec::new();
    // Open curves start where no piece arrives; the rest are closed.
    for open in [true, false] {
        for start in 0..pieces.len() as u32 {
            let [begin, _] = ends(&pieces[start as usize]);
            if used[start as usize] || (open && is_reached[begin]) {
                continue;
            }
            let mut order = Vec::new();
            let mut at = start;
            while at != NO_PIECE {
                used[at as usize] = true;
                order.push(at);
                let mut next = leaving[ends(&pieces[at as usize])[1]];
                while next != NO_PIECE && used[next as usize] {
                    next = next_leaving[next as usize];
                }
                at = next;
            }
            let last = order[order.len() - 1];
            found.push((order, ends(&pieces[last as usize])[1] == begin));
        }
    }
    found
}
