//! [`SmoothNormals`]: the normals of the rounded surfaces that a mesh stands for.

use glam::DVec3;

use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh};

/// In [`SmoothNormals::corners`]: the face is flat.
pub const NO_NORMAL: u32 = u32::MAX;

/// Normals of the rounded surfaces that the faces of a mesh approximate.
///
/// Each normal belongs to one *smooth vertex*: a vertex of the mesh together with those faces
/// around it that no hard edge parts. Where no edge is hard, smooth vertices are the vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SmoothNormals {
    /// Unit normals, local space; zero where no face around has area. One per smooth vertex.
    pub normals: Vec<DVec3>,
    /// The mesh vertex each smooth vertex stands on. One per smooth vertex.
    pub vertices: Vec<u32>,
    /// The smooth vertices at the corners of each face, [`NO_NORMAL`] at all three where the face
    /// is flat. One per face, or empty where all faces are flat.
    pub corners: Vec<[u32; 3]>,
    /// Edges that part rounded surfaces from each other or from flat faces.
    pub parting: EdgeSet,
    /// Edges over which the surface is taken to be straight, though its normals turn: what is between their ends does not
    /// bend with what meets there.
    pub straight: EdgeSet,
    /// Edges between normals that lean apart by less than 15 degrees, and that no edge touches that parts surfaces; none where it was not
    /// asked.
    pub gentle: EdgeSet,
    /// Whether all faces are rounded and no edge parts them, so that smooth vertices are vertices.
    pub seamless: bool,
}

impl SmoothNormals {
    /// The smooth vertices at the corners of a face; none where it is flat.
    #[inline]
    #[must_use]
    pub fn corners_of(&self, face: u32) -> Option<[u32; 3]> {
        self.corners.get(face as usize).copied().filter(|corners| corners[0] != NO_NORMAL)
    }

    /// Whether each vertex of the mesh lies on an edge that parts surfaces: all others are smooth vertices with their own number. Empty if
    /// none does.
    #[must_use]
    pub fn parted_vertices(&self, mesh: &Mesh) -> Vec<bool> {
        if self.parting.is_empty() {
            return Vec::new();
        }
        let mut parted = vec![false; mesh.positions.len()];
        self.parting
            .iter()
            .flat_map(|edge| mesh.edges.vertices[edge])
            .for_each(|vertex| parted[vertex as usize] = true);
        parted
    }

    /// The smooth vertices at the ends of an edge, smaller first, where the surface runs on across it
    /// or ends there: no face beside it is flat or of another surface.
    #[inline]
    #[must_use]
    pub fn across(&self, mesh: &Mesh, edge: usize) -> Option<[u32; 2]> {
        let ends = mesh.edges.vertices[edge];
        if self.seamless {
            return Some(ends);
        }
        if self.parting.contains(edge) {
            return None;
        }
        let face = match mesh.edges.faces(edge) {
            EdgeFaces::One(face) | EdgeFaces::Two { faces: [face, _], .. } => face,
            EdgeFaces::Many(_) => return None,
        };
        let corners = self.corners_of(face)?;
        let [u, v, w] = mesh.triangles[face as usize];
        let [lo, hi] = ends;
        // The side that the edge is, whichever way it runs.
        let (a, b) = if (lo, hi) == (u.min(v), u.max(v)) {
            (corners[0], corners[1])
        } else if (lo, hi) == (v.min(w), v.max(w)) {
            (corners[1], corners[2])
        } else {
            (corners[2], corners[0])
        };
        Some([a.min(b), a.max(b)])
    }

    /// Whether every face is rounded.
    #[must_use]
    pub fn corners_of_all(&self) -> bool {
        !self.corners.is_empty() && self.corners.iter().all(|corners| corners[0] != NO_NORMAL)
    }

    /// Whether no face is rounded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }
}
