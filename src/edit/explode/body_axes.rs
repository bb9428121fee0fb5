//! [`body_axes`]: directions along which a body may have been assembled.
//!
//! 1. The faces of a body are grouped by their normals.
//! 2. The three directions with the largest area are axes of the body. A box has exactly three.
//! 3. Directions perpendicular to two of these are axes as well. The axis of a tube or a nut is perpendicular
//!    to all its sides.

use glam::DVec3;

use super::bodies::Body;
use crate::edit::tolerances::MAX_PARALLEL_SINE;
use crate::geometry::space::triangles::area_vector;

/// Maximum number of face directions that are kept. The largest faces come first.
const MAX_PLANE_DIRECTIONS: usize = 64;

/// Maximum number of axes from face directions.
const MAX_FACE_AXES: usize = 3;

/// Whether two unit vectors are parallel or opposite.
pub(crate) fn is_parallel(a: DVec3, b: DVec3) -> bool {
    a.cross(b).length_squared() <= MAX_PARALLEL_SINE * MAX_PARALLEL_SINE
}

/// Axes of a body as unit vectors, those of the largest faces first.
pub(crate) fn body_axes(body: &Body) -> Vec<DVec3> {
    let normal = |corners: &[DVec3; 3]| area_vector(*corners);
    let mut normals: Vec<DVec3> = body.triangles.iter().map(normal).collect();
    normals.sort_by(|a, b| b.length_squared().total_cmp(&a.length_squared()));
    let mut planes: Vec<(DVec3, f64)> = Vec::new();
    for normal in normals {
        let Some(direction) = normal.try_normalize() else { continue };
        match planes.iter().position(|(plane_normal, _)| is_parallel(*plane_normal, direction)) {
            Some(index) => planes[index].1 += normal.length(),
            None if planes.len() < MAX_PLANE_DIRECTIONS => planes.push((upward(direction), normal.length())),
            None => {}
        }
    }
    planes.sort_by(|a, b| b.1.total_cmp(&a.1));
    planes.truncate(MAX_FACE_AXES);
    let mut axes: Vec<DVec3> = planes.iter().map(|(direction, _)| *direction).collect();
    for (k, (a, _)) in planes.iter().enumerate() {
        for (b, _) in &planes[..k] {
            let across = a.cross(*b).try_normalize().map(upward);
            if let Some(across) = across.filter(|across| !axes.iter().any(|axis| is_parallel(*axis, *across)))
            {
                axes.push(across);
            }
        }
    }
    axes
}

/// The one of two opposite directions whose largest coordinate is positive.
fn upward(direction: DVec3) -> DVec3 {
    let largest =
        direction.to_array().into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    if largest < 0.0 { -direction } else { direction }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};

    #[test]
    fn body_axes_include_the_axis_of_a_rotated_prism() {
        let turn = glam::DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
        for sides in [3, 4, 6, 24] {
            let at = |k: usize, z: f64| {
                let angle = std::f64::consts::TAU * k as f64 / sides as f64;
                turn * DVec3::new(cos(angle), sin(angle), z)
            };
            let side = |k: usize| [at(k, 0.0), at(k + 1, 0.0), at(k + 1, 5.0)];
            let body = Body { triangles: (0..sides).map(side).collect(), is_open: true };
            let axes = body_axes(&body);
            assert!(axes.iter().any(|axis| is_parallel(*axis, turn * DVec3::Z)), "{sides}: {axes:?}");
        }
    }
}
