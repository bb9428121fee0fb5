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
//! Files, in reading order: [`ids`], [`soup`], [`build`] (the steps above), [`part_metrics`] (sizes and
//! tolerances of parts), [`vertex_sources`] (moves a mesh with a pose), `tolerances`. Other folders:
//! [`quantization`] undoes the quantization of compressed files, [`bvh`] answers box, ray and nearest-point
//! queries, [`intersect`] finds where triangles cross.

pub(crate) mod build;
pub(crate) mod bvh;
pub(crate) mod components;
pub(crate) mod edges;
pub(crate) mod ids;
pub(crate) mod intersect;
pub(crate) mod normals;
pub(crate) mod order;
mod overlaps;
pub(crate) mod part_metrics;
pub(crate) mod quantization;
pub(crate) mod seams;
pub(crate) mod soup;
pub(crate) mod tolerances;
pub(crate) mod vertex_sources;
pub(crate) mod weld;

use glam::DVec3;

use crate::geometry::space::triangles;

pub(crate) use components::orientation::TurnedFaces;
pub(crate) use edges::edge_set::EdgeSet;
pub(crate) use edges::edge_table::EdgeFaces;
pub use edges::edge_table::Edges;
pub(crate) use edges::vertex_edges::VertexEdges;
pub(crate) use edges::vertex_ranges::{VertexRange, range_count, vertex_ranges};
pub use ids::{FaceId, MaterialId, PartId};
pub(crate) use ids::{PaintId, VertexId};
pub(crate) use normals::dihedral::Dihedral;
pub(crate) use normals::dihedral_cosines::DihedralCosines;
pub(crate) use overlaps::overlay_order::Overlay;
pub(crate) use part_metrics::MeshMetrics;
pub(crate) use part_metrics::PartMetrics;
pub use soup::EdgeMark;
pub use soup::Soup;
pub(crate) use soup::Wire;
pub(crate) use vertex_sources::VertexSources;
pub(crate) use weld::duplicate_faces::RepairCounts;

/// A welded triangle mesh, built by [`Mesh::build`].
///
/// Meshes may be open and non-manifold. Every face has three different vertices, and no face occurs twice in
/// one part. The order of vertices and faces depends on positions, not on the file.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// World position of the origin of `positions`. It is zero, or for models far from zero a round point
    /// near them, which preserves precision.
    pub(crate) origin: DVec3,
    /// Size of each part. Every tolerance is a fraction of it.
    pub(crate) extents: MeshMetrics,
    /// Vertex positions, world units relative to `origin`.
    pub positions: Vec<DVec3>,
    /// Vertex ids of each face, counter-clockwise seen from outside. Surfaces without an outside, such as
    /// flat sheets, keep the winding of the file.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normal of each face; zero for degenerate faces.
    pub(crate) face_normals: Vec<[f32; 3]>,
    /// Narrow faces, ascending, each with a wider coplanar face whose normal is more accurate; see
    /// [`normals::normal_carriers`].
    pub(crate) carriers: Vec<[u32; 2]>,
    /// First face that is a piece of another face, created by subdivision; `None` if there are none. Pieces
    /// come last.
    pub(crate) first_piece: Option<u32>,
    /// Part of each face.
    pub face_part: Vec<PartId>,
    /// For each part, the first part of its body: parts whose surfaces continue in each other. Empty if every
    /// part is a separate body. See [`Mesh::body`].
    pub(crate) bodies: Vec<PartId>,
    /// Material of each face.
    pub face_material: Vec<MaterialId>,
    /// Paint of each face, or empty if each has the paint of its material; see [`Mesh::paint`].
    pub(crate) face_paint: Vec<PaintId>,
    /// Unit normals, indexed by `corner_normals`.
    pub(crate) normals: Vec<[f32; 3]>,
    /// Normal of each corner of each face (`u32::MAX` = none), or empty.
    pub(crate) corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, indexed by `corner_uvs`.
    pub(crate) uvs: Vec<[f32; 2]>,
    /// Texture coordinates of each corner of each face (`u32::MAX` = none), or empty.
    pub(crate) corner_uvs: Vec<[u32; 3]>,
    /// Linear colour of each corner of each face, or empty if no colour varies within a face.
    pub(crate) corner_colours: Vec<[[f32; 3]; 3]>,
    /// Edge marks of the sides 0-1, 1-2, 2-0 of each face, from the file, or empty.
    pub(crate) edge_marks: Vec<[EdgeMark; 3]>,
    /// Stacking position of each face among coplanar surfaces of different colours; empty if none overlap.
    pub(crate) overlays: Vec<Overlay>,
    /// Edges, and the faces that meet at each of them.
    pub(crate) edges: Edges,
    /// Lines without faces. Their vertices are vertices of the mesh.
    pub(crate) wires: Vec<Wire>,
    /// Counts of repaired and remaining defects.
    pub(crate) cleaning: RepairCounts,
    /// Faces that the file winds inward or against their neighbours: one entry for each part that has any, in
    /// part order.
    pub(crate) turned: Vec<TurnedFaces>,
}

