//! [`ShadowLines`]: shadow borders, as segments on the faces that they fall on.

use glam::DVec3;

use super::border_segments::JoinedBorders;
use crate::lines::{FeatureLines, FeatureSegment, LineKind, NO_FACE};
use crate::mesh::Mesh;

/// Straight piece of a shadow border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShadowSegment {
    /// Face it lies on.
    pub face: u32,
    /// Its ends, as indices into [`ShadowLines::points`].
    pub ends: [u32; 2],
    /// Index of the light that casts it.
    pub caster: u32,
}

/// Borders of the cast shadows of some lights.
///
/// A border is the projection of an edge, visible from a light, onto the surface behind it. Places where the
/// surface turns away from the light, and where two surfaces meet, are not included. They follow without the
/// light's view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ShadowLines {
    /// Ends of the segments, local space. Segments that share an end are connected.
    pub points: Vec<DVec3>,
    /// Segments, light by light.
    pub segments: Vec<ShadowSegment>,
}

impl ShadowLines {
    /// Adds the borders of one light.
    pub(crate) fn add(&mut self, caster: u32, joined: JoinedBorders) {
        let first = self.points.len() as u32;
        self.points.extend(joined.points);
        let segment =
            |(face, ends): (u32, [u32; 2])| ShadowSegment { face, ends: ends.map(|end| first + end), caster };
        self.segments.extend(joined.segments.into_iter().map(segment));
    }

    /// Adds them to the feature lines of a view of the mesh, as tone borders.
    pub fn append_to(&self, mesh: &Mesh, lines: &mut FeatureLines) {
        let first = (mesh.positions.len() + lines.points.len()) as u32;
        lines.points.extend_from_slice(&self.points);
        lines.segments.extend(self.segments.iter().map(|ShadowSegment { face, ends, .. }| {
            let ends = ends.map(|end| first + end);
            let own = FeatureSegment::on_face(mesh, *face, [*face, NO_FACE], LineKind::Isophote, ends);
            FeatureSegment { strength: 0.0, ..own }
        }));
    }
}
