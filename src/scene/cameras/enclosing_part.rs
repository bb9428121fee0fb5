//! Finds the part that encloses a point, by its winding number. Used to warn about a camera inside the model.
//!
//! The winding number of a closed surface is 1 for points inside and 0 for points outside. It is the sum of
//! the solid angles of all triangles, divided by 4 π.

use crate::geometry::space::bounds::Bounds;
use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::numbers::portable_math::atan2;
use crate::scene::{Part, Scene};

/// Triangles per parallel task.
const TRIANGLES_PER_TASK: usize = 1 << 14;

impl Scene {
    /// First part that encloses a world point: the winding number of its triangles is closer to 1 than to 0.
    /// A room whose faces point inwards encloses nothing.
    ///
    /// Source: solid angles of triangles, Van Oosterom and Strackee, *The solid angle of a plane triangle*,
    /// 1983, equation 8. Open surfaces enclose a point partly (Jacobson and others, *Robust inside-outside
    /// segmentation using generalized winding numbers*, 2013).
    #[must_use]
    pub fn enclosing_part(&self, point: DVec3) -> Option<&Part> {
        self.parts.iter().find(|part| self.winding(part, point).is_some_and(|turns| turns > 0.5))
    }

    /// Winding number of a part around a point; `None` outside its bounding box.
    fn winding(&self, part: &Part, point: DVec3) -> Option<f64> {
        let geometry = self.geometry_of(part)?;
        let place = part.world_from_part.inverse().transform_point3(point);
        if !place.is_finite() {
            return None;
        }
        if !Bounds::of(geometry.positions.iter().copied()).meets(&Bounds::of([place])) {
            return None;
        }
        let solid_angle = |triangle: &[u32; 3]| {
            let corner = |vertex: u32| geometry.positions.get(vertex as usize).map(|p| *p - place);
            let [Some(a), Some(b), Some(c)] = triangle.map(corner) else { return 0.0 };
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let across = a.dot(b.cross(c));
            let along = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * atan2(across, along)
        };
        let of_chunk = |chunk: &[[u32; 3]]| chunk.iter().map(solid_angle).sum::<f64>();
        // Summed in order, so the result does not depend on the number of threads.
        let chunks: Vec<f64> = geometry.triangles.par_chunks(TRIANGLES_PER_TASK).map(of_chunk).collect();
        // Computed in local space, where a mirrored part has its stored orientation.
        Some(chunks.iter().sum::<f64>() / (4.0 * std::f64::consts::PI))
    }
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;

    fn tetrahedron(inwards: bool) -> Scene {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let faces = faces.map(|[a, b, c]| if inwards { [a, c, b] } else { [a, b, c] });
        Scene::from_triangles(corners, faces).unwrap()
    }

    #[test]
    fn enclosing_part_is_found_only_for_points_inside() {
        let scene = tetrahedron(false);
        assert!(scene.enclosing_part(DVec3::splat(0.2)).is_some());
        assert!(scene.enclosing_part(DVec3::splat(0.4)).is_none());
        assert!(scene.enclosing_part(DVec3::splat(2.0)).is_none());
        assert!(scene.enclosing_part(DVec3::NAN).is_none());
        assert!(tetrahedron(true).enclosing_part(DVec3::splat(0.2)).is_none());
    }

    #[test]
    fn enclosing_part_works_for_mirrored_parts() {
        let mut scene = tetrahedron(false);
        scene.parts[0].world_from_part = DAffine3::from_scale(DVec3::new(-1.0, 2.0, 1.0));
        assert!(scene.enclosing_part(DVec3::new(-0.2, 0.4, 0.2)).is_some());
        assert!(scene.enclosing_part(DVec3::new(0.2, 0.4, 0.2)).is_none());
        scene.parts[0].world_from_part = DAffine3::from_scale(DVec3::new(1.0, 1.0, 0.0));
        assert!(scene.enclosing_part(DVec3::splat(0.2)).is_none());
    }
}
