//! [`JointFaces`]: the faces that reach a line, and the pieces of it that are joints.

use glam::{DVec2, DVec3};

use super::ray_fan::{FaceRay, RayFan, angle_error_sine};
use crate::geometry::space::triangles::height;
use crate::mesh::bvh::box_tree::BoxTree;
use crate::mesh::{FaceId, Mesh, PartId};

/// Distance of the test lines on both sides of a line, in contact distances.
const PROBE_OFFSET_CONTACTS: f64 = 4.0;

/// Minimum length of a piece, in test distances. Shorter pieces are artefacts of the test.
const MIN_PIECE_OFFSETS: f64 = 8.0;

/// Faces of a mesh in a tree of boxes, with their kinds.
pub(crate) struct JointFaces<'a> {
    mesh: &'a Mesh,
    kinds: &'a [u32],
    tree: BoxTree,
    /// Largest contact distance of all parts.
    contact: f64,
}

/// Piece of a line, and whether it is a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointPiece {
    /// End of the piece, as a fraction of the line's length.
    pub end: f64,
    /// Mesh vertex at its end, if there is one.
    pub vertex: Option<u32>,
    pub is_joint: bool,
}

/// Straight line between two points.
struct JointLine {
    from: DVec3,
    to: DVec3,
    along: DVec3,
    length: f64,
}

/// Face that reaches a line.
struct ReachingFace {
    face: u32,
    normal: DVec3,
    /// Smallest height of the triangle that defines the face's plane.
    height: f64,
    /// Ranges that it covers, as fractions of the line's length: on the side of normal × line, and on the
    /// other.
    covers: [Option<[f64; 2]>; 2],
}

impl<'a> JointFaces<'a> {
    /// Builds the tree; none if no kind has two parts, so that there are no joints.
    pub(crate) fn new(mesh: &'a Mesh, kinds: &'a [u32]) -> Option<Self> {
        let of = |face: u32| kind(mesh, kinds, face);
        let mut owners: Vec<(u32, PartId)> =
            (0..mesh.triangles.len() as u32).map(|face| (of(face), mesh.face_part[face as usize])).collect();
        owners.sort_unstable();
        owners.dedup();
        if !owners.windows(2).any(|pair| pair[0].0 == pair[1].0) {
            return None;
        }
        let contact = owners.iter().map(|(_, part)| mesh.extents.part(*part).contact).fold(0.0, f64::max);
        let active: Vec<bool> =
            (0..mesh.triangles.len() as u32).map(|face| !mesh.is_degenerate(FaceId(face))).collect();
        let half = DVec3::splat(mesh.extents.diagonal / 2.0);
        let (low, high) = (mesh.extents.middle - half, mesh.extents.middle + half);
        let tree = BoxTree::new(&mesh.positions, &mesh.triangles, &active, low, high);
        Some(Self { mesh, kinds, tree, contact })
    }

    /// Pieces of a line of a part, in order; `None` if none is a joint, or if more than `max_faces` faces are
    /// near.
    pub(crate) fn pieces(
        &self,
        part: PartId,
        [from, to]: [DVec3; 2],
        max_faces: usize,
    ) -> Option<Vec<JointPiece>> {
        let along = (to - from).try_normalize()?;
        let joint_line = JointLine { from, to, along, length: from.distance(to) };
        let mut near = self.near(&joint_line, max_faces)?;
        let own_contact = self.mesh.extents.part(part).contact;
        let contact_of = |face: u32| self.mesh.extent(FaceId(face)).contact.max(own_contact);
        near.retain(|face| self.reached(&joint_line, *face, contact_of(*face)).is_some());
        // Two parts of one kind must be among them.
        let owner = |face: &u32| (kind(self.mesh, self.kinds, *face), self.mesh.face_part[*face as usize]);
        let is_shared = |face: &u32| {
            let (kind, part) = owner(face);
            near.iter().map(owner).any(|face_owner| face_owner.0 == kind && face_owner.1 != part)
        };
        if !near.iter().any(is_shared) {
            return None;
        }
        let contact = near.iter().map(|face| contact_of(*face)).fold(own_contact, f64::max);
        let reached: Vec<ReachingFace> =
            near.iter().filter_map(|face| self.reached(&joint_line, *face, contact)).collect();
        let pieces = self.cut(&joint_line, &reached, contact);
        pieces.iter().any(|piece| piece.is_joint).then_some(pieces)
    }

    /// Faces whose boxes are near that of the line, ascending.
    fn near(&self, joint_line: &JointLine, max_faces: usize) -> Option<Vec<u32>> {
        let around = 2.0 * PROBE_OFFSET_CONTACTS * self.contact;
        let (low, high) =
            (joint_line.from.min(joint_line.to) - around, joint_line.from.max(joint_line.to) + around);
        let mut near = Vec::new();
        self.tree.near_box(low, high, |face| near.push(face));
        near.sort_unstable();
        (near.len() <= max_faces).then_some(near)
    }

