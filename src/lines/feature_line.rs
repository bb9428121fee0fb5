//! [`FeatureSegment`]: one straight piece of a feature line, on an edge or inside a face.

use std::ops::Range;

use glam::DVec3;

use super::LineKind;
use crate::mesh::{MaterialId, Mesh, PartId, Wire};
use crate::surface::MeshSource;

/// In [`FeatureSegment::hosts`]: no face.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// Role of a feature segment in the drawing.
///
/// The contour of a rounded surface consists of two lines. The mesh contour is the edges where the polyhedron
/// turns away; its visibility is exact. The smooth contour next to it is the one that is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Role {
    /// Drawn where it is visible.
    #[default]
    Line,
    /// Edge of the mesh contour of a rounded surface. It decides on the visibility of the smooth contour
    /// nearby, and is drawn itself only where there is none.
    MeshContour {
        /// Whether the surface is convex here.
        convex: bool,
        /// Whether only a few faces turn away here, and the smooth surface does not.
        fold: bool,
    },
    /// Piece of a smooth contour, drawn where the mesh contour is visible.
    SmoothContour,
}

/// Straight piece of a feature line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureSegment {
    /// Ends: vertices of the mesh, or, for higher numbers, points of [`FeatureLines::points`].
    pub ends: [u32; 2],
    /// Two of the faces that meet in the line and so never hide it ([`NO_FACE`] = none). Other faces with
    /// both ends as corners never hide it either.
    pub(crate) hosts: [u32; 2],
    /// Kind of line.
    pub kind: LineKind,
    /// Whether both surfaces that meet in it turn the same side to the camera.
    pub(crate) both_seen: bool,
    /// Whether the surface is rounded here, so that corners along the line are artefacts of the mesh.
    pub(crate) smooth: bool,
    /// Origin of the surface.
    pub(crate) origin: MeshSource,
    /// Role in the drawing.
    pub(crate) role: Role,
    /// Turn of the surface across the line, degrees; 180 if not applicable, 0 where it does not turn.
    pub strength: f32,
    /// Part of the nearer surface.
    pub part: PartId,
    /// Material of the nearer surface.
    pub material: MaterialId,
}

impl FeatureSegment {
    /// Segment of a wire, which belongs to no face.
    #[must_use]
    pub(crate) fn of_wire(wire: &Wire) -> Self {
        Self::without_faces(LineKind::Wire, wire.vertices, wire.part, wire.material)
    }

    /// Drawn segment that belongs to no face.
    pub(crate) fn without_faces(kind: LineKind, ends: [u32; 2], part: PartId, material: MaterialId) -> Self {
        Self {
            ends,
            hosts: [NO_FACE; 2],
            kind,
            both_seen: true,
            smooth: false,
            origin: MeshSource::default(),
            role: Role::Line,
            strength: 180.0,
            part,
            material,
        }
    }

    /// Drawn segment that belongs to a face.
    pub(crate) fn on_face(mesh: &Mesh, face: u32, hosts: [u32; 2], kind: LineKind, ends: [u32; 2]) -> Self {
        let (part, material) = (mesh.face_part[face as usize], mesh.face_material[face as usize]);
        Self { hosts, ..Self::without_faces(kind, ends, part, material) }
    }
}

/// Segment of a line between two tones or paints.
pub(crate) fn segment(
    mesh: &Mesh,
    face: u32,
    hosts: [u32; 2],
    kind: LineKind,
    ends: [u32; 2],
) -> FeatureSegment {
    FeatureSegment { smooth: hosts[1] == NO_FACE, ..FeatureSegment::on_face(mesh, face, hosts, kind, ends) }
}

/// Smooth contour of a rounded surface: a run of feature segments from head to tail. The facing side of the
/// surface is on their left, seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ContourCurve {
    /// Its segments in [`FeatureLines::segments`].
    pub segments: Range<u32>,
    /// Whether it is closed.
    pub closed: bool,
    /// Sign per segment: positive where the facing side of the surface is the nearer one, negative where the
    /// averted side is. In the second case the image of the curve runs backward, between two cusps. The
    /// magnitude, 0 to 1, is the confidence.
    pub advance: Vec<f32>,
}

/// All feature lines of a view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FeatureLines {
    /// Segments. Those that share an end id are joined there.
    pub segments: Vec<FeatureSegment>,
    /// Ends that are not mesh vertices, in local space.
    pub(crate) points: Vec<DVec3>,
    /// Strength at the first of these points, 0 to 1; all other ends have strength 1.
    pub(crate) strengths: Vec<f32>,
    /// Smooth contours among the segments, ascending.
    pub(crate) curves: Vec<ContourCurve>,
}

impl FeatureLines {
    /// Local position of an end.
    #[inline]
    #[must_use]
    pub fn position(&self, mesh: &Mesh, end: u32) -> DVec3 {
        let end = end as usize;
        let vertices = mesh.positions.len();
        if end < vertices { mesh.positions[end] } else { self.points[end - vertices] }
    }

    /// Adds contours. The lines must not have points or curves yet.
    pub(crate) fn append_contours(&mut self, contours: Self) {
        debug_assert!(self.points.is_empty() && self.curves.is_empty());
        let first = self.segments.len() as u32;
        self.points = contours.points;
        self.segments.extend(contours.segments);
        self.curves = contours.curves;
        for curve in &mut self.curves {
            curve.segments = curve.segments.start + first..curve.segments.end + first;
        }
    }

    /// Strength at an end, 0 to 1.
    #[inline]
    #[must_use]
    pub fn strength(&self, mesh: &Mesh, end: u32) -> f32 {
        let point = (end as usize).checked_sub(mesh.positions.len());
        point.and_then(|point| self.strengths.get(point)).copied().unwrap_or(1.0)
    }
}
