//! [`Soup`]: triangles of a flattened scene before welding.

use glam::DVec3;

use super::{MaterialId, PaintId, PartId};

/// Mark of one side of a triangle, from the file (EXT_mesh_primitive_edge_visibility) or from a section cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u8)]
pub enum EdgeMark {
    /// Unmarked: the dihedral angle decides.
    #[default]
    Unmarked = 0,
    /// Never a crease.
    Hidden = 1,
    /// A line only where it is a contour.
    Contour = 2,
    /// Always a crease.
    Hard = 3,
    /// No line of any kind, even at a border. Used along a section plane inside another part.
    Covered = 4,
    /// Always a crease, owned by this triangle. Used where a face ends at a section cut.
    Cut = 5,
    /// Diagonal that the reader added inside a polygon of the file. No crease, unless the polygon is folded
    /// there by more than [`tolerances::FOLDED_POLYGON_DEG`](super::tolerances::FOLDED_POLYGON_DEG).
    Diagonal = 6,
}

/// Line of the model without faces: OBJ `l`, glTF line primitives.
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
/// Arrays "per triangle" have the length of `triangles`, or are empty where nothing is known.
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
    /// Paint of each triangle; empty if each has the paint of its material.
    pub triangle_paint: Vec<PaintId>,
    /// Unit normals in world space, indexed by `corner_normals`.
    pub normals: Vec<[f32; 3]>,
    /// Normals of the corners of each triangle (`u32::MAX` = none), or empty.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, indexed by `corner_uvs`.
    pub uvs: Vec<[f32; 2]>,
    /// Texture coordinates of the corners of each triangle (`u32::MAX` = none), or empty.
    pub corner_uvs: Vec<[u32; 3]>,
    /// Linear colours of the corners of each triangle, or empty if no colour varies within a triangle.
    pub corner_colours: Vec<[[f32; 3]; 3]>,
    /// Marks of the sides 0-1, 1-2, 2-0 of each triangle, or empty.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    /// Lines without faces.
    pub wires: Vec<Wire>,
    /// Whether the file stored single-precision positions, so that coincident corners may differ in the last
    /// bits of an `f32`.
    pub single_precision: bool,
    /// Step of the coordinates of each part as written in the file, world units. Parts not in the list are
    /// exact.
    pub steps: Vec<f64>,
}
