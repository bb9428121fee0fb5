//! [`SmoothNormals`]: normals of the curved surfaces that a mesh approximates.

use glam::DVec3;

use crate::mesh::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh};

/// In [`SmoothNormals::corners`]: the face is flat.
pub(crate) const NO_NORMAL: u32 = u32::MAX;

/// Normals of the curved surfaces that the faces of a mesh approximate.
///
/// Each normal belongs to one *smooth vertex*: a vertex of the mesh together with a fan of faces around it
/// that no hard edge separates. Without hard edges, smooth vertices are the vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SmoothNormals {
    /// Unit normals, local space; zero where no adjacent face has an area. One per smooth vertex.
    pub normals: Vec<DVec3>,
    /// Mesh vertex of each smooth vertex.
    pub vertices: Vec<u32>,
    /// Smooth vertices at the corners of each face; [`NO_NORMAL`] at all three where the face is flat. One
    /// entry per face, or empty where all faces are flat.
    pub corners: Vec<[u32; 3]>,
    /// Edges that separate curved surfaces from each other or from flat faces, and borders at vertices where
    /// surfaces touch.
    pub separating_edges: EdgeSet,
    /// Edges along which the surface is straight, although its normals turn. A straight edge has no arc.
    pub straight: EdgeSet,
    /// Edges away from separating edges, whose end normals differ by less than 15 degrees. Empty if not
    /// computed.
    pub gentle: EdgeSet,
    /// Whether all faces are curved and no edge separates them, so that smooth vertices are vertices.
    pub seamless: bool,
}

impl SmoothNormals {
    /// Smooth vertices at the corners of a face; `None` where it is flat.
    #[inline]
    #[must_use]
    pub(crate) fn corners_of(&self, face: u32) -> Option<[u32; 3]> {
        self.corners.get(face as usize).copied().filter(|corners| corners[0] != NO_NORMAL)
    }

    /// Whether each vertex of the mesh lies on a separating edge. All others are smooth vertices with the
    /// same number. Empty if there are no separating edges.
    #[must_use]
    pub(crate) fn parted_vertices(&self, mesh: &Mesh) -> Vec<bool> {
        if self.separating_edges.is_empty() {
            return Vec::new();
        }
        let mut parted = vec![false; mesh.positions.len()];
        let ends = self.separating_edges.iter().flat_map(|edge| mesh.edges.vertices[edge]);
        ends.for_each(|vertex| parted[vertex as usize] = true);
        parted
    }

    /// Smooth vertices at the ends of an edge, smaller first. `None` at separating and non-manifold edges,
    /// and next to flat faces.
    #[inline]
    #[must_use]
    pub(crate) fn across(&self, mesh: &Mesh, edge: usize) -> Option<[u32; 2]> {
        let ends = mesh.edges.vertices[edge];
        if self.seamless {
            return Some(ends);
        }
        if self.separating_edges.contains(edge) {
            return None;
        }
        let face = match mesh.edges.faces(edge) {
            EdgeFaces::One(face) | EdgeFaces::Two { faces: [face, _], .. } => face,
            EdgeFaces::Many(_) => return None,
        };
        let corners = self.corners_of(face)?;
        let [u, v, w] = mesh.triangles[face as usize];
        let [lo, hi] = ends;
        // Selects the side of the face that is this edge, in either direction.
        let (a, b) = if (lo, hi) == (u.min(v), u.max(v)) {
            (corners[0], corners[1])
        } else if (lo, hi) == (v.min(w), v.max(w)) {
            (corners[1], corners[2])
        } else {
            (corners[2], corners[0])
        };
        Some([a.min(b), a.max(b)])
    }

    /// Whether every face is curved.
    #[must_use]
    pub(crate) fn corners_of_all(&self) -> bool {
        !self.corners.is_empty() && self.corners.iter().all(|corners| corners[0] != NO_NORMAL)
    }

    /// Whether no face is curved.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }
}
