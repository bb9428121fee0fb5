//! Edges in planes where surfaces overlap, such as the rim of a label on a wall: splits them and decides
//! the kind of line of each piece.
//!
//! Mesh connectivity gives the wrong kind there. The rim of the label has only one face, but in the image
//! it is a boundary between two materials and no border. The same holds for the rim of a body that is let
//! into the wall. A rim below another surface of its plane is not drawn.
//!
//! 1. Two test lines run parallel to the edge in its plane, at a small distance on either side. The faces
//!    that cover them are found.
//! 2. The edge is cut where the topmost face on either side changes. `Mesh::overlays` gives the stacking
//!    order.
//! 3. Each piece gets its kind from the topmost faces on its two sides.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::lines::{FeatureLines, FeatureSegment, LineKind, LineOptions, NO_FACE, Role};
use crate::mesh::bvh::box_tree::BoxTree;
use crate::mesh::{FaceId, Mesh, VertexId};
use crate::view::View;

/// Distance of the test lines from their edge, in multiples of the part's contact tolerance.
const PROBE_OFFSET_CONTACTS: f64 = 4.0;

/// Minimum length of a piece, in multiples of the distance between edge and test line. Shorter pieces are
/// artefacts of the test.
const MIN_PIECE_OFFSETS: f64 = 8.0;

/// Pieces of edges in overlapping planes, with their new kinds.
#[derive(Default)]
pub(crate) struct OverlapLines {
    /// Ends from the number of mesh vertices on are indices into `points`, offset by that number.
    pieces: Vec<FeatureSegment>,
    /// Points where edges are cut.
    points: Vec<DVec3>,
}

/// Whether the mesh has overlapping surfaces. Borders are then needed even if they are not drawn.
pub(crate) fn has_overlaps(mesh: &Mesh) -> bool {
    !mesh.overlays.is_empty()
}

/// Removes the edges in planes where surfaces overlap, and returns their pieces with new kinds. Segments
/// and pieces of kinds that are not in `options` are dropped.
pub(crate) fn classify_overlaps(
    mesh: &Mesh,
    view: &View,
    segments: &mut Vec<FeatureSegment>,
    options: &LineOptions,
) -> OverlapLines {
    let is_overlaid: Vec<bool> = mesh.overlays.iter().map(|overlay| overlay.plane != 0).collect();
    let half = DVec3::splat(mesh.extents.diagonal / 2.0);
    let (low, high) = (mesh.extents.middle - half, mesh.extents.middle + half);
    let faces = &BoxTree::new(&mesh.positions, &mesh.triangles, &is_overlaid, low, high);
    let is_wanted = |kind: LineKind| options.kinds.contains(&kind);
    let new_pieces: Vec<Option<Vec<OverlapPiece>>> = segments
        .par_iter()
        .map(|segment| {
            let [host, second_host] = hosts_in_planes(mesh, view, segment);
            let pieces_in = |host: u32| Some(EdgeProbe::new(mesh, segment, host)?.pieces(faces));
            let mut pieces = pieces_in(host?)?;
            if let Some(more) = second_host.and_then(pieces_in) {
                pieces = merge_planes(&pieces, &more);
            }
            // An edge that keeps its kind throughout stays unchanged.
            let is_one =
                matches!(pieces.as_slice(), [piece] if piece.is_whole() && piece.kind == segment.kind);
            (!is_one).then_some(pieces)
        })
        .collect();
    let mut overlaid = OverlapLines::default();
    for (segment, pieces) in segments.iter().zip(&new_pieces) {
        let pieces = pieces.iter().flatten().filter(|piece| is_wanted(piece.kind));
        overlaid.add(mesh, segment, pieces);
    }
    let mut pieces_of_segment = new_pieces.into_iter();
    segments.retain(|segment| pieces_of_segment.next().flatten().is_none() && is_wanted(segment.kind));
    overlaid
}

/// Faces of an edge in whose planes surfaces overlap, if nothing at the edge lies on the camera's side of
/// the plane.
///
/// Such edges are borders, material boundaries in the plane, and edges of a body that continues behind the
/// plane. The last kind may have faces in two such planes.
fn hosts_in_planes(mesh: &Mesh, view: &View, segment: &FeatureSegment) -> [Option<u32>; 2] {
    let [first, second] = segment.hosts;
    match segment.kind {
        LineKind::Border => {
            [Some(first).filter(|face| second == NO_FACE && mesh.overlay(*face).plane != 0), None]
        }
        LineKind::Material if mesh.share_plane(first, second) => [Some(first), None],
        LineKind::Contour | LineKind::Crease | LineKind::Material
            if segment.role == Role::Line && second != NO_FACE =>
        {
            let goes_behind = |host: u32, opposite: u32| {
                let [a, b, c] = mesh.corners(FaceId(host));
                let normal = (b - a).cross(c - a).normalize_or_zero();
                let heights = mesh.corners(FaceId(opposite)).map(|corner| (corner - a).dot(normal));
                let height =
                    heights.into_iter().max_by(|p, q| p.abs().total_cmp(&q.abs())).unwrap_or_default();
                height * view.frame.to_eye(a).dot(normal) < 0.0
            };
            let mut hosts = [[first, second], [second, first]].into_iter().filter(|[plane_face, other]| {
                let is_alone = mesh.overlay(*plane_face).plane != 0 && !mesh.share_plane(*plane_face, *other);
                is_alone && goes_behind(*plane_face, *other)
            });
            [hosts.next().map(|[own, _]| own), hosts.next().map(|[own, _]| own)]
        }
        _ => [None; 2],
    }
}

