//! Contours of rounded surfaces: the zero set of n·v, as curves from end to end.
//!
//! On a mesh whose faces stand for a rounded surface, the contour of the polyhedron zigzags along
//! edges, while the zero set of the interpolated n·v crosses the triangles as one smooth curve.
//! Where it meets a hard edge, that edge goes on as the contour as far as one of its faces is seen
//! and the other is not.
//!
//! Source: Aaron Hertzmann and Denis Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, sections
//! 4.1 and 4.2; the points lie on the arcs over the edges rather than on the edges themselves.

use glam::DVec3;

use super::edge_lines::{EdgeSide, PartedEdge};
use super::zero_set::{self, EdgePoint, ZeroSet};
use super::{ContourCurve, FeatureLines, FeatureSegment, LineKind};
use crate::mesh::{EdgeArc, FaceId, Mesh, SmoothNormals};
use crate::view::View;

const NONE: u32 = u32::MAX;

/// How many times its own size a face may lie behind the polyhedron's contour.
const LIFT_OF_FACE: f64 = 1.5;
/// The same in units of what a px shows there.
const LIFT_PX: f64 = 1.5;

/// Adds the contours of all rounded surfaces, curve by curve, and the pieces of the hard edges that
/// are contours in part. `facing` is n·v, one per smooth vertex.
pub fn find(
    mesh: &Mesh,
    view: &View,
    smooth: &SmoothNormals,
    facing: &[f64],
    parted: &[PartedEdge],
    lines: &mut FeatureLines,
) {
    // Faces without area have no side, but the curve passes through them.
    let set = zero_set::trace(mesh, smooth, facing, |_| true);
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend(set.points.iter().map(|p| on_arc(mesh, smooth, p)));
    for (order, closed) in curves(&set) {
        let start = lines.segments.len() as u32;
        lines.segments.extend(order.iter().map(|s| segment(mesh, view, &set, *s, first)));
        let backward = order.iter().map(|s| is_backward(mesh, view, smooth, &set, *s, first, lines)).collect();
        lines.curves.push(ContourCurve { segments: start..lines.segments.len() as u32, closed, backward });
    }
    for edge in parted {
        part(edge, &set, facing, first, &mut lines.segments);
    }
}

/// The point of the rounded surface over an edge.
fn on_arc(mesh: &Mesh, smooth: &SmoothNormals, point: &EdgePoint) -> DVec3 {
    let position = |v: u32| mesh.positions[smooth.vertices[v as usize] as usize];
    let normal = |v: u32| smooth.normals[v as usize];
    EdgeArc::new(point.between.map(position), point.between.map(normal)).at(point.t)
}

/// Whether the averted side of the surface is the nearer one along a piece: the sign of the radial
/// curvature (DeCarlo et al. 2003, section 2), taken from the piece itself, so that it changes
/// exactly where its image turns back.
fn is_backward(
    mesh: &Mesh,
    view: &View,
    smooth: &SmoothNormals,
    set: &ZeroSet,
    segment: u32,
    first: u32,
    lines: &FeatureLines,
) -> bool {
    let ends = set.segments[segment as usize].ends;
    let [a, b] = ends.map(|end| lines.position(mesh, first + end));
    let normal = |end: u32| {
        let point = &set.points[end as usize];
        let [n, m] = point.between.map(|v| smooth.normals[v as usize]);
        n.lerp(m, point.t)
    };
    let to_facing = (normal(ends[0]) + normal(ends[1])).cross(b - a);
    to_facing.dot(view.frame.to_eye((a + b) / 2.0)) < 0.0
}

fn segment(mesh: &Mesh, view: &View, set: &ZeroSet, segment: u32, first: u32) -> FeatureSegment {
    let piece = set.segments[segment as usize];
    let corners = mesh.corners(FaceId(piece.face));
    let longest = [0, 1, 2].map(|k| corners[k].distance_squared(corners[(k + 1) % 3]));
    let longest = longest.into_iter().fold(0.0, f64::max).sqrt();
    let depth = if view.frame.perspective { view.frame.depth(corners[0]).max(0.0) } else { 1.0 };
    let px = view.frame.width.max(view.frame.height) / 1000.0 * depth / view.frame.scale;
    FeatureSegment {
        ends: piece.ends.map(|end| first + end),
        hosts: [piece.face; 2],
        kind: LineKind::Contour,
        both_seen: false,
        smooth: true,
        lift: (LIFT_OF_FACE * longest + LIFT_PX * px) as f32,
        strength: 0.0,
        part: mesh.face_part[piece.face as usize],
        material: mesh.face_material[piece.face as usize],
    }
}

/// The pieces of a zero set in the order in which curves pass them, and whether each curve closes.
fn curves(set: &ZeroSet) -> Vec<(Vec<u32>, bool)> {
    let mut leaving = vec![NONE; set.points.len()];
    let mut arriving = vec![false; set.points.len()];
    for (s, piece) in set.segments.iter().enumerate() {
        leaving[piece.ends[0] as usize] = s as u32;
        arriving[piece.ends[1] as usize] = true;
    }
    let mut used = vec![false; set.segments.len()];
    let mut found = Vec::new();
    // Open curves begin where nothing arrives; what they leave is closed.
    for open in [true, false] {
        for start in 0..set.segments.len() as u32 {
            let begin = set.segments[start as usize].ends[0];
            if used[start as usize] || (open && arriving[begin as usize]) {
                continue;
            }
            let mut order = Vec::new();
            let mut at = start;
            while at != NONE && !used[at as usize] {
                used[at as usize] = true;
                order.push(at);
                at = leaving[set.segments[at as usize].ends[1] as usize];
            }
            found.push((order, !open && at == start));
        }
    }
    found
}

/// Cuts a hard edge where one of its sides turns, and adds the pieces.
fn part(edge: &PartedEdge, set: &ZeroSet, facing: &[f64], first: u32, segments: &mut Vec<FeatureSegment>) {
    let facing_at = |side: EdgeSide, end: usize| match side {
        EdgeSide::Flat(facing) => facing,
        EdgeSide::Rounded(corners) => facing[corners[end] as usize] >= 0.0,
    };
    // Where each side turns: parameter along the edge, end id.
    let mut cuts: Vec<(f64, u32, usize)> = Vec::with_capacity(2);
    for (which, side) in edge.sides.iter().enumerate() {
        let EdgeSide::Rounded([a, b]) = *side else { continue };
        let between = [a.min(b), a.max(b)];
        if let Ok(id) = set.points.binary_search_by_key(&between, |p| p.between) {
            let t = set.points[id].t;
            cuts.push((if a < b { t } else { 1.0 - t }, first + id as u32, which));
        }
    }
    cuts.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    let mut now = edge.sides.map(|side| facing_at(side, 0));
    let mut from = edge.contour.ends[0];
    let mut push = |from: u32, to: u32, now: [bool; 2]| {
        let is_contour = (now[0] != now[1]) != edge.same_way;
        let line = if is_contour { Some(edge.contour) } else { edge.else_line };
        segments.extend(line.map(|line| FeatureSegment { ends: [from, to], ..line }));
    };
    for (_, point, which) in cuts {
        push(from, point, now);
        now[which] = !now[which];
        from = point;
    }
    push(from, edge.contour.ends[1], now);
}
