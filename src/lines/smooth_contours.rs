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
use rustc_hash::FxHashMap;

use super::edge_lines::PartedEdge;
use super::hard_contours;
use super::zero_set::{self, ZeroSet};
use super::{ContourCurve, FeatureLines, FeatureSegment, LineKind};
use crate::mesh::{EdgeArc, FaceId, Mesh, SmoothNormals};
use crate::view::View;

const NONE: u32 = u32::MAX;

/// How many times its own size a face may lie behind the polyhedron's contour.
const LIFT_OF_FACE: f64 = 1.5;
/// The same in units of what a px shows there.
const LIFT_PX: f64 = 1.5;

/// A piece of a contour, with the facing side of the surface on its left, seen from outside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub segment: FeatureSegment,
    /// See [`ContourCurve::advance`].
    pub advance: f32,
}

/// What contours are sought on.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub smooth: &'a SmoothNormals,
    /// n·v, one per smooth vertex.
    pub facing: &'a [f64],
}

/// Adds the contours of all rounded surfaces, curve by curve, and what their hard edges are elsewhere.
/// `facing` is n·v, one per smooth vertex.
pub fn find(
    mesh: &Mesh,
    view: &View,
    smooth: &SmoothNormals,
    facing: &[f64],
    parted: &[PartedEdge],
    lines: &mut FeatureLines,
) {
    let surface = Surface { mesh, view, smooth, facing };
    // Faces without area have no side, but the curve passes through them.
    let set = zero_set::trace(mesh, smooth, facing, |_| true);
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend(set.points.iter().map(|p| EdgeArc::over(mesh, smooth, p.between).at(p.t)));
    let position = |end: u32| lines.position(mesh, end);
    let mut pieces: Vec<Piece> =
        set.segments.iter().map(|s| surface.piece(&set, s, first, position)).collect();
    let mut others = Vec::new();
    for edge in parted {
        hard_contours::add(&surface, edge, &set, first, &mut pieces, &mut others);
    }
    lines.segments.extend(others);
    for (order, closed) in curves(&pieces) {
        let start = lines.segments.len() as u32;
        lines.segments.extend(order.iter().map(|p| pieces[*p as usize].segment));
        let advance = order.iter().map(|p| pieces[*p as usize].advance).collect();
        lines.curves.push(ContourCurve { segments: start..lines.segments.len() as u32, closed, advance });
    }
}

impl Surface<'_> {
    fn piece(
        &self,
        set: &ZeroSet,
        piece: &zero_set::ZeroSegment,
        first: u32,
        position: impl Fn(u32) -> DVec3,
    ) -> Piece {
        let ends = piece.ends.map(|end| first + end);
        let [a, b] = ends.map(position);
        let normal = |end: u32| {
            let point = &set.points[end as usize];
            let [n, m] = point.between.map(|v| self.smooth.normals[v as usize]);
            n.lerp(m, point.t)
        };
        // The sign of the radial curvature (DeCarlo et al. 2003, section 2), taken from the piece
        // itself, so that it changes exactly where its image turns back.
        let outward = normal(piece.ends[0]) + normal(piece.ends[1]);
        let across = outward.cross(b - a).dot(self.view.frame.to_eye((a + b) / 2.0));
        // What leaves the surface of the normals comes from the mesh and says nothing.
        let astray = outward.dot(b - a).abs();
        let said = (1.0 - astray / across.abs().max(f64::MIN_POSITIVE)).max(0.0);
        let advance = (said * across.signum()) as f32;
        Piece { segment: self.segment(ends, [piece.face; 2], true), advance }
    }

    /// A piece of contour between faces.
    pub fn segment(&self, ends: [u32; 2], hosts: [u32; 2], smooth: bool) -> FeatureSegment {
        let mesh = self.mesh;
        let face = hosts[0] as usize;
        FeatureSegment {
            ends,
            hosts,
            kind: LineKind::Contour,
            both_seen: false,
            smooth,
            lift: hosts.map(|face| self.lift(face)).into_iter().fold(0.0, f32::max),
            strength: 0.0,
            part: mesh.face_part[face],
            material: mesh.face_material[face],
        }
    }

    /// How far faces that stand for the same surface may lie before it, world units.
    fn lift(&self, face: u32) -> f32 {
        let frame = &self.view.frame;
        let corners = self.mesh.corners(FaceId(face));
        let sides = [0, 1, 2].map(|k| corners[k].distance_squared(corners[(k + 1) % 3]));
        let longest = sides.into_iter().fold(0.0, f64::max).sqrt();
        let depth = if frame.perspective { frame.depth(corners[0]).max(0.0) } else { 1.0 };
        let px = frame.width.max(frame.height) / 1000.0 * depth / frame.scale;
        (LIFT_OF_FACE * longest + LIFT_PX * px) as f32
    }
}

/// The pieces in the order in which curves pass them, and whether each curve closes. Where more than
/// one piece leaves a point, the earlier ones go on.
fn curves(pieces: &[Piece]) -> Vec<(Vec<u32>, bool)> {
    let mut leaving: FxHashMap<u32, u32> = FxHashMap::default();
    let mut next_leaving = vec![NONE; pieces.len()];
    let mut arriving: FxHashMap<u32, u32> = FxHashMap::default();
    for (p, piece) in pieces.iter().enumerate().rev() {
        let [from, to] = piece.segment.ends;
        next_leaving[p] = leaving.insert(from, p as u32).unwrap_or(NONE);
        *arriving.entry(to).or_default() += 1;
    }
    let mut used = vec![false; pieces.len()];
    let mut found = Vec::new();
    // Open curves begin where nothing arrives; what they leave is closed.
    for open in [true, false] {
        for start in 0..pieces.len() as u32 {
            let begin = pieces[start as usize].segment.ends[0];
            if used[start as usize] || (open && arriving.contains_key(&begin)) {
                continue;
            }
            let mut order = Vec::new();
            let mut at = start;
            while at != NONE {
                used[at as usize] = true;
                order.push(at);
                let mut next = leaving.get(&pieces[at as usize].segment.ends[1]).copied().unwrap_or(NONE);
                while next != NONE && used[next as usize] {
                    next = next_leaving[next as usize];
                }
                at = next;
            }
            let last = order[order.len() - 1];
            found.push((order, pieces[last as usize].segment.ends[1] == begin));
        }
    }
    found
}
