//! Sides of a plane that points and shapes are on, within a tolerance.

use glam::{DAffine3, DVec3};

use super::plane::Plane;
use crate::scene::Geometry;

/// Whether a shape has used vertices behind and in front of a plane.
pub(crate) fn sides_reached(
    geometry: &Geometry,
    place: &DAffine3,
    plane: &Plane,
    reach: f64,
) -> (bool, bool) {
    let (mut behind, mut before) = (false, false);
    for corner in geometry.triangles.as_flattened().iter().chain(geometry.wires.as_flattened()) {
        let Some(p) = geometry.positions.get(*corner as usize) else { continue };
        match side(plane, place.transform_point3(*p), reach) {
            1.. => before = true,
            0 => {}
            _ => behind = true,
        }
        if behind && before {
            break;
        }
    }
    (behind, before)
}

/// Whether a shape has triangles in the plane.
pub(crate) fn has_flat(geometry: &Geometry, place: &DAffine3, plane: &Plane, reach: f64) -> bool {
    let is_on = |v: &u32| {
        let p = geometry.positions.get(*v as usize);
        p.is_some_and(|p| side(plane, place.transform_point3(*p), reach) == 0)
    };
    geometry.triangles.iter().any(|triangle| triangle.iter().all(is_on))
}

/// Side of a point: 1 in front, -1 behind, 0 within `reach` of the plane.
pub(crate) fn side(plane: &Plane, p: DVec3, reach: f64) -> i8 {
    if plane.distance(p).abs() <= reach { 0 } else { plane.side(p) }
}
