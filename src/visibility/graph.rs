//! Vertices and edges of the view map.

use glam::DVec2;
use kurbo::Point;

use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};
use crate::surface::MeshSource;

/// Id of a vertex of the view map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ViewVertexId(pub u32);

impl ViewVertexId {
    /// The id as an index into [`ViewMap::vertices`].
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Reason why a view edge ends at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ViewVertexKind {
    /// Image of a vertex of the mesh, of a wire or of an intersection curve.
    Vertex,
    /// T-junction: the line passes behind a nearer surface, or out from behind it.
    TJunction,
    /// The line pierces a surface, or two lines on the surface cross.
    Piercing,
    /// Cusp: the contour of a rounded surface turns back in the image and continues behind the surface.
    Cusp,
    /// A surface behind the line begins or ends; the visibility of the line does not change.
    Backdrop,
    /// The frame or the near plane cuts the line.
    Frame,
}

/// Vertex of the view map: a point of the image, in user units (px or mm), x right, y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewVertex {
    /// Position in the image.
    pub position: Point,
    /// Distance from the eye along the optical axis, world units.
    pub depth: f64,
    /// Strength of the lines here, 0 to 1. Only interior lines are ever weaker than 1.
    pub(crate) strength: f32,
    /// Reason for the vertex.
    pub kind: ViewVertexKind,
}

/// Straight piece of a feature line between two vertices, with constant invisibility.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewEdge {
    /// Start vertex.
    pub start: ViewVertexId,
    /// End vertex.
    pub end: ViewVertexId,
    /// Kind of line.
    pub kind: LineKind,
    /// Number of surface layers between the edge and the eye; 0 = visible.
    pub invisibility: u16,
    /// Whether it is visible with background on one side.
    pub silhouette: bool,
    /// Whether both surfaces that meet in the line face the eye. The thick-and-thin rule draws such lines
    /// thin.
    pub(crate) both_seen: bool,
    /// Whether the line lies on a smooth surface, as contours of rounded surfaces do. The corners of the mesh
    /// along it are then artefacts of tessellation.
    pub(crate) smooth: bool,
    /// Origin of the surface under the line.
    pub(crate) origin: MeshSource,
    /// Strength of the line: for a crease its dihedral angle in degrees (0 to 180), for other kinds 180.
    pub(crate) strength: f32,
    /// Part of its nearer surface.
    pub part: PartId,
    /// Material of its nearer surface.
    pub material: MaterialId,
    /// Feature segment it was cut from; pieces of one segment share it.
    pub(crate) segment: u32,
}

/// Planar graph of all feature lines in the image.
///
/// Edges meet because they share a vertex id, never because two positions are close.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViewMap {
    /// Vertices.
    pub vertices: Vec<ViewVertex>,
    /// Edges, in the order of the feature segments they were cut from.
    pub edges: Vec<ViewEdge>,
    /// Number of comparisons between a feature segment and a triangle.
    pub(crate) tests: u64,
    /// Agreement between smooth contours and mesh contours.
    pub(crate) contours: ContourCounts,
    /// Visible parts of the mesh contours of rounded surfaces, drawn or not.
    pub(crate) visible_contours: Vec<VisibleContour>,
    /// Feature segments that are sides of folds thinner than a pen stroke, ascending. They show nothing
    /// useful.
    pub(crate) thin_folds: Vec<u32>,
    /// First part of each part's body, as in [`Mesh::bodies`](crate::mesh::Mesh::bodies).
    pub(crate) bodies: Vec<PartId>,
}

/// Visible piece of the mesh contour of a rounded surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct VisibleContour {
    /// Start and end in the camera's frame, user units.
    pub ends: [DVec2; 2],
    /// Its feature segment.
    pub segment: u32,
}

/// Agreement between smooth contours and mesh contours. Where they disagree, the mesh contour is drawn and
/// counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct ContourCounts {
    /// Smooth contours on the page.
    pub curves: u64,
    /// Visible edges of the mesh contour, or parts of them, that are drawn because no smooth contour is near.
    pub unmatched: u64,
    /// Visible parts of the mesh contour left out as folds of a few faces that the smooth surface does not
    /// have.
    pub folds: u64,
}
