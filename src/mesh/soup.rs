//! [`Soup`]: the triangles of a flattened scene, before welding.

use glam::DVec3;

use super::{MaterialId, PaintId, PartId};

/// What a file (EXT_mesh_primitive_edge_visibility) or a section says about one side of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u8)]
pub enum EdgeMark {
    /// Nothing: the dihedral angle decides.
    #[default]
    Unmarked = 0,
    /// Never a crease.
    Hidden = 1,
    /// A line only where it is a contour.
    Contour = 2,
    /// Always a crease.
    Hard = 3,
    /// No line of any kind, also where the surface ends: what lies along a plane of section within another part.
    Covered = 4,
    /// Always a crease, which belongs to this triangle: where a face ends along which a section is cut.
    Cut = 5,
    /// A diagonal that the reader added inside a polygon of the file: no crease unless the polygon is folded there by more than
    /// [`tolerance::FOLDED_POLYGON_DEG`](crate::geometry::numbers::tolerance::FOLDED_POLYGON_DEG).
    Diagonal = 6,
}

/// A line of the model that belongs to no face: OBJ `l`, glTF line primitives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wire {
    /// Its two vertices.
    pub vertices: [u32; 2],
    /// The part it belongs to.
    pub part: PartId,
    /// Its material.
    pub material: MaterialId,
}

/// All triangles and wires of a scene in world space, as the files have them.
///
/// Arrays "per triangle" are as long as `triangles`, or empty where nothing is known.
#[derive(Debug, Clone, Default)]
pub struct Soup {
    /// World positions, finite.
    pub positions: Vec<DVec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Part of each triangle.
    pub triangle_part: Vec<PartId>,
    /// Material of each triangle.
    pub triangle_material: Vec<MaterialId>,
    /// Paint of each triangle; empty: that of its material.
    pub triangle_paint: Vec<PaintId>,
    /// Unit normals in world space, to which `corner_normals` points.
    pub normals: Vec<[f32; 3]>,
    /// For each triangle the normals of its corners (`u32::MAX` = none), or empty.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, to which `corner_uvs` points.
    pub uvs: Vec<[f32; 2]>,
    /// For each triangle the texture coordinates of its corners (`u32::MAX` = none), or empty.
    pub corner_uvs: Vec<[u32; 3]>,
    /// For each triangle the linear light of the colours of its corners, or empty where none varies within a triangle.
    pub corner_colours: Vec<[[f32; 3]; 3]>,
    /// For each triangle the marks of its sides 0-1, 1-2, 2-0, or empty.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    /// Lines without faces.
    pub wires: Vec<Wire>,
    /// Whether the file stored single-precision positions, so that corners that belong together
    /// may differ in the last bits of an `f32`.
    pub single_precision: bool,
    /// The step of the coordinates of each part as the file wrote them, world units; parts beyond the list are exact.
    pub steps: Vec<f64>,
}
