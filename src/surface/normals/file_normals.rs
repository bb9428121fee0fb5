//! The normals that the file gives the corners of faces.

use glam::{DVec3, Vec3};

use crate::mesh::Mesh;

/// File normals at the corners of a face, flipped to the side of the face; zero where there are none.
pub(crate) fn file_normals(mesh: &Mesh, face: usize) -> [DVec3; 3] {
    let Some(ids) = mesh.corner_normals.get(face) else { return [DVec3::ZERO; 3] };
    let own = Vec3::from_array(mesh.face_normals[face]).as_dvec3();
    ids.map(|id| {
        let normal = mesh.normals.get(id as usize).map_or(DVec3::ZERO, |n| Vec3::from_array(*n).as_dvec3());
        if normal.dot(own) < 0.0 { -normal } else { normal }
    })
}

/// Direction of the file normals, or of the face normals where the two deviate by more than 60 degrees.
pub(crate) fn preferred_normal(of_faces: DVec3, of_file: DVec3) -> DVec3 {
    let (of_faces, of_file) = (of_faces.normalize_or_zero(), of_file.normalize_or_zero());
    if of_file.dot(of_faces) > 0.5 { of_file } else { of_faces }
}

/// Cosines between the file normals of two faces, at both ends of their common edge. `None` if one of the
/// faces has no normals.
#[must_use]
pub(crate) fn file_cosines(mesh: &Mesh, edge: usize, faces: [u32; 2]) -> Option<[f32; 2]> {
    if mesh.corner_normals.is_empty() {
        return None;
    }
    let normal = |face: u32, vertex: u32| {
        let corner = mesh.triangles[face as usize].iter().position(|v| *v == vertex)?;
        let id = mesh.corner_normals.get(face as usize)?[corner];
        mesh.normals.get(id as usize).map(|normal| Vec3::from_array(*normal))
    };
    let cosine = |vertex: u32| Some(normal(faces[0], vertex)?.dot(normal(faces[1], vertex)?));
    let [a, b] = mesh.edges.vertices[edge];
    Some([cosine(a)?, cosine(b)?])
}
