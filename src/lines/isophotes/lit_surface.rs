//! [`Lit`]: a lit surface in a view; returns paint, light and tone at any point of it.

use glam::DVec3;

use crate::light::{Shading, ShadingNormals, SurfacePoint};
use crate::lines::Textures;
use crate::lines::tolerances;
use crate::mesh::{FaceId, Mesh, PaintId};
use crate::view::View;

/// Lit surface in a view.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lit<'a> {
    /// Faces.
    pub mesh: &'a Mesh,
    /// Camera view.
    pub view: &'a View,
    /// Shading normals.
    pub normals: &'a ShadingNormals,
    /// Lights and levels of tone.
    pub shading: &'a Shading,
    /// Ambient visibility per vertex, 0 to 1; empty if not used.
    pub ambient_visibility: &'a [f64],
    /// Textures of the surface.
    pub textures: &'a Textures,
    /// Whether the inside of each part is never visible; empty if unknown.
    pub solid: &'a [bool],
}

impl Lit<'_> {
    /// Paint at a point of a face.
    #[must_use]
    pub(crate) fn paint(&self, face: u32, at: DVec3) -> PaintId {
        self.textures.paint(self.mesh, face, at)
    }

    /// Surface point with the given barycentric weights, lit on the side that the camera sees. Faces that
    /// share normals along an edge return the same points there.
    #[must_use]
    pub(crate) fn point(&self, face: u32, weights: [f64; 3]) -> SurfacePoint {
        let t = self.mesh.triangles[face as usize];
        let openness = if self.ambient_visibility.is_empty() {
            1.0
        } else {
            (0..3).map(|k| self.ambient_visibility[t[k] as usize] * weights[k]).sum()
        };
        let [a, b, c] = self.mesh.corners(FaceId(face));
        SurfacePoint {
            position: DVec3::ZERO + a * weights[0] + b * weights[1] + c * weights[2],
            normal: self.normal(face, &self.normals.of(face), weights),
            ambient_visibility: openness,
        }
    }

    /// Interpolated unit normal of a face, on the side that the camera sees. `corners` are the normals at its
    /// corners.
    #[inline]
    pub(crate) fn normal(&self, face: u32, corners: &[DVec3; 3], weights: [f64; 3]) -> DVec3 {
        let sum = DVec3::ZERO + corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let normal = sum.normalize_or_zero();
        if self.view.facing[face as usize] { normal } else { -normal }
    }

    /// Point of a face, moved out to the curved surface that the face approximates. Only shifts of a fraction
    /// of a px are applied, so coarse faces keep their shape.
    ///
    /// Source: Boubekeur and Alexa, "Phong tessellation", SIGGRAPH Asia 2008, eq. 3, with weight 1/2, which
    /// is right for spheres.
    pub(crate) fn lifted(&self, face: u32, weights: [f64; 3], px: f64) -> DVec3 {
        let corners = self.mesh.corners(FaceId(face));
        let normals = self.normals.of(face);
        let p = DVec3::ZERO + corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let onto = |k: usize| normals[k] * ((p - corners[k]).dot(normals[k]) * weights[k]);
        let lift = -(DVec3::ZERO + onto(0) + onto(1) + onto(2)) / 2.0;
        let frame = &self.view.frame;
        let per_px = if frame.perspective { frame.depth(p) } else { 1.0 } * px / frame.scale;
        let way = lift.length() / (per_px * tolerances::MAX_SURFACE_LIFT_PX);
        // The full shift up to half of the limit, then less, down to none.
        p + lift * (2.0 - 2.0 * way).clamp(0.0, 1.0)
    }

    /// Whether a face may be visible: averted faces of solid parts are not.
    #[inline]
    pub(crate) fn may_be_seen(&self, face: usize) -> bool {
        let solid = || self.solid.get(self.mesh.face_part[face].index()).copied().unwrap_or_default();
        self.view.facing[face] || !solid()
    }

    /// Tone of a point, given a mask of the shadowed lights.
    #[must_use]
    pub(crate) fn tone(&self, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> u16 {
        self.tone_and_bin(paint, point, shadowed).0
    }

    /// Tone and hatching bin of a point; 0 is the darkest.
    #[must_use]
    pub(crate) fn tone_and_bin(&self, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> (u16, u16) {
        self.tone_and_bin_at(paint, point, shadowed, |_, _, band| band)
    }

    /// Tone and hatching bin of a point of a face as drawn, where narrow steps of a gradient are merged.
    #[must_use]
    pub(crate) fn tone_and_bin_shown(
        &self,
        face: u32,
        paint: PaintId,
        point: &SurfacePoint,
        shadowed: u32,
    ) -> (u16, u16) {
        let shown = |channel, levels: &[f64], band| self.band_shown(face, channel, levels, band, shadowed);
        self.tone_and_bin_at(paint, point, shadowed, shown)
    }

    /// Tone and hatching bin of a point. `shown` maps the number of levels reached in a channel to the number
    /// that counts.
    fn tone_and_bin_at(
        &self,
        paint: PaintId,
        point: &SurfacePoint,
        shadowed: u32,
        shown: impl Fn(usize, &[f64], usize) -> usize,
    ) -> (u16, u16) {
        let channels = self.shading.channels();
        let mut bands = [0u16; MAX_CHANNELS];
        for (channel, band) in bands.iter_mut().enumerate().take(channels) {
            let value = self.shading.value(channel, paint, point, shadowed);
            let levels = self.shading.levels(paint, channel);
            *band = shown(channel, levels, levels.partition_point(|level| *level <= value)) as u16;
        }
        let bin =
            self.shading.bin_channel().and_then(|channel| bands.get(channel)).copied().unwrap_or_default();
        (self.shading.tone(paint, &bands[..channels.min(MAX_CHANNELS)]), bin)
    }
}

/// Maximum number of channels.
const MAX_CHANNELS: usize = 8;
