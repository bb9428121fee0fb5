//! The normals that a file gives its faces, where it gives them any.

use glam::{DVec3, Vec3};

use crate::mesh::Mesh;

/// The file's normals at the corners of a face, turned to the face's own side; zero where there
/// are none.
pub(crate) fn file_normals(mesh: &Mesh, face: usize) -> [DVec3; 3] {
    let Some(ids) = mesh.corner_normals.get(face) else { return [DVec3::ZERO; 3] };
    let own = Vec3::from_array(mesh.face_normals[face]).as_dvec3();
    ids.map(|id| {
        let normal = mesh.normals.get(id as usize).map_or(DVec3::ZERO, |n| Vec3::from_array(*n).as_dvec3());
        if normal.dot(own) < 0.0 { -normal } else { normal }
    })
}

/// The direction of the file's normals, or where they leave the surface altogether, of those of the
/// faces.
pub(crate) fn chosen(of_faces: DVec3, of_file: DVec3) -> DVec3 {
    let (of_faces, of_file) = (of_faces.normalize_or_zero(), of_file.normalize_or_zero());
    if of_file.dot(of_faces) > 0.5 { of_file } else { of_faces }
}

/// The cosines between the normals that a file gives two faces at the ends of the edge they share, none where it
/// gives one of them none.
#[must_use]
pub fn file_cosines(mesh: &Mesh, edge: usize, faces: [u32; 2]) -> Option<[f32; 2]> {
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
