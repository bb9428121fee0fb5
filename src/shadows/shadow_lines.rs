//! [`ShadowLines`]: where shadows end, as segments on the faces that they fall on.

use glam::DVec3;

use super::border_segments::Joined;
use crate::lines::{FeatureLines, FeatureSegment, LineKind, NO_FACE, Role};
use crate::mesh::Mesh;
use crate::surface::Origin;

/// A straight piece of the border of a shadow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShadowSegment {
    /// The face it lies on.
    pub face: u32,
    /// Its ends: indices of [`ShadowLines::points`].
    pub ends: [u32; 2],
    /// Which of the lights casts it.
    pub caster: u32,
}

/// Where the shadows of some lights end.
///
/// The border of a cast shadow is where an edge that a light sees falls onto what is behind it. Where
/// the surface itself turns away from the light, and where two surfaces meet, is no line of these:
/// those are known without the light's view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ShadowLines {
    /// Ends of the segments, local space; segments that share one go on there.
    pub points: Vec<DVec3>,
    /// The pieces, light by light.
    pub segments: Vec<ShadowSegment>,
}

impl ShadowLines {
    /// Adds the borders of one light.
    pub(crate) fn add(&mut self, caster: u32, joined: Joined) {
        let first = self.points.len() as u32;
        self.points.extend(joined.points);
        let segment =
            |(face, ends): (u32, [u32; 2])| ShadowSegment { face, ends: ends.map(|end| first + end), caster };
        self.segments.extend(joined.segments.into_iter().map(segment));
    }

    /// Adds them to the feature lines of a view of the mesh, as borders of tones.
    pub fn append_to(&self, mesh: &Mesh, lines: &mut FeatureLines) {
        let first = (mesh.positions.len() + lines.points.len()) as u32;
        lines.points.extend_from_slice(&self.points);
        lines.segments.extend(self.segments.iter().map(|segment| FeatureSegment {
            ends: segment.ends.map(|end| first + end),
            hosts: [segment.face, NO_FACE],
            kind: LineKind::Isophote,
            both_seen: true,
            smooth: false,
            origin: Origin::default(),
            role: Role::Line,
            strength: 0.0,
            part: mesh.face_part[segment.face as usize],
            material: mesh.face_material[segment.face as usize],
        }));
    }
}
