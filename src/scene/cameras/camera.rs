//! [`Camera`]: eye, direction of view, projection and frame.

use glam::DVec3;

use crate::error::Error;
use crate::scene::tolerances;

/// Default vertical field of view of a perspective camera, in degrees.
pub(crate) const DEFAULT_FOV_Y_DEG: f64 = 35.0;

/// Default width and height of a camera's frame, in px.
pub(crate) const DEFAULT_FRAME_PX: f64 = 1000.0;

/// Perspective or parallel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// View rays meet in the eye.
    Perspective {
        /// Vertical field of view, degrees, between 0 and 180.
        fov_y_deg: f64,
    },
    /// View rays are parallel.
    Orthographic {
        /// Height of the picture in world units.
        height: f64,
    },
}

/// A camera: eye, direction of view, projection and frame.
///
/// The optical axis passes through the centre of the frame. In the picture x points right and y down; pixels
/// are square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Eye point, world.
    pub eye: DVec3,
    /// A point on the optical axis, world.
    pub target: DVec3,
    /// Approximate up direction; need not be perpendicular to the axis.
    pub up: DVec3,
    /// Perspective or parallel.
    pub projection: Projection,
    /// Width of the frame in user units (px, or mm on a page).
    pub width: f64,
    /// Height of the frame in user units.
    pub height: f64,
    /// Depth of the near plane. Without it, a perspective view shows everything in front of the eye, and a
    /// parallel view everything.
    pub near: Option<f64>,
}

impl Camera {
    /// World directions of right, up and forward in the picture, as orthonormal vectors. `NaN` for a camera
    /// that [`Camera::validate`] rejects.
    #[must_use]
    pub fn axes(&self) -> [DVec3; 3] {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(self.up.normalize()).normalize();
        [right, right.cross(forward), forward]
    }

    /// Turns and moves the camera so that its axis passes through a point, at the same distance and in the same
    /// direction as before.
    #[must_use]
    pub fn look_at(self, target: DVec3) -> Self {
        Self { eye: target + (self.eye - self.target), target, ..self }
    }

    /// Changes the size of the frame, in user units; keeps the vertical field of view or the height.
    #[must_use]
    pub fn with_frame(self, width: f64, height: f64) -> Self {
        Self { width, height, ..self }
    }

    /// Changes the projection.
    #[must_use]
    pub fn with_projection(self, projection: Projection) -> Self {
        Self { projection, ..self }
    }

    /// Checks that the camera can take a picture.
    ///
    /// # Errors
    /// Names the wrong key of the camera record and the remedy, for example if a number is not finite, if the
    /// eye is equal to the target, or if up is along the optical axis. Also for a field of view not between 0
    /// and 180 degrees, and for sizes that are not positive.
    pub fn validate(&self) -> Result<(), Error> {
        for (key, point) in [("eye", self.eye), ("target", self.target), ("up", self.up)] {
            if !point.is_finite() {
                return Err(wrong(key, "a coordinate is not a finite number", "write three finite numbers"));
            }
        }
        let axis = self.target - self.eye;
        if axis == DVec3::ZERO {
            return Err(wrong(
                "target",
                "eye and target are the same point",
                "put the target in front of the eye",
            ));
        }
        if !axis.length().is_normal() {
            return Err(wrong(
                "target",
                "the distance between eye and target is too large or too small",
                "scale the model",
            ));
        }
        let up = self.up.try_normalize().unwrap_or(DVec3::ZERO);
        if axis.normalize().cross(up).length() < tolerances::MIN_UP_SINE {
            return Err(wrong(
                "up",
                "up is zero or parallel to the line from eye to target",
                "give a direction that is not parallel to it",
            ));
        }
        match self.projection {
            Projection::Perspective { fov_y_deg } if !(fov_y_deg > 0.0 && fov_y_deg < 180.0) => Err(wrong(
                "fov_y_deg",
                format!("a field of view of {fov_y_deg} degrees is not possible"),
                "give one between 0 and 180, such as 35",
            )),
            Projection::Orthographic { height } if !positive(height) => Err(wrong(
                "ortho_height",
                format!("a height of {height} is not possible"),
                "give the world units that the picture's height spans",
            )),
            Projection::Perspective { .. } if self.near.is_some_and(|near| !positive(near)) => {
                Err(wrong("near", "the near plane is not in front of the eye", "give a distance above 0"))
            }
            _ => self.validate_frame(),
        }
    }

    fn validate_frame(&self) -> Result<(), Error> {
        if self.near.is_some_and(|near| !near.is_finite()) {
            return Err(wrong("near", "the near plane is not at a finite depth", "give a distance or null"));
        }
        for (key, size) in [("width_px", self.width), ("height_px", self.height)] {
            if !positive(size) {
                return Err(wrong(key, format!("a size of {size} is not possible"), "give one above 0"));
            }
        }
        Ok(())
    }
}

/// Whether a number is a valid positive length.
fn positive(number: f64) -> bool {
    number.is_finite() && number > 0.0
}

fn wrong(key: &str, message: impl Into<String>, remedy: &str) -> Error {
    Error::new(message).at(format!("key {key}")).remedy(remedy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{NamedView, UpAxis};

    fn camera() -> Camera {
        Camera::named(NamedView::Iso, UpAxis::Z)
    }

    #[test]
    fn camera_axes_are_orthonormal_and_right_handed() {
        let [right, up, forward] = camera().axes();
        assert!((right.cross(up) + forward).length() < 1e-15);
        assert!(right.dot(up).abs() < 1e-15 && (right.length() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn validate_refuses_invalid_cameras() {
        let good = camera();
        assert_eq!(good.validate(), Ok(()));
        let perspective = |fov_y_deg| good.with_projection(Projection::Perspective { fov_y_deg });
        let orthographic = |height| good.with_projection(Projection::Orthographic { height });
        let bad = [
            ("target", Camera { target: good.eye, ..good }),
            ("eye", Camera { eye: DVec3::new(f64::NAN, 0.0, 0.0), ..good }),
            ("target", Camera { target: DVec3::splat(f64::INFINITY), ..good }),
            ("target", Camera { eye: DVec3::splat(-1e200), target: DVec3::splat(1e200), ..good }),
            ("up", Camera { up: DVec3::ZERO, ..good }),
            ("up", Camera { up: (good.target - good.eye) * 3.0, ..good }),
            ("up", Camera { up: good.eye - good.target, ..good }),
            ("fov_y_deg", perspective(0.0)),
            ("fov_y_deg", perspective(180.0)),
            ("fov_y_deg", perspective(f64::NAN)),
            ("ortho_height", orthographic(0.0)),
            ("ortho_height", orthographic(f64::INFINITY)),
            ("width_px", good.with_frame(0.0, 10.0)),
            ("height_px", good.with_frame(10.0, -1.0)),
            ("near", Camera { near: Some(0.0), ..perspective(35.0) }),
            ("near", Camera { near: Some(f64::NAN), ..good }),
        ];
        for (key, camera) in bad {
            let error = camera.validate().expect_err(key);
            assert_eq!(error.place, Some(format!("key {key}")), "{error}");
            assert!(error.remedy.is_some());
        }
    }
}
