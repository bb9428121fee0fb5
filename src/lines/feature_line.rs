//! [`FeatureSegment`]: one straight piece of a feature line, on one edge or between two faces.

use std::ops::Range;

use glam::DVec3;

use super::LineKind;
use crate::mesh::{MaterialId, Mesh, PartId, Wire};
use crate::surface::Origin;

/// In [`FeatureSegment::hosts`]: no face.
pub const NO_FACE: u32 = u32::MAX;

/// What a feature segment does in the drawing.
///
/// The contour of a rounded surface is two lines: the edges along which its polyhedron turns from the
/// eye, of which is known exactly what is seen, and the smooth curve beside them that is inked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Role {
    /// It is drawn where it is seen itself.
    #[default]
    Line,
    /// An edge along which the polyhedron of a rounded surface turns from the eye: it says what is
    /// seen of the curve near it, and is drawn itself only where there is none.
    Witness {
        /// Whether the surface bends away from its outside here.
        convex: bool,
        /// Whether the smooth surface does not turn from the eye here, but only a few of its faces do.
        fold: bool,
    },
    /// A piece of a smooth contour: it is drawn where witnesses are seen.
    Curve,
}

/// A straight piece of a feature line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureSegment {
    /// Its ends: vertices of the mesh, or beyond those, points of [`FeatureLines::points`].
    pub ends: [u32; 2],
    /// Two of the faces that meet in the line, which therefore never hide it ([`NO_FACE`] = none).
    /// Other faces that have both ends as corners never hide it either.
    pub hosts: [u32; 2],
    /// What line it is.
    pub kind: LineKind,
    /// Whether both surfaces that meet in it turn the same side to the eye.
    pub both_seen: bool,
    /// Whether the surface is rounded here, so that the mesh's corners along the line are
    /// artefacts.
    pub smooth: bool,
    /// How the surface it lies on came about.
    pub origin: Origin,
    /// What it does in the drawing.
    pub role: Role,
    /// The angle by which the surface turns across the line, degrees; 180 where there is none, and 0
    /// where it does not turn.
    pub strength: f32,
    /// The part of the nearer surface.
    pub part: PartId,
    /// The material of the nearer surface.
    pub material: MaterialId,
}

impl FeatureSegment {
    /// A line of the model that belongs to no face.
    #[must_use]
    pub fn of_wire(wire: &Wire) -> Self {
        Self {
            ends: wire.vertices,
            hosts: [NO_FACE; 2],
            kind: LineKind::Wire,
            both_seen: true,
            smooth: false,
            origin: Origin::default(),
            role: Role::Line,
            strength: 180.0,
            part: wire.part,
            material: wire.material,
        }
    }
}

/// A piece of a line between two tones or paints.
pub(crate) fn segment(
    mesh: &Mesh,
    face: u32,
    hosts: [u32; 2],
    kind: LineKind,
    ends: [u32; 2],
) -> FeatureSegment {
    FeatureSegment {
        ends,
        hosts,
        kind,
        both_seen: true,
        smooth: hosts[1] == NO_FACE,
        origin: Origin::default(),
        role: Role::Line,
        strength: 180.0,
        part: mesh.face_part[face as usize],
        material: mesh.face_material[face as usize],
    }
}

/// A contour of a rounded surface: a run of feature segments from head to tail, with the facing side
/// of the surface on their left, seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct ContourCurve {
    /// Its pieces in [`FeatureLines::segments`].
    pub segments: Range<u32>,
    /// Whether it ends where it begins.
    pub closed: bool,
    /// For each piece, positive where the facing side of the surface is the nearer one and negative
    /// where the averted side is: there the image of the curve runs backward, between one cusp and
    /// the next. The magnitude, 0 to 1, is how much of the piece says so.
    pub advance: Vec<f32>,
}

/// All feature lines of a view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FeatureLines {
    /// The pieces; those that share an end id are joined there.
    pub segments: Vec<FeatureSegment>,
    /// Ends that are no vertices of the mesh, in local space.
    pub points: Vec<DVec3>,
    /// How strong the lines are at the first of these points, 0 to 1; at all other ends they are as
    /// strong as can be.
    pub strengths: Vec<f32>,
    /// The contours of rounded surfaces among the pieces, in ascending order.
    pub curves: Vec<ContourCurve>,
}

impl FeatureLines {
    /// The local position of an end.
    #[inline]
    #[must_use]
    pub fn position(&self, mesh: &Mesh, end: u32) -> DVec3 {
        let end = end as usize;
        let vertices = mesh.positions.len();
        if end < vertices { mesh.positions[end] } else { self.points[end - vertices] }
    }

    /// Adds contours, to lines that have no points of their own yet.
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

    /// How strong the lines are at an end, 0 to 1.
    #[inline]
    #[must_use]
    pub fn strength(&self, mesh: &Mesh, end: u32) -> f32 {
        let point = (end as usize).checked_sub(mesh.positions.len());
        point.and_then(|point| self.strengths.get(point)).copied().unwrap_or(1.0)
    }
}