/// Merges the pieces of an edge in two planes: it is a material boundary where it is one in either plane.
fn merge_planes(first: &[OverlapPiece], second: &[OverlapPiece]) -> Vec<OverlapPiece> {
    let mut cuts: Vec<f64> = first.iter().chain(second).flat_map(|piece| [piece.start, piece.end]).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let mut pieces: Vec<OverlapPiece> = Vec::new();
    for pair in cuts.windows(2) {
        let (start, end) = (pair[0], pair[1]);
        let covering = || first.iter().chain(second).filter(|piece| piece.start <= start && piece.end >= end);
        let material_piece = covering().find(|piece| piece.kind == LineKind::Material);
        let Some(&OverlapPiece { kind, outer_face: outer, .. }) =
            material_piece.or_else(|| covering().next())
        else {
            continue;
        };
        match pieces.last_mut().filter(|last| last.end == start && last.kind == kind) {
            Some(last) => last.end = end,
            None => pieces.push(OverlapPiece { start, end, kind, outer_face: outer }),
        }
    }
    pieces
}

impl OverlapLines {
    /// Adds the pieces of a segment. Consecutive pieces share their cut point.
    fn add<'a>(
        &mut self,
        mesh: &Mesh,
        segment: &FeatureSegment,
        pieces: impl Iterator<Item = &'a OverlapPiece>,
    ) {
        let [a, b] = segment.ends.map(|v| mesh.positions[VertexId(v).index()]);
        let mut last: Option<(f64, u32)> = None;
        for piece in pieces {
            let mut end = |t: f64, fallback: u32| {
                if t <= 0.0 || t >= 1.0 {
                    return fallback;
                }
                if let Some((_, id)) = last.filter(|(at, _)| *at == t) {
                    return id;
                }
                self.points.push(a.lerp(b, t));
                let id = (mesh.positions.len() + self.points.len() - 1) as u32;
                last = Some((t, id));
                id
            };
            let ends = [end(piece.start, segment.ends[0]), end(piece.end, segment.ends[1])];
            let is_material = piece.kind == LineKind::Material;
            let [first, second] = segment.hosts;
            self.pieces.push(FeatureSegment {
                ends,
                kind: piece.kind,
                hosts: [first, if second == NO_FACE { piece.outer_face } else { second }],
                both_seen: is_material || segment.both_seen,
                strength: if is_material { 0.0 } else { segment.strength },
                smooth: false,
                ..*segment
            });
        }
    }

    /// Appends the pieces and their points to the feature lines.
    pub(crate) fn append_to(self, mesh: &Mesh, lines: &mut FeatureLines) {
        let vertices = mesh.positions.len() as u32;
        let shift = lines.points.len() as u32;
        lines.points.extend(self.points);
        let moved = |end: u32| if end < vertices { end } else { end + shift };
        let pieces = self.pieces.into_iter();
        lines.segments.extend(pieces.map(|piece| FeatureSegment { ends: piece.ends.map(moved), ..piece }));
    }
}

/// Piece of an edge that is drawn as a line.
struct OverlapPiece {
    /// Start and end as fractions of the edge.
    start: f64,
    end: f64,
    kind: LineKind,
    /// Topmost face on the outer side of the edge.
    outer_face: u32,
}

impl OverlapPiece {
    fn is_whole(&self) -> bool {
        self.start <= 0.0 && self.end >= 1.0
    }
}

/// Edge in a plane, with the test lines next to it.
struct EdgeProbe<'a> {
    mesh: &'a Mesh,
    /// Face on its inner side, in whose plane surfaces overlap.
    host: u32,
    kind: LineKind,
    /// Whether it is a line within the plane, and not the edge of a body.
    is_flat: bool,
    from: DVec3,
    /// Unit vectors along the edge, and from it into the host face.
    along: DVec3,
    inward: DVec3,
    length: f64,
    /// Distance of the test lines from the edge, world units.
    probe_offset: f64,
}

impl<'a> EdgeProbe<'a> {
    fn new(mesh: &'a Mesh, segment: &FeatureSegment, host: u32) -> Option<Self> {
        let [a, b] = segment.ends.map(|v| mesh.positions[VertexId(v).index()]);
        let along = (b - a).try_normalize()?;
        // Next to a degenerate face, other corners of the host may lie on the line of the edge too.
        let over = mesh.corners(FaceId(host)).map(|corner| (corner - a) - along * (corner - a).dot(along));
        let inward = over.into_iter().max_by(|p, q| p.length_squared().total_cmp(&q.length_squared()))?;
        let inward = inward.try_normalize()?;
        let probe_distance = PROBE_OFFSET_CONTACTS * mesh.extent(FaceId(host)).contact;
        let [first, second] = segment.hosts;
        let is_flat = second == NO_FACE || mesh.share_plane(first, second);
        let (kind, length) = (segment.kind, a.distance(b));
        Some(Self { mesh, host, kind, is_flat, from: a, along, inward, length, probe_offset: probe_distance })
    }

