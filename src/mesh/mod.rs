//! [`Mesh`]: everything that can be drawn, as one welded triangle mesh.
//!
//! 1. `soup` holds the triangles of a scene as the files have them.
//! 2. `order` sorts vertices and faces by position, so that the numbering of the file has no effect.
//! 3. `edges` finds the faces at each edge; `components` orients surfaces and joins parts to bodies.
//! 4. `weld` joins nearby vertices and drops duplicate faces; `seams` sews open edges that lie along each
//!    other.
//! 5. `normals` computes face normals and dihedral angles; `overlaps` stacks coplanar surfaces of different
//!    colours.
//!
//! Files, in reading order: [`ids`], [`soup`], [`build`] (the steps above), [`part_extents`] (sizes and
//! tolerances of parts), [`vertex_sources`] (moves a mesh with a pose). Other folders: [`lattice`] undoes
//! the quantization of compressed files, [`bvh`] answers box, ray and nearest-point queries, [`intersect`]
//! finds where triangles cross.

pub mod build;
pub mod bvh;
pub mod components;
pub mod edges;
pub mod ids;
pub mod intersect;
pub mod lattice;
pub mod normals;
pub(crate) mod order;
mod overlaps;
pub mod part_extents;
mod seams;
pub mod soup;
pub mod vertex_sources;
pub mod weld;

use glam::DVec3;

pub use components::disjoint_sets::{Groups, Numbered};
pub use components::orientation::TurnedFaces;
pub use edges::edge_set::EdgeSet;
pub use edges::edge_table::{EdgeFaces, Edges};
pub(crate) use edges::vertex_blocks::{Share, share_count, shares};
pub(crate) use edges::vertex_edges::FirstEdges;
pub use ids::{EdgeId, FaceId, MaterialId, PaintId, PartId, VertexId};
pub use normals::dihedral::Dihedral;
pub use normals::dihedral_cosines::Turns;
pub use overlaps::overlay_order::Overlay;
pub use part_extents::{Extent, Extents};
pub use soup::{EdgeMark, Soup, Wire};
pub use vertex_sources::Sources;
pub use weld::duplicate_faces::Cleaning;

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
    /// Narrow faces, ascending, each with a wider face in the same plane that knows the normal better: see [`normals::normal_carriers`].
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
