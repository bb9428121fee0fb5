//! [`Lit`]: a surface under light, point by point.

use glam::DVec3;

use crate::geometry::numbers::tolerance;
use crate::light::{ShadedNormals, Shading, SurfacePoint};
use crate::lines::Textures;
use crate::mesh::{FaceId, Mesh, PaintId};
use crate::view::View;

/// A lit surface, seen by an eye.
#[derive(Debug, Clone, Copy)]
pub struct Lit<'a> {
    /// The faces.
    pub mesh: &'a Mesh,
    /// Where the eye is.
    pub view: &'a View,
    /// Normals by which light falls.
    pub normals: &'a ShadedNormals,
    /// The lights, and the levels of tone.
    pub shading: &'a Shading,
    /// How much of the sky each vertex of the mesh sees, or empty.
    pub openness: &'a [f64],
    /// The pictures that are seen on it.
    pub textures: &'a Textures,
    /// The parts nobody sees the inside of, by their number; none if empty.
    pub solid: &'a [bool],
}

impl Lit<'_> {
    /// The paint at a point of a face.
    #[must_use]
    pub fn paint(&self, face: u32, at: DVec3) -> PaintId {
        self.textures.paint(self.mesh, face, at)
    }

    /// The point of a face with these barycentric weights, as light falls on the side that the eye
    /// sees. The same on both faces of an edge that share their normals.
    #[must_use]
    pub fn point(&self, face: u32, weights: [f64; 3]) -> SurfacePoint {
        let t = self.mesh.triangles[face as usize];
        let openness = if self.openness.is_empty() {
            1.0
        } else {
            (0..3).map(|k| self.openness[t[k] as usize] * weights[k]).sum()
        };
        let [a, b, c] = self.mesh.corners(FaceId(face));
        SurfacePoint {
            position: DVec3::ZERO + a * weights[0] + b * weights[1] + c * weights[2],
            normal: self.normal(face, &self.normals.of(face), weights),
            openness,
        }
    }

    /// The unit normal of a face at the point with these weights, on the side that the eye sees; `corners` are those at its corners.
    #[inline]
    pub(crate) fn normal(&self, face: u32, corners: &[DVec3; 3], weights: [f64; 3]) -> DVec3 {
        let sum = DVec3::ZERO + corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let normal = sum.normalize_or_zero();
        if self.view.facing[face as usize] { normal } else { -normal }
    }

    /// A point of a face, moved out to the curved surface for which the face stands, if that is no
    /// more than a fraction of a px away: coarser faces show as what they are.
    ///
    /// Source: Boubekeur and Alexa, "Phong tessellation", SIGGRAPH Asia 2008, eq. 3, with a weight
    /// of 1/2, which is right for spheres.
    pub(crate) fn lifted(&self, face: u32, weights: [f64; 3], px: f64) -> DVec3 {
        let corners = self.mesh.corners(FaceId(face));
        let normals = self.normals.of(face);
        let p = DVec3::ZERO + corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let onto = |k: usize| normals[k] * ((p - corners[k]).dot(normals[k]) * weights[k]);
        let lift = -(DVec3::ZERO + onto(0) + onto(1) + onto(2)) / 2.0;
        let frame = &self.view.frame;
        let per_px = if frame.perspective { frame.depth(p) } else { 1.0 } * px / frame.scale;
        let way = lift.length() / (per_px * tolerance::LIFT_PX);
        // Whole up to half of that, then less and less.
        p + lift * (2.0 - 2.0 * way).clamp(0.0, 1.0)
    }

    /// Whether the eye may see a face: not the averted ones of solid parts.
    #[inline]
    pub(crate) fn may_be_seen(&self, face: usize) -> bool {
        let solid = || self.solid.get(self.mesh.face_part[face].index()).copied().unwrap_or_default();
        self.view.facing[face] || !solid()
    }

    /// The tone of a point, for lights of which those in `shadowed` do not reach it.
    #[must_use]
    pub fn tone(&self, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> u16 {
        self.tone_and_bin(paint, point, shadowed).0
    }

    /// The tone of a point, and the bin of light in which it is hatched, 0 the darkest.
    #[must_use]
    pub fn tone_and_bin(&self, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> (u16, u16) {
        self.look(paint, point, shadowed, |_, _, band| band)
    }

    /// The tone and the bin of a point of a face, as they are shown there: steps of a gradient that are too narrow count as one.
    #[must_use]
    pub fn tone_and_bin_shown(
        &self,
        face: u32,
        paint: PaintId,
        point: &SurfacePoint,
        shadowed: u32,
    ) -> (u16, u16) {
        let shown = |channel, levels: &[f64], band| self.band_shown(face, channel, levels, band, shadowed);
        self.look(paint, point, shadowed, shown)
    }

    /// The tone and the bin of a point; `shown` tells from a channel, its levels, and how many of them are reached as how
    /// many that counts.
    fn look(
        &self,
        paint: PaintId,
        point: &SurfacePoint,
        shadowed: u32,
        shown: impl Fn(usize, &[f64], usize) -> usize,
    ) -> (u16, u16) {
        let channels = self.shading.channels();
        let mut bands = [0u16; MOST_CHANNELS];
        for (channel, band) in bands.iter_mut().enumerate().take(channels) {
            let value = self.shading.value(channel, paint, point, shadowed);
            let levels = self.shading.levels(paint, channel);
            *band = shown(channel, levels, levels.partition_point(|level| *level <= value)) as u16;
        }
        let bin = self.shading.bins().and_then(|channel| bands.get(channel)).copied().unwrap_or_default();
        (self.shading.tone(paint, &bands[..channels.min(MOST_CHANNELS)]), bin)
    }
}

/// Most channels of a shading.
const MOST_CHANNELS: usize = 8;