impl Mesh {
    /// Whether a face has no area. Such a face hides nothing.
    #[inline]
    #[must_use]
    pub fn is_degenerate(&self, face: FaceId) -> bool {
        self.face_normals[face.index()] == [0.0; 3]
    }

    /// The paint of a face.
    #[inline]
    #[must_use]
    pub(crate) fn paint(&self, face: FaceId) -> PaintId {
        self.face_paint.get(face.index()).copied().unwrap_or(self.face_material[face.index()].into())
    }

    /// A copy where the faces that satisfy `clear` are degenerate, so that they hide nothing.
    #[must_use]
    pub fn with_transparent_faces(&self, clear: impl Fn(FaceId) -> bool) -> Self {
        let mut mesh = self.clone();
        for (face, normal) in mesh.face_normals.iter_mut().enumerate() {
            if clear(FaceId(face as u32)) {
                *normal = [0.0; 3];
            }
        }
        mesh
    }

    /// Removes the file normals of the faces that satisfy `wrong`.
    pub fn remove_normals(&mut self, wrong: impl Fn(u32) -> bool) {
        for (face, corners) in self.corner_normals.iter_mut().enumerate() {
            if wrong(face as u32) {
                *corners = [u32::MAX; 3];
            }
        }
    }

    /// Barycentric coordinates of a point in the plane of a face. For a face without area, those of the first
    /// corner.
    #[must_use]
    pub fn weights(&self, face: FaceId, at: DVec3) -> [f64; 3] {
        triangles::weights(self.corners(face), at)
    }

    /// Positions of the three corners of a face.
    #[inline]
    #[must_use]
    pub fn corners(&self, face: FaceId) -> [DVec3; 3] {
        self.triangles[face.index()].map(|v| self.positions[v as usize])
    }

    /// Normal of a face, with the length of twice its area.
    #[inline]
    pub(crate) fn area_vector(&self, face: FaceId) -> DVec3 {
        triangles::area_vector(self.corners(face))
    }

    /// Area of a face.
    #[inline]
    pub(crate) fn area(&self, face: FaceId) -> f64 {
        triangles::area(self.corners(face))
    }

    /// Positions of the ends of an edge.
    #[inline]
    pub(crate) fn ends(&self, edge: usize) -> [DVec3; 2] {
        self.edges.vertices[edge].map(|v| self.positions[v as usize])
    }

    /// The corner of a face that is not on one of its edges.
    #[inline]
    pub(crate) fn apex(&self, face: u32, ends: [u32; 2]) -> Option<u32> {
        edges::triangle_sides::apex(self.triangles[face as usize], ends)
    }

    /// Height of the second face at an edge over the plane of the first, towards its outer side, times twice the
    /// area of the first. It is positive for hollows and negative for ridges.
    pub(crate) fn fold_height(&self, [first, second]: [u32; 2], ends: [u32; 2]) -> f64 {
        let Some(apex) = self.apex(second, ends) else { return 0.0 };
        let way = self.positions[apex as usize] - self.positions[ends[0] as usize];
        self.area_vector(FaceId(first)).dot(way)
    }
}
