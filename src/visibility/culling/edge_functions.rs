//! [`EdgeFunctions`]: the edge functions of a triangle, which reject most lines next to it.
//!
//! Of the lines in a tile that overlap the bounding box of a triangle, half are outside one of its sides.
//! Single precision settles most of these cases. Its values are raised by more than their rounding error, so
//! no line is rejected that the exact test ([`crate::visibility::occlusion::triangle_occlusion::covered`]) accepts.
//!
//! Source: Juan Pineda, "A parallel algorithm for polygon rasterization", 1988.

use glam::{DVec2, DVec3};

use crate::visibility::tolerances;
use crate::visibility::view_tolerances::ViewTolerances;

/// Area of the image where [`EdgeFunctions`] are evaluated.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Window {
    /// Centre, the origin of its points.
    pub(crate) middle: DVec2,
    /// Largest distance of a coordinate from the centre, user units.
    pub(crate) reach: f64,
}

impl Window {
    /// Point relative to the centre, in single precision; `None` outside the window.
    #[inline]
    pub(crate) fn point(&self, point: DVec2) -> Option<[f32; 2]> {
        let from_middle = point - self.middle;
        let is_here = from_middle.x.abs() <= self.reach && from_middle.y.abs() <= self.reach;
        is_here.then_some([from_middle.x as f32, from_middle.y as f32])
    }

    /// Two points relative to the centre, if both are in the window.
    #[inline]
    pub(crate) fn both(&self, points: [DVec2; 2]) -> Option<[[f32; 2]; 2]> {
        Some([self.point(points[0])?, self.point(points[1])?])
    }
}

/// Sides of a triangle as linear functions that are negative outside. The fourth function is positive
/// everywhere and fills the register.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EdgeFunctions {
    x: [f32; 4],
    y: [f32; 4],
    at_middle: [f32; 4],
}

impl EdgeFunctions {
    /// Edge functions of a triangle in image space, for the points of a window.
    #[inline]
    pub(crate) fn new(corners: &[DVec3; 3], window: &Window, limits: &ViewTolerances) -> Self {
        let [a, b, c] = corners.map(DVec3::truncate);
        let sign = (b - a).perp_dot(c - a).signum();
        let mut functions = Self { x: [0.0; 4], y: [0.0; 4], at_middle: [1.0; 4] };
        for (k, (corner, next)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            let side = (next - corner) * sign;
            let at_middle = side.perp_dot(window.middle - corner);
            let size = side.x.abs() + side.y.abs();
            let raised = at_middle
                + limits.cover * size
                + tolerances::EDGE_FUNCTION_ROUNDING_SHARE * (at_middle.abs() + window.reach * size);
            (functions.x[k], functions.y[k], functions.at_middle[k]) =
                (-side.y as f32, side.x as f32, raised as f32);
        }
        functions
    }

    /// Whether two points, and so all points between them, are outside the same side.
    #[inline]
    pub(crate) fn are_outside_a_side(&self, a: [f32; 2], b: [f32; 2]) -> bool {
        let mut is_outside = false;
        for k in 0..4 {
            let at = |p: [f32; 2]| self.x[k] * p[0] + self.y[k] * p[1] + self.at_middle[k];
            let (at_a, at_b) = (at(a), at(b));
            is_outside |= at_a < 0.0 && at_b < 0.0;
        }
        is_outside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::{Mesh, Soup};
    use crate::scene::Camera;
    use crate::view::View;
    use crate::visibility::occlusion::triangle_occlusion::covered;

    #[test]
    fn edge_functions_reject_no_covered_segment() {
        let soup = Soup {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            triangles: vec![[0, 1, 2]],
            ..Soup::default()
        };
        let view = View::new(&Mesh::build(soup), &Camera::three_quarter());
        let limits = ViewTolerances::new(&view.frame);
        let mut dice = Dice::new(11);
        let [mut told, mut left, mut covering] = [0; 3];
        // From triangles much smaller than the window to triangles with corners far outside it, near the
        // origin and away from it.
        for size in [1e-3, 0.1, 3.0, 100.0, 1e5] {
            for far in [0.0, 1e3, 1e7] {
                let window = Window { middle: DVec2::new(far, -far), reach: 2.0 };
                let centre = window.middle.extend(0.0);
                for round in 0..2000 {
                    let near = centre + dice.point(2.0);
                    let corners = [0; 3].map(|_| near + dice.point(size));
                    // Random points, or points along a side, where rounding matters.
                    let anywhere = [0; 2].map(|_| (centre + dice.point(2.0)).truncate());
                    let along = [0.2, 0.7].map(|t| corners[0].lerp(corners[1], t).truncate());
                    let [p, q] = if round % 2 == 0 { anywhere } else { along };
                    let Some([a, b]) = window.both([p, q]) else { continue };
                    let beyond = EdgeFunctions::new(&corners, &window, &limits).are_outside_a_side(a, b);
                    let covers = covered(p, q, &corners, &limits).is_some();
                    assert!(!(beyond && covers), "{size} {far}: {p} {q} {corners:?}");
                    told += u32::from(beyond);
                    left += u32::from(!beyond && !covers);
                    covering += u32::from(covers);
                }
            }
        }
        assert!(told > 5 * left && covering > 3000, "{told} told, {left} left, {covering} covered");
    }
}
