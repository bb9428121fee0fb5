//! [`Body`]: triangles of a part, from the mesh: turned outward and without degenerate faces.

use glam::DVec3;

use crate::geometry::space::bounds::Bounds;
use crate::mesh::{EdgeFaces, FaceId, Mesh};
use crate::scene::Scene;

/// Triangles of a part, world space.
#[derive(Debug, Clone, Default)]
pub(crate) struct Body {
    pub triangles: Vec<[DVec3; 3]>,
    /// Whether an edge has only one face. The inside is then unknown, and both sides of each face count as
    /// outside.
    pub is_open: bool,
}

impl Body {
    /// The bounding box, world space.
    pub(crate) fn bounds(&self) -> Bounds {
        Bounds::of(self.triangles.as_flattened().iter().copied())
    }

    fn add(&mut self, other: &Self) {
        self.triangles.extend_from_slice(&other.triangles);
        self.is_open |= other.is_open;
    }
}

/// Bodies of a scene, one entry per part.
pub(crate) fn bodies(scene: &Scene) -> Vec<Body> {
    let mesh = Mesh::build(scene.to_soup());
    let mut bodies = vec![Body::default(); scene.parts.len()];
    for (face, part) in mesh.face_part.iter().enumerate() {
        if let Some(body) = bodies.get_mut(part.index())
            && !mesh.is_degenerate(FaceId::from(face))
        {
            body.triangles.push(mesh.triangles[face].map(|v| mesh.positions[v as usize] + mesh.origin));
        }
    }
    for edge in 0..mesh.edges.vertices.len() {
        if let EdgeFaces::One(face) = mesh.edges.faces(edge)
            && let Some(body) = bodies.get_mut(mesh.face_part[face as usize].index())
        {
            body.is_open = true;
        }
    }
    bodies
}

/// Combines several bodies into one.
pub(crate) fn joined<'a>(bodies: impl Iterator<Item = &'a Body>) -> Body {
    bodies.fold(Body::default(), |mut all, body| {
        all.add(body);
        all
    })
}
