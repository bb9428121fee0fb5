//! [`Mesh`]: all that can be drawn, as one welded triangle mesh.

mod arcs;
pub(crate) mod area;
pub(crate) mod bodies;
pub mod build;
pub mod carriers;
mod changed_edges;
pub mod clean;
mod common_area;
mod counting_sort;
mod cuts;
pub mod dihedral;
pub mod edge_set;
mod edge_splice;
pub mod edges;
pub mod extents;
pub(crate) mod face_normals;
mod first_edges;
pub(crate) mod groups;
pub mod ids;
pub mod lattice;
mod mixed_places;
pub mod needle;
mod order;
pub(crate) mod orientation;
mod overlaps;
mod places;
pub mod posed;
mod seams;
mod shares;
mod sheets;
pub mod solid;
pub mod soup;
pub(crate) mod space_curve;
pub mod turns;
pub mod weld;

use glam::DVec3;

pub use clean::Cleaning;
pub use dihedral::Dihedral;
pub use edge_set::EdgeSet;
pub use edges::{EdgeFaces, Edges};
pub use extents::{Extent, Extents};
pub(crate) use first_edges::FirstEdges;
pub use groups::{Groups, Numbered};
pub use ids::{EdgeId, FaceId, MaterialId, PaintId, PartId, VertexId};
pub use orientation::TurnedFaces;
pub use overlaps::Overlay;
pub use posed::Sources;
pub(crate) use shares::{Share, share_count, shares};
pub use soup::{EdgeMark, Soup, Wire};
pub use turns::Turns;

/// A welded triangle mesh.
///
/// Non-manifold and open meshes are fine; every face has three different vertices and no face
/// stands twice in one part. Vertices and faces stand in an order that rests on their places, not on the
/// file's. Built by [`Mesh::build`].
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// The world point that is the zero of `positions`: zero itself, or for models far from it a round point
    /// near them, so that they keep their digits.
    pub origin: DVec3,
    /// How large each part is; every tolerance is a fraction of that.
    pub extents: Extents,
    /// Vertices, world units relative to `origin`.
    pub positions: Vec<DVec3>,
    /// Vertex ids of each face, counter-clockwise seen from outside; in surfaces without an outside, such as flat sheets, as the
    /// file winds them.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normal of each face; zero for degenerate faces.
    pub face_normals: Vec<[f32; 3]>,
    /// Narrow faces, ascending, each with a wider face in the same plane that knows the normal better: see [`carriers`].
    pub carriers: Vec<[u32; 2]>,
    /// From this face on, faces are pieces of others, cut so that they bend with a rounded surface; `None` if there are none.
    pub first_piece: Option<u32>,
    /// Part of each face.
    pub face_part: Vec<PartId>,
    /// For each part the first of the parts whose surfaces continue in each other; empty if each part is a body of its own. See
    /// [`Mesh::body`].
    pub bodies: Vec<PartId>,
    /// Material of each face.
    pub face_material: Vec<MaterialId>,
    /// Paint of each face, or empty where each has that of its material: see [`Mesh::paint`].
    pub face_paint: Vec<PaintId>,
    /// Unit normals to which `corner_normals` points.
    pub normals: Vec<[f32; 3]>,
    /// Normals of the corners of each face (`u32::MAX` = none), or empty.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates to which `corner_uvs` points.
    pub uvs: Vec<[f32; 2]>,
    /// Texture coordinates of the corners of each face (`u32::MAX` = none), or empty.
    pub corner_uvs: Vec<[u32; 3]>,
    /// The linear light of the colours of the corners of each face, or empty where none varies within a face.
    pub corner_colours: Vec<[[f32; 3]; 3]>,
    /// What the file says about the sides 0-1, 1-2, 2-0 of each face, or empty.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    /// The place of each face among surfaces of unlike colours that overlap in one plane; empty if none do.
    pub overlays: Vec<Overlay>,
    /// Which faces meet at which edge.
    pub edges: Edges,
    /// Lines without faces; their vertices are vertices of the mesh.
    pub wires: Vec<Wire>,
    /// What was mended.
    pub cleaning: Cleaning,
    /// Faces that the file winds inward or against their neighbours: one entry for each part that has any, in the order of parts.
    pub turned: Vec<TurnedFaces>,
}

impl Mesh {
    /// Whether a face has no area to speak of: it hides nothing.
    #[inline]
    #[must_use]
    pub fn is_degenerate(&self, face: FaceId) -> bool {
        self.face_normals[face.index()] == [0.0; 3]
    }

    /// The paint of a face.
    #[inline]
    #[must_use]
    pub fn paint(&self, face: FaceId) -> PaintId {
        self.face_paint.get(face.index()).copied().unwrap_or(self.face_material[face.index()].into())
    }

    /// The same mesh, but that some faces count as degenerate, and hide nothing.
    #[must_use]
    pub fn seen_through(&self, clear: impl Fn(FaceId) -> bool) -> Self {
        let mut mesh = self.clone();
        for (face, normal) in mesh.face_normals.iter_mut().enumerate() {
            if clear(FaceId(face as u32)) {
                *normal = [0.0; 3];
            }
        }
        mesh
    }

    /// Leaves out the file's normals of some faces.
    pub fn forget_normals(&mut self, wrong: impl Fn(u32) -> bool) {
        for (face, corners) in self.corner_normals.iter_mut().enumerate() {
            if wrong(face as u32) {
                *corners = [u32::MAX; 3];
            }
        }
    }

    /// The barycentric weights of a point in the plane of a face; those of the first corner for a face
    /// without area.
    #[must_use]
    pub fn weights(&self, face: FaceId, at: DVec3) -> [f64; 3] {
        let [a, b, c] = self.corners(face);
        let normal = (b - a).cross(c - a);
        let whole = normal.length_squared();
        let part = |p: DVec3, q: DVec3| (p - at).cross(q - at).dot(normal) / whole;
        if whole > 0.0 { [part(b, c), part(c, a), part(a, b)] } else { [1.0, 0.0, 0.0] }
    }

    /// Positions of the three corners of a face.
    #[inline]
    #[must_use]
    pub fn corners(&self, face: FaceId) -> [DVec3; 3] {
        self.triangles[face.index()].map(|v| self.positions[v as usize])
    }
}