    /// Ranges that a face covers on both sides of a line, if its plane holds the line.
    fn reached(&self, joint_line: &JointLine, face: u32, contact: f64) -> Option<ReachingFace> {
        let mesh = self.mesh;
        let corners = mesh.corners(FaceId(face));
        let carrier = mesh.carriers.binary_search_by_key(&face, |pair| pair[0]);
        let plane_corners = carrier.map_or(corners, |at| mesh.corners(FaceId(mesh.carriers[at][1])));
        let normal = (plane_corners[1] - plane_corners[0])
            .cross(plane_corners[2] - plane_corners[0])
            .try_normalize()?;
        let side = normal.cross(joint_line.along).try_normalize()?;
        let flat = corners.map(|corner| {
            let from = corner - joint_line.from;
            DVec2::new(from.dot(joint_line.along) / joint_line.length, from.dot(side))
        });
        let probe_offset = PROBE_OFFSET_CONTACTS * contact;
        // Range where the plane holds the line, within rounding.
        let heights = [joint_line.from, joint_line.to].map(|end| normal.dot(end - corners[0]));
        let held = range_near_plane(heights, contact)?;
        let min_length = MIN_PIECE_OFFSETS * probe_offset / joint_line.length;
        let covers = [probe_offset, -probe_offset].map(|at| {
            let [start, end] = range_covered(&flat, at)?;
            let overlap = [start.max(held[0]), end.min(held[1])];
            // A plane that crosses the line holds only a short range.
            (overlap[1] - overlap[0] > min_length.min(0.5 * (end - start).min(1.0))
                && overlap[1] > 0.0
                && overlap[0] < 1.0)
                .then_some(overlap)
        });
        if covers == [None; 2] {
            return None;
        }
        Some(ReachingFace { face, normal, height: height(&plane_corners), covers })
    }

    /// Pieces of a line, given the faces that reach it.
    fn cut(&self, joint_line: &JointLine, reached: &[ReachingFace], contact: f64) -> Vec<JointPiece> {
        let min_length = MIN_PIECE_OFFSETS * PROBE_OFFSET_CONTACTS * contact / joint_line.length;
        let mut cuts: Vec<f64> = reached
            .iter()
            .flat_map(|reaching_face| reaching_face.covers.into_iter().flatten().flatten())
            .collect();
        cuts.retain(|t| *t > min_length && *t < 1.0 - min_length);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < min_length);
        let right = joint_line.along.any_orthonormal_vector();
        let up = joint_line.along.cross(right);
        let mut pieces: Vec<JointPiece> = Vec::with_capacity(cuts.len() + 1);
        let mut start = 0.0;
        for end in cuts.into_iter().chain([1.0]) {
            let rays = self.rays(joint_line, reached, f64::midpoint(start, end), contact);
            let is_joint = RayFan::new(rays, right, up).is_joint();
            match pieces.last_mut().filter(|last| last.is_joint == is_joint) {
                Some(last) => last.end = end,
                None => pieces.push(JointPiece { end, vertex: None, is_joint }),
            }
            start = end;
        }
        for piece in &mut pieces {
            piece.vertex = self.vertex_at(
                joint_line.from.lerp(joint_line.to, piece.end),
                reached,
                PROBE_OFFSET_CONTACTS * contact,
            );
        }
        pieces
    }

    /// Faces at a position on the line, as rays.
    fn rays(&self, joint_line: &JointLine, reached: &[ReachingFace], at: f64, contact: f64) -> Vec<FaceRay> {
        let mesh = self.mesh;
        let mut rays = Vec::new();
        for reaching_face in reached {
            let side = reaching_face.normal.cross(joint_line.along).normalize_or_zero();
            for (cover, (side, begins)) in reaching_face.covers.iter().zip([(side, false), (-side, true)]) {
                if cover.is_some_and(|[start, end]| (start..=end).contains(&at)) {
                    rays.push(FaceRay {
                        direction: side,
                        begins,
                        angle_error: angle_error_sine(contact, reaching_face.height, joint_line.length),
                        kind: kind(mesh, self.kinds, reaching_face.face),
                        part: mesh.face_part[reaching_face.face as usize],
                        body: mesh.body(reaching_face.face),
                    });
                }
            }
        }
        rays
    }

    /// Nearest vertex of the given faces, within `reach`.
    fn vertex_at(&self, point: DVec3, reached: &[ReachingFace], reach: f64) -> Option<u32> {
        let vertices =
            reached.iter().flat_map(|reaching_face| self.mesh.triangles[reaching_face.face as usize]);
        let distance = |v: u32| self.mesh.positions[v as usize].distance(point);
        let near = vertices.map(|v| (distance(v), v)).filter(|(distance, _)| *distance <= reach);
        near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, v)| v)
    }
}

/// Kind of a face.
fn kind(mesh: &Mesh, kinds: &[u32], face: u32) -> u32 {
    let paint = mesh.paint(FaceId(face)).0;
    kinds.get(paint as usize).copied().unwrap_or(paint)
}

/// Range of a line, in fractions of its length, within `contact` of a plane. Given are the heights of both
/// ends.
fn range_near_plane([from, to]: [f64; 2], contact: f64) -> Option<[f64; 2]> {
    let rise = to - from;
    if rise == 0.0 {
        return (from.abs() <= contact).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let at = [-contact, contact].map(|height| (height - from) / rise);
    let held = [at[0].min(at[1]), at[0].max(at[1])];
    (held[0] < 1.0 && held[1] > 0.0).then_some(held)
}

/// Range of a line, in fractions of its length, where a triangle covers the parallel at offset `at`.
fn range_covered(corners: &[DVec2; 3], at: f64) -> Option<[f64; 2]> {
    let (mut start, mut end) = (f64::INFINITY, f64::NEG_INFINITY);
    for k in 0..3 {
        let (p, q) = (corners[k], corners[(k + 1) % 3]);
        if (p.y < at) != (q.y < at) {
            let x = p.x + (q.x - p.x) * ((at - p.y) / (q.y - p.y));
            (start, end) = (start.min(x), end.max(x));
        }
    }
    (start < end && end > 0.0 && start < 1.0).then_some([start, end])
}
