//! [`rim_arc`]: the arc that an edge between two surfaces stands for.

use glam::Vec3;

use crate::mesh::{EdgeFaces, Mesh};
use crate::surface::refine::edge_arc::MAX_TANGENT_SINE;
use crate::surface::{EdgeArc, SmoothNormals};

/// Minimum sine of the angle (10 degrees) between two surfaces whose line has a known direction.
const MIN_CROSS_SINE: f64 = 0.17;
/// Parameters at which an arc is compared with the sides of a face: near its ends, where it is steepest, and
/// between.
const ROOM_PARAMETERS: [f64; 5] = [1.0 / 64.0, 0.25, 0.5, 0.75, 63.0 / 64.0];

/// Whether the file gives the normals of all curved faces next to a line, one at least. Normals that are
/// estimated lean where a flat begins, and a straight line would bulge.
pub(crate) fn has_known_direction(mesh: &Mesh, smooth: &SmoothNormals, faces: [u32; 2]) -> bool {
    let is_given =
        |face: u32| mesh.corner_normals.get(face as usize).is_some_and(|ids| !ids.contains(&u32::MAX));
    let mut curved = faces.into_iter().filter(|face| smooth.corners_of(*face).is_some()).peekable();
    curved.peek().is_some() && curved.all(is_given)
}

/// The arc over an edge between a curved face and another, from the smaller vertex to the larger. `None` where
/// the file does not give its direction, where the surfaces hardly cross, or where the arc would leave the
/// edge too steeply.
pub(crate) fn rim_arc(mesh: &Mesh, smooth: &SmoothNormals, edge: usize) -> Option<EdgeArc> {
    let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return None };
    if !has_known_direction(mesh, smooth, faces) {
        return None;
    }
    let corners = faces.map(|face| smooth.corners_of(face));
    let vertices = mesh.edges.vertices[edge];
    let ends = vertices.map(|v| mesh.positions[v as usize]);
    let along = (ends[1] - ends[0]).normalize_or_zero();
    let normal = |side: usize, vertex: u32| match corners[side] {
        Some(corners) => {
            let at = mesh.triangles[faces[side] as usize].iter().position(|v| *v == vertex)?;
            Some(smooth.normals[corners[at] as usize])
        }
        None => Some(Vec3::from_array(mesh.face_normals[faces[side] as usize]).as_dvec3()),
    };
    let tangent = |vertex: u32| {
        let cross = normal(0, vertex)?.cross(normal(1, vertex)?);
        let tangent = cross * cross.dot(along).signum() / cross.length();
        let is_known = cross.length() > MIN_CROSS_SINE && along.cross(tangent).length() <= MAX_TANGENT_SINE;
        is_known.then_some(tangent)
    };
    Some(EdgeArc::with_tangents(ends, [tangent(vertices[0])?, tangent(vertices[1])?]))
}

/// Whether an arc stays within the faces at its edge, seen along their normals. Where it leaves a face through
/// another side, the pieces of that face would overlap.
pub(crate) fn has_room(mesh: &Mesh, edge: usize, arc: &EdgeArc) -> bool {
    let ends = mesh.edges.vertices[edge];
    mesh.edges.faces(edge).each().all(|face| {
        let Some(apex) = mesh.apex(face, ends) else { return false };
        let [apex, from, to] = [apex, ends[0], ends[1]].map(|v| mesh.positions[v as usize]);
        let normal = Vec3::from_array(mesh.face_normals[face as usize]).as_dvec3();
        let normal = normal * (to - from).cross(apex - from).dot(normal).signum();
        ROOM_PARAMETERS.iter().map(|t| arc.at(*t)).all(|at| {
            (apex - to).cross(at - to).dot(normal) > 0.0 && (from - apex).cross(at - apex).dot(normal) > 0.0
        })
    })
}