    /// Pieces that are lines, from end to end. `faces` is a tree of the overlapping faces.
    fn pieces(&self, faces: &BoxTree) -> Vec<OverlapPiece> {
        // Ranges of the two test lines that each face covers.
        let mut covers = [Vec::new(), Vec::new()];
        let to = self.from + self.along * self.length;
        let room = DVec3::splat(2.0 * self.probe_offset);
        faces.near_box(self.from.min(to) - room, self.from.max(to) + room, |face| {
            if !self.mesh.share_plane(self.host, face) {
                return;
            }
            let corners = self.mesh.corners(FaceId(face));
            for (covers, range) in covers.iter_mut().zip(self.covered(&corners)) {
                covers.extend(range.map(|range| (range, face)));
            }
        });
        let mut cuts: Vec<f64> =
            covers.iter().flatten().flat_map(|((start, end), _)| [*start, *end]).collect();
        let min_share = MIN_PIECE_OFFSETS * self.probe_offset / self.length;
        cuts.retain(|t| *t > min_share && *t < 1.0 - min_share);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < min_share);
        let ends: Vec<f64> = [0.0].into_iter().chain(cuts).chain([1.0]).collect();
        let mut pieces: Vec<(OverlapPiece, [u32; 2])> = Vec::new();
        for pair in ends.windows(2) {
            let (start, end) = (pair[0], pair[1]);
            let at = f64::midpoint(start, end);
            let [inner_face, outer_top] = [0, 1].map(|side| self.top(&covers[side], at));
            let Some((kind, outer_face_or_none)) = self.line(inner_face, outer_top) else { continue };
            let rank = |face: u32| self.mesh.overlay(face).rank;
            let sides = [
                inner_face.map_or(u32::MAX, rank),
                if outer_face_or_none == NO_FACE { u32::MAX } else { rank(outer_face_or_none) },
            ];
            match pieces
                .last_mut()
                .filter(|(last, last_ranks)| last.end == start && last.kind == kind && *last_ranks == sides)
            {
                Some((last, _)) => last.end = end,
                None => {
                    pieces.push((OverlapPiece { start, end, kind, outer_face: outer_face_or_none }, sides))
                }
            }
        }
        pieces.into_iter().map(|(piece, _)| piece).collect()
    }

    /// Topmost face of those that cover a position.
    fn top(&self, covers: &[((f64, f64), u32)], at: f64) -> Option<u32> {
        let covering = covers.iter().filter(|((start, end), _)| (*start..=*end).contains(&at));
        covering
            .map(|(_, face)| *face)
            .max_by_key(|face| (self.mesh.overlay(*face).rank, std::cmp::Reverse(*face)))
    }

    /// Kind of line between the topmost faces on both sides, and the outer face. `None` if no line is drawn.
    fn line(&self, inner_face: Option<u32>, outer_face: Option<u32>) -> Option<(LineKind, u32)> {
        let mesh = self.mesh;
        let inner_or_host = inner_face.unwrap_or(self.host);
        let Some(outer) = outer_face else { return Some((self.kind, NO_FACE)) };
        let material = |face: u32| mesh.face_material[face as usize];
        // Edges of bodies are drawn across a surface of their plane, even where the colours are equal.
        if mesh.overlay(inner_or_host).rank == mesh.overlay(outer).rank {
            return (!self.is_flat).then_some((self.kind, outer));
        }
        match (material(inner_or_host) == material(outer), self.kind) {
            (true, LineKind::Material) if self.is_flat => None,
            (true, kind) => Some((kind, outer)),
            (false, _) => Some((LineKind::Material, outer)),
        }
    }

    /// Ranges, in fractions of the edge's length, where a face covers the inner and the outer test line.
    fn covered(&self, corners: &[DVec3; 3]) -> [Option<(f64, f64)>; 2] {
        let heights = corners.map(|p| (p - self.from).dot(self.inward));
        let [low, high] =
            [heights[0].min(heights[1]).min(heights[2]), heights[0].max(heights[1]).max(heights[2])];
        // Early exit: most faces of a large plane lie far to one side.
        if high < -self.probe_offset || low > self.probe_offset {
            return [None; 2];
        }
        let offsets = corners.map(|p| (p - self.from).dot(self.along) / self.length);
        [self.probe_offset, -self.probe_offset].map(|inward| {
            let (mut start, mut end) = (f64::INFINITY, f64::NEG_INFINITY);
            for k in 0..3 {
                let (p, q) = (heights[k] - inward, heights[(k + 1) % 3] - inward);
                if (p < 0.0) != (q < 0.0) {
                    let at = offsets[k] + (offsets[(k + 1) % 3] - offsets[k]) * (p / (p - q));
                    (start, end) = (start.min(at), end.max(at));
                }
            }
            (start < end && end > 0.0 && start < 1.0).then_some((start, end))
        })
    }
}
