//! The rounded surfaces of a model, as the options have them.

use glam::Vec3;

use super::LineOptions;
use super::options::Contours;
use crate::math::function::cos;
use crate::mesh::rounded::rounded_faces;
use crate::mesh::{EdgeFaces, Mesh, SmoothNormals};

/// Normals of one surface on both sides of an edge differ by no more than this cosine (20 degrees)
/// where the file has it smooth.
const SAME_NORMAL_COSINE: f32 = 0.94;

/// The normals of the surfaces whose contours are smooth.
#[must_use]
pub fn rounded_surface(mesh: &Mesh, options: &LineOptions) -> SmoothNormals {
    let rounded = match options.contours {
        Contours::Mesh => return SmoothNormals::default(),
        Contours::Smooth => vec![true; mesh.triangles.len()],
        Contours::Auto => rounded_faces(mesh),
    };
    let crease_cosine = cos(options.crease_deg.to_radians()) as f32;
    SmoothNormals::new(mesh, |face| rounded[face as usize], |edge| is_hard(mesh, edge, crease_cosine))
}

/// Whether an edge parts two surfaces: by the file's normals, or where it has none, by its angle.
fn is_hard(mesh: &Mesh, edge: usize, crease_cosine: f32) -> bool {
    let EdgeFaces::Two { faces: [first, second], .. } = mesh.edges.faces(edge) else { return false };
    let normals = |face: u32| {
        let triangle = mesh.triangles[face as usize];
        let ids = mesh.corner_normals.get(face as usize)?;
        let of = |v: u32| {
            let k = triangle.iter().position(|t| *t == v)?;
            mesh.normals.get(ids[k] as usize).map(|n| Vec3::from_array(*n))
        };
        let [a, b] = mesh.edges.vertices[edge];
        Some([of(a)?, of(b)?])
    };
    match (normals(first), normals(second)) {
        (Some(n), Some(m)) => (0..2).any(|k| n[k].dot(m[k]) < SAME_NORMAL_COSINE),
        _ => {
            let [n, m] = [first, second].map(|f| Vec3::from_array(mesh.face_normals[f as usize]));
            n.dot(m) < crease_cosine
        }
    }
}
