//! Parts of closed, outward-facing bodies, whose inside is never visible.

use super::bodies::body_of;
use crate::mesh::{EdgeFaces, FaceId, Mesh, PartId};

/// For each part, whether its body is closed and has a positive volume. In a closed body, all edges have two
/// consistently wound faces. A hole of any size makes a body open.
#[must_use]
pub(crate) fn solid_parts(mesh: &Mesh) -> Vec<bool> {
    let parts = mesh.face_part.iter().map(|p| p.index() + 1).max().unwrap_or(0);
    let mut closed = vec![true; parts];
    for edge in 0..mesh.edges.len() {
        let open = match mesh.edges.faces(edge) {
            EdgeFaces::One(face) => Some(face),
            EdgeFaces::Two { faces, same_way } => same_way.then_some(faces[0]),
            EdgeFaces::Many(_) => None,
        };
        if let Some(face) = open {
            closed[mesh.body(face).index()] = false;
        }
    }
    let mut volume = vec![0.0; parts];
    for face in 0..mesh.triangles.len() as u32 {
        let [a, b, c] = mesh.corners(FaceId(face));
        volume[mesh.body(face).index()] += a.dot(b.cross(c));
    }
    let is_solid = |body: PartId| closed[body.index()] && volume[body.index()] > 0.0;
    (0..parts as u32).map(|part| is_solid(body_of(&mesh.bodies, PartId(part)))).collect()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn solid_parts_are_closed_parts_of_either_winding() {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let outward = [[0u32, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let mut soup = Soup::default();
        for (part, shift) in [0.0, 3.0, 6.0].into_iter().enumerate() {
            let first = soup.positions.len() as u32;
            soup.positions.extend(positions.iter().map(|p| *p + DVec3::X * shift));
            for (k, t) in outward.iter().enumerate() {
                let [a, b, c] = t.map(|v| v + first);
                if part == 1 && k == 3 {
                    continue;
                }
                soup.triangles.push(if part == 2 { [a, c, b] } else { [a, b, c] });
                soup.triangle_part.push(PartId(part as u32));
            }
        }
        assert_eq!(solid_parts(&Mesh::build(soup)), [true, false, true]);
    }
}
