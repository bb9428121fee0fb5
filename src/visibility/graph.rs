//! The nodes and pieces of the view map.

use glam::DVec2;
use kurbo::Point;

use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};
use crate::surface::Origin;

/// A node of the view map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ViewVertexId(pub u32);

impl ViewVertexId {
    /// The id as an index into [`ViewMap::vertices`].
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Why a view edge ends where it does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ViewVertexKind {
    /// The image of a vertex of the mesh (or of a wire, or of an intersection curve).
    Vertex,
    /// The line passes under (or out from under) a nearer surface here: a T-junction.
    TJunction,
    /// The line pierces a surface, or two lines on the surface cross.
    Piercing,
    /// The contour of a rounded surface turns back in the image, and goes on behind the surface.
    Cusp,
    /// Something behind the line begins or ends here; visibility does not change.
    Backdrop,
    /// The frame or the near plane cuts the line.
    Frame,
}

/// A node: a point of the image, in user units (px or mm), x right, y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewVertex {
    /// Where it is in the image.
    pub position: Point,
    /// Distance from the eye along the optical axis, world units.
    pub depth: f64,
    /// How strong the lines are here, 0 to 1: only lines inside are ever weaker than 1.
    pub strength: f32,
    /// Why there is a node here.
    pub kind: ViewVertexKind,
}

/// A straight piece of a feature line between two nodes, of one invisibility throughout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewEdge {
    /// Where it starts.
    pub start: ViewVertexId,
    /// Where it ends.
    pub end: ViewVertexId,
    /// What line it is.
    pub kind: LineKind,
    /// Number of surface layers between it and the eye; 0 = visible.
    pub invisibility: u16,
    /// Visible, with background on one side.
    pub silhouette: bool,
    /// Whether both surfaces that meet in the line face the eye (thin by the thick-and-thin rule).
    pub both_seen: bool,
    /// Whether the line lies on a smooth surface, so that the corners of the mesh along it are
    /// artefacts of tessellation: contours of rounded surfaces.
    pub smooth: bool,
    /// How the surface it lies on came about.
    pub origin: Origin,
    /// How pronounced the line is: for a crease its dihedral angle in degrees (0 to 180),
    /// for other kinds 180.
    pub strength: f32,
    /// The part the line belongs to (of its nearer surface).
    pub part: PartId,
    /// The material beside it (of its nearer surface).
    pub material: MaterialId,
    /// Feature line segment it was cut from: pieces of one segment share it.
    pub segment: u32,
}

/// The planar graph of all feature lines in the image.
///
/// Edges meet because they share a vertex id, never because two positions are near.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViewMap {
    /// Nodes.
    pub vertices: Vec<ViewVertex>,
    /// Pieces, in the order of the feature segments they were cut from.
    pub edges: Vec<ViewEdge>,
    /// How many times a feature segment was compared with a triangle to decide all this.
    pub tests: u64,
    /// What smooth contours and the polyhedron's have of each other.
    pub contours: ContourCounts,
    /// What is seen of the contours that rounded surfaces have as polyhedra, drawn or not.
    pub seen_contours: Vec<SeenContour>,
    /// The feature segments that are sides of folds thinner than a pen, ascending: lines that tell nothing.
    pub needles: Vec<u32>,
    /// For each part the first part of its body, as in [`Mesh::bodies`](crate::mesh::Mesh::bodies).
    pub bodies: Vec<PartId>,
}

/// A piece of a contour of the polyhedron that nothing hides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenContour {
    /// Where it begins and ends in the camera's frame, user units.
    pub ends: [DVec2; 2],
    /// Its feature segment.
    pub segment: u32,
}

/// What smooth contours and those of the polyhedron have of each other: places where the two do not
/// agree are drawn as the polyhedron has them, and counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ContourCounts {
    /// Smooth contours on the page.
    pub curves: u64,
    /// Visible edges of the polyhedron's contour, or parts of them, that were drawn themselves since
    /// no smooth contour is near.
    pub bare: u64,
    /// Those that were left out as folds of a few faces that the smooth surface does not have.
    pub folds: u64,
}
