//! [`Shadows`]: cast shadows, as border lines on the surface and as a test for points.
//!
//! Algorithm (the visible parts of a view from the light are its lit parts; only their borders are carried
//! back):
//! 1. Every light that casts shadows gets one view of the mesh, or six if it is inside or near it.
//! 2. The visible contours and borders of that view are the edges that cast shadows.
//! 3. Each such edge is projected onto the nearest face behind it: the upper envelope of all faces there.
//! 4. The projected parts are joined into segments on the surface that share their ends.
//!
//! Source: P. Atherton, K. Weiler and D. Greenberg, "Polygon shadow generation", SIGGRAPH 1978.
//! Files, in reading order: [`light_views`] step 1; [`cast_edges`] step 2; [`shadow_receivers`],
//! [`upper_envelope`] step 3; [`border_segments`] step 4; [`shadow_lines`] the result; [`point_shadows`] the
//! test for points; [`face_orientation`] the outer side of each face; [`tolerances`] all thresholds for
//! rounding.

mod border_segments;
mod cast_edges;
mod face_orientation;
mod light_views;
mod point_shadows;
pub(crate) mod shadow_lines;
mod shadow_receivers;
mod tolerances;
mod upper_envelope;

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::light::Caster;
pub(crate) use shadow_lines::ShadowLines;

use crate::lines::Surface;
use crate::mesh::Mesh;
use face_orientation::FaceOrientation;
use light_views::LightView;

/// Largest number of lights that cast shadows: the number of bits in a mask.
pub(crate) const MAX_CASTERS: usize = 32;

/// Shadows of some lights on a mesh.
#[derive(Debug, Clone, Default)]
pub struct Shadows {
    /// Borders of the shadows.
    pub lines: ShadowLines,
    casters: Vec<Caster>,
    /// Views from each light.
    views: Vec<Vec<LightView>>,
    /// Outer side of each face.
    outside: Vec<FaceOrientation>,
}

impl Shadows {
    /// Computes the shadows of these lights, at most of the first [`MAX_CASTERS`].
    #[must_use]
    pub fn new(mesh: &Mesh, casters: &[Caster]) -> Self {
        let casters = casters[..casters.len().min(MAX_CASTERS)].to_vec();
        if mesh.triangles.is_empty() || casters.is_empty() {
            return Self::default();
        }
        // In local space, so models far from the origin keep their precision.
        let surface = Surface { mesh: Mesh { origin: DVec3::ZERO, ..mesh.clone() }, ..Surface::default() };
        let mut lines = ShadowLines::default();
        let mut views = Vec::with_capacity(casters.len());
        for (k, caster) in casters.iter().enumerate() {
            let of_caster = light_views::views(&surface.mesh, caster);
            let cast: Vec<_> =
                of_caster.par_iter().map(|light| shadow_receivers::borders(&surface, light)).collect();
            lines.add(k as u32, border_segments::join_borders(&surface.mesh, cast));
            views.push(of_caster);
        }
        Self { lines, casters, views, outside: face_orientation::face_orientations(mesh) }
    }

    /// Lights that cast these shadows; bit k of a mask belongs to light k.
    #[must_use]
    pub fn casters(&self) -> &[Caster] {
        &self.casters
    }

    /// Masks of the lights that do not reach points (local space), each on a face: bit k is set where another
    /// face lies between the point and light k.
    ///
    /// Faces of solids that are turned away from a light are dark anyway, so their bit is never set. On
    /// sheets, which are visible from both sides, it is.
    #[must_use]
    pub fn shadowed(&self, mesh: &Mesh, points: &[(u32, DVec3)]) -> Vec<u32> {
        let mut masks = vec![0; points.len()];
        for (k, (caster, views)) in self.casters.iter().zip(&self.views).enumerate() {
            point_shadows::mark_shadowed(mesh, caster, views, &self.outside, points, 1 << k, &mut masks);
        }
        masks
    }
}
