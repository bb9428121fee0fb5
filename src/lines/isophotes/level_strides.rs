//! Level strides: merges the steps of a gradient on faces where they are too narrow to be seen.
//!
//! Close to a contour, hundreds of steps may fall into one px. They are invisible, but each would cost time
//! in every later stage. A face with narrow steps keeps every second border only, or every fourth, and so on.
//! The merged band gets its middle tone. Where a neighbour keeps more borders, the others end, and the
//! triangulation of the page closes the gap.

use glam::DVec2;

use super::isophote_lines::page_px;
use crate::lines::Lit;
use crate::lines::tolerances;
use crate::mesh::PaintId;

impl Lit<'_> {
    /// Whether the levels of a channel are too close for single steps to be seen.
    pub(crate) fn is_gradient(&self, channel: usize, levels: &[f64]) -> bool {
        levels.len() > crate::light::tolerances::MAX_SEPARATE_LEVELS
            && self.shading.bin_channel() != Some(channel)
    }

    /// Number of steps of a channel that a face shows as one: a power of two, 1 unless it is a gradient.
    pub(crate) fn stride(&self, face: u32, channel: usize, levels: &[f64], shadowed: u32) -> usize {
        let [first, .., last] = levels else { return 1 };
        if !self.is_gradient(channel, levels) {
            return 1;
        }
        let points = self.mesh.triangles[face as usize].map(|v| self.view.points[v as usize]);
        let [a, b, c] = points.map(|p| p.truncate());
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let [n, m, o] = self.normals.of(face);
        let turn = n.distance(m).max(m.distance(o)).max(o.distance(n));
        let px = page_px(self);
        // Light that is not almost linear is steep in a part of the face only.
        let is_bent = turn > MAX_LINEAR_TURN_RAD
            || (self.shading.is_local(channel) && longest > MAX_LINEAR_FACE_PX * px);
        if is_bent || points.iter().any(|p| p.is_nan()) {
            return 1;
        }
        let paint = PaintId(0);
        let value = |weights| self.shading.value(channel, paint, &self.point(face, weights), shadowed);
        let values = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(value);
        let step = (last - first) / (levels.len() - 1) as f64;
        let narrow = |stride: usize| {
            let steep = steepness([a, b, c], values) * tolerances::MIN_GRADIENT_STEP_PX * px;
            stride < MAX_STRIDE && steep > step * stride as f64
        };
        let mut stride = 1;
        while narrow(stride) {
            stride *= 2;
        }
        stride
    }

    /// Band of a point as its face shows it, given the number of levels reached.
    pub(crate) fn band_shown(
        &self,
        face: u32,
        channel: usize,
        levels: &[f64],
        band: usize,
        shadowed: u32,
    ) -> usize {
        match self.stride(face, channel, levels, shadowed) {
            1 => band,
            stride => (band / stride * stride + stride / 2).min(levels.len()),
        }
    }
}

/// Gradient length of a linear function, from its values at three points.
fn steepness([a, b, c]: [DVec2; 3], [at_a, at_b, at_c]: [f64; 3]) -> f64 {
    let (u, v) = (b - a, c - a);
    let (by_u, by_v) = (at_b - at_a, at_c - at_a);
    let area = u.perp_dot(v);
    let gradient = DVec2::new(by_u * v.y - by_v * u.y, by_v * u.x - by_u * v.x);
    if gradient == DVec2::ZERO { 0.0 } else { gradient.length() / area.abs() }
}

/// Largest turn of normals for which light is almost linear, radians.
const MAX_LINEAR_TURN_RAD: f64 = 0.25;

/// Largest face on which light that depends on position is almost linear, px.
const MAX_LINEAR_FACE_PX: f64 = 40.0;

/// Maximum number of merged steps.
const MAX_STRIDE: usize = 16;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steepness_of_a_plane_is_its_gradient_length() {
        let at = [DVec2::new(1.0, 2.0), DVec2::new(7.0, 3.0), DVec2::new(2.0, 9.0)];
        let steep = steepness(at, at.map(|p| 5.0 + p.dot(DVec2::new(0.3, -0.4))));
        assert!((steep - 0.5).abs() < 1e-12);
        assert_eq!(steepness(at, [1.0; 3]), 0.0);
    }
}
