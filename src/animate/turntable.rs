//! [`Turntable`]: a camera that moves round a model.

use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::numbers::portable_math::{cos, sin};
use crate::scene::cameras::framing::world_points;
use crate::scene::{Camera, Scene, UpAxis};

/// Turn round an upright axis in equal steps. The camera moves to its right, so the model turns clockwise as
/// seen from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turntable {
    /// Point on the axis, world.
    pub centre: DVec3,
    /// Unit vector upwards along the axis.
    pub axis: DVec3,
    /// Number of steps in a whole turn.
    pub steps: usize,
}

impl Turntable {
    /// A turn round the centre of a scene's bounding box.
    #[must_use]
    pub fn round(scene: &Scene, steps: usize) -> Self {
        let points = world_points(scene);
        let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let axis = match scene.up {
            UpAxis::Y => DVec3::Y,
            UpAxis::Z => DVec3::Z,
        };
        Self { centre: low / 2.0 + high / 2.0, axis, steps: steps.max(1) }
    }

    /// The rotation of the camera after a number of steps.
    #[must_use]
    pub fn turn(&self, step: usize) -> DAffine3 {
        // Whole turns return exactly to the start.
        let share = (step % self.steps) as f64 / self.steps as f64;
        let angle = std::f64::consts::TAU * share;
        let (sine, cosine, axis) = (sin(angle), cos(angle), self.axis);
        let turned = |v: DVec3| v * cosine + axis.cross(v) * sine + axis * axis.dot(v) * (1.0 - cosine);
        let turn = DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z));
        DAffine3::from_mat3_translation(turn, self.centre - turn * self.centre)
    }

    /// The camera after a number of steps.
    #[must_use]
    pub fn camera(&self, first: &Camera, step: usize) -> Camera {
        if step.is_multiple_of(self.steps) {
            return *first;
        }
        let turn = self.turn(step);
        Camera {
            eye: turn.transform_point3(first.eye),
            target: turn.transform_point3(first.target),
            up: turn.transform_vector3(first.up),
            ..*first
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::NamedView;

    #[test]
    fn turntable_quarter_turn_goes_from_front_to_right_view() {
        for up in [UpAxis::Y, UpAxis::Z] {
            let axis = if up == UpAxis::Y { DVec3::Y } else { DVec3::Z };
            let table = Turntable { centre: DVec3::ZERO, axis, steps: 4 };
            let [front, right] = [NamedView::Front, NamedView::Right].map(|view| Camera::named(view, up));
            let turned = table.camera(&front, 1);
            assert!((turned.eye - right.eye).length() < 1e-12, "{up:?}");
            assert!((turned.up - right.up).length() < 1e-12);
            assert_eq!(table.camera(&front, 4), front);
        }
    }
}
