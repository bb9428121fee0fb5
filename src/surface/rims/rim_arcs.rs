//! [`rim_arc`]: the arc that an edge between two surfaces stands for.

use glam::Vec3;

use crate::mesh::{EdgeFaces, Mesh};
use crate::surface::refine::edge_arc::MAX_TANGENT_SINE;
use crate::surface::{EdgeArc, SmoothNormals};

/// Minimum sine of the angle (10 degrees) between two surfaces whose line has a known direction.
const MIN_CROSS_SINE: f64 = 0.17;
/// Parameters of the points of an arc that are compared with the sides of a face: near its ends, where it is
/// steepest, and between.
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

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::Soup;

    #[test]
    fn arcs_have_room_only_inside_the_faces_at_their_edge() {
        let angle_deg = 10.0f64;
        // The edge from (0, 0) to (1, 0), with a face below that is wide, and one above whose apex decides.
        let has_room_below = |apex: [f64; 2]| {
            let positions = [[0.0, 0.0], [1.0, 0.0], [0.5, -1.0], apex].map(|[x, y]| DVec3::new(x, y, 0.0));
            let triangles = vec![[0, 2, 1], [0, 1, 3]];
            let mesh = Mesh::build(Soup { positions: positions.to_vec(), triangles, ..Soup::default() });
            let edge = (0..mesh.edges.len()).find(|edge| mesh.edges.faces(*edge).list().len() == 2).unwrap();
            let (c, s) = (cos(angle_deg.to_radians()), sin(angle_deg.to_radians()));
            let tangents = [DVec3::new(c, s, 0.0), DVec3::new(c, -s, 0.0)];
            has_room(&mesh, edge, &EdgeArc::with_tangents(mesh.ends(edge), tangents))
        };
        assert!(has_room_below([0.5, 1.0]));
        // The sides leave the edge at 45 and 4 degrees, and at 45 and 14: the arc at 10.
        assert!(!has_room_below([0.065, 0.065]));
        assert!(has_room_below([0.2, 0.2]));
        // The arc leaves through the far side of a face that leans over.
        assert!(!has_room_below([3.0, 0.1]));
    }
}
