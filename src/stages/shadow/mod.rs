//! [`Shadows`]: what each light leaves in shadow, as lines on the surface and as an answer for points.
//!
//! A light sees exactly what it lights. So each light that casts shadows gets views of its own, and
//! the contours and borders it sees in them are all that shadows can end at: their projection onto the
//! surface behind them is the border of the shadow (see `receive`).
//!
//! Source: P. Atherton, K. Weiler and D. Greenberg, "Polygon shadow generation", SIGGRAPH 1978: the
//! visible parts of a view from the light, carried back onto the surface, are its lit parts. Here
//! only the borders are carried.

mod cast;
mod envelope;
mod join;
mod light;
pub mod lines;
mod outside;
mod receive;
mod test_points;

use crate::parallel::prelude::*;
use glam::DVec3;

pub use crate::field::Caster;
pub use lines::{ShadowLines, ShadowSegment};

use crate::lines::Surface;
use crate::mesh::Mesh;
use light::LightView;
use outside::Outside;

/// No more lights than this cast shadows: as many as a mask has bits.
pub const MOST_CASTERS: usize = 32;

/// The shadows of some lights on a mesh.
#[derive(Debug, Clone, Default)]
pub struct Shadows {
    /// Where the shadows end.
    pub lines: ShadowLines,
    casters: Vec<Caster>,
    /// The views of each light.
    views: Vec<Vec<LightView>>,
    /// On which side of each face it is outside.
    outside: Vec<Outside>,
}

impl Shadows {
    /// The shadows of these lights, the first [`MOST_CASTERS`] of them.
    #[must_use]
    pub fn new(mesh: &Mesh, casters: &[Caster]) -> Self {
        let casters = casters[..casters.len().min(MOST_CASTERS)].to_vec();
        if mesh.triangles.is_empty() || casters.is_empty() {
            return Self::default();
        }
        // In local space, so that models far from the origin keep their digits.
        let surface = Surface { mesh: Mesh { origin: DVec3::ZERO, ..mesh.clone() }, ..Surface::default() };
        let mut lines = ShadowLines::default();
        let mut views = Vec::with_capacity(casters.len());
        for (k, caster) in casters.iter().enumerate() {
            let of_caster = light::views(&surface.mesh, caster);
            let cast: Vec<_> = of_caster.par_iter().map(|light| receive::borders(&surface, light)).collect();
            lines.add(k as u32, join::joined(&surface.mesh, cast));
            views.push(of_caster);
        }
        Self { lines, casters, views, outside: outside::outside(mesh) }
    }

    /// The lights that casts these shadows; bit k of a mask is the k-th of them.
    #[must_use]
    pub fn casters(&self) -> &[Caster] {
        &self.casters
    }

    /// Which lights do not reach a point (local space) on a face: bit k is set where another face
    /// stands between it and light k.
    ///
    /// Faces of solids that are turned away from a light are dark by themselves; for them its bit is
    /// never set. On sheets, of which either side may be seen, it is. For many points, [`Shadows::shadowed`] is much faster.
    #[must_use]
    pub fn unlit(&self, mesh: &Mesh, face: u32, point: DVec3) -> u32 {
        self.shadowed(mesh, &[(face, point)])[0]
    }

    /// The masks of many points, each on a face: which lights do not reach them.
    #[must_use]
    pub fn shadowed(&self, mesh: &Mesh, points: &[(u32, DVec3)]) -> Vec<u32> {
        let mut masks = vec![0; points.len()];
        for (k, (caster, views)) in self.casters.iter().zip(&self.views).enumerate() {
            test_points::mark(mesh, caster, views, &self.outside, points, 1 << k, &mut masks);
        }
        masks
    }
}
