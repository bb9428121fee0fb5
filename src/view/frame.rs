//! [`Frame`]: the camera's axes and the projection from local space to the image.

use glam::{DVec2, DVec3, DVec4};

use crate::geometry::numbers::portable_math::tan;
use crate::mesh::tolerances::EDGE_ON_SINE;
use crate::scene::{Camera, Projection};

/// Camera relative to the origin of a mesh, ready to project.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Eye point.
    pub eye: DVec3,
    /// Unit vector to the right of the image.
    pub right: DVec3,
    /// Unit vector to the top of the image.
    pub up: DVec3,
    /// Unit vector along the optical axis, away from the eye.
    pub forward: DVec3,
    /// Whether the projection is a perspective: lines of sight meet in the eye.
    pub perspective: bool,
    /// User units per unit of tangent (perspective) or of world length (parallel).
    pub scale: f64,
    /// Width of the frame in user units.
    pub width: f64,
    /// Height of the frame in user units.
    pub height: f64,
    /// Depth of the near plane; `None` for no clipping.
    pub near: Option<f64>,
    /// Depth of the camera's target. Lengths that are constant all over the picture are measured there.
    pub focus: f64,
}

impl Frame {
    /// Frame of a camera, with the world point `origin` as zero.
    ///
    /// A camera whose eye is its target, or whose up vector is along its axis, gets some valid frame. The
    /// readers of camera records reject such cameras.
    #[must_use]
    pub fn new(camera: &Camera, origin: DVec3) -> Self {
        let forward = (camera.target - camera.eye).try_normalize().unwrap_or(DVec3::NEG_Z);
        let right =
            forward.cross(camera.up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        let up = right.cross(forward);
        let (perspective, scale) = match camera.projection {
            Projection::Perspective { fov_y_deg } => {
                (true, camera.height / 2.0 / tan(fov_y_deg.to_radians() / 2.0))
            }
            Projection::Orthographic { height } => (false, camera.height / height),
        };
        Self {
            eye: camera.eye - origin,
            right,
            up,
            forward,
            perspective,
            scale,
            width: camera.width,
            height: camera.height,
            near: camera.near,
            focus: camera.eye.distance(camera.target),
        }
    }

    /// One px of the tolerances: a thousandth of the longer side of the frame, user units.
    #[inline]
    #[must_use]
    pub fn px(&self) -> f64 {
        self.width.max(self.height) / 1000.0
    }

    /// World length of a px at a depth, measured across the line of sight.
    #[inline]
    #[must_use]
    pub fn px_at(&self, depth: f64) -> f64 {
        let px = self.px() / self.scale;
        if self.perspective { px * depth.abs() } else { px }
    }

    /// Distance from the eye along the optical axis, of a local point.
    #[inline]
    #[must_use]
    pub fn depth(&self, p: DVec3) -> f64 {
        (p - self.eye).dot(self.forward)
    }

    /// Local point in camera axes: right, up, depth.
    #[inline]
    #[must_use]
    pub fn camera_from_local(&self, p: DVec3) -> DVec3 {
        let d = p - self.eye;
        DVec3::new(d.dot(self.right), d.dot(self.up), d.dot(self.forward))
    }

    /// Image-space point of a point in camera axes. Its depth must not be nearer than the near plane.
    #[inline]
    #[must_use]
    pub fn image_from_camera(&self, c: DVec3) -> DVec3 {
        let (q, k) = if self.perspective { (1.0 / c.z, self.scale / c.z) } else { (-c.z, self.scale) };
        DVec3::new(self.width / 2.0 + k * c.x, self.height / 2.0 - k * c.y, q)
    }

    /// Image-space point of a local point; q is NaN where the near plane cuts it off.
    #[inline]
    #[must_use]
    pub fn image_from_local(&self, p: DVec3) -> DVec3 {
        let c = self.camera_from_local(p);
        match self.near {
            Some(near) if c.z < near => DVec3::new(0.0, 0.0, f64::NAN),
            _ => self.image_from_camera(c),
        }
    }

    /// Local point seen at a point of image space.
    #[inline]
    #[must_use]
    pub fn local_from_image(&self, p: DVec3) -> DVec3 {
        let depth = self.depth_of(p.z);
        let k = if self.perspective { depth / self.scale } else { 1.0 / self.scale };
        let (x, y) = ((p.x - self.width / 2.0) * k, (self.height / 2.0 - p.y) * k);
        self.eye + self.right * x + self.up * y + self.forward * depth
    }

    /// Unit vector from a local point to the eye.
    #[inline]
    #[must_use]
    pub fn to_eye(&self, p: DVec3) -> DVec3 {
        if self.perspective { (self.eye - p).normalize_or_zero() } else { -self.forward }
    }

    /// The eye in homogeneous coordinates, local space: a point with w = 1, or in a parallel view
    /// the direction towards it with w = 0.
    #[must_use]
    pub fn homogeneous_eye(&self) -> DVec4 {
        if self.perspective { self.eye.extend(1.0) } else { (-self.forward).extend(0.0) }
    }

    /// Depth of an image-space nearness.
    #[inline]
    #[must_use]
    pub fn depth_of(&self, q: f64) -> f64 {
        if self.perspective { 1.0 / q } else { -q }
    }

    /// Image-space nearness of a depth.
    #[inline]
    #[must_use]
    pub fn nearness_of(&self, depth: f64) -> f64 {
        if self.perspective { 1.0 / depth } else { -depth }
    }

    /// Difference in nearness, at nearness `q`, for a small difference in depth.
    #[inline]
    #[must_use]
    pub fn nearness_step(&self, q: f64, depth_step: f64) -> f64 {
        if self.perspective { depth_step * q * q } else { depth_step }
    }

    /// Difference in nearness, at nearness `q`, for a depth difference equal to a length across the line of
    /// sight. That length measures `length` user units in the image.
    #[inline]
    #[must_use]
    pub fn nearness_across(&self, q: f64, length: f64) -> f64 {
        if self.perspective { length / self.scale * q } else { length / self.scale }
    }

    /// Ratio between the distance of a point from a plane along the optical axis and its perpendicular
    /// distance.
    ///
    /// The plane is given by an image-space point on it and by the change of its nearness with x and y there.
    #[inline]
    #[must_use]
    pub fn steepness(&self, p: DVec3, slope: DVec2) -> f64 {
        let across = slope.length_squared() * self.scale * self.scale;
        if !self.perspective {
            return (1.0 + across).sqrt();
        }
        let centre = p.z - slope.dot(p.truncate() - DVec2::new(self.width, self.height) / 2.0);
        (across + centre * centre).sqrt() / p.z
    }

    /// World length of the longer side of the frame, at a depth.
    #[inline]
    #[must_use]
    pub fn side_at(&self, depth: f64) -> f64 {
        1000.0 * self.px_at(depth)
    }

    /// Depths that count as near and far in the picture: a range around the target as long as the frame's
    /// longer side.
    #[must_use]
    pub fn depths(&self) -> [f64; 2] {
        let half = self.side_at(self.focus) / 2.0;
        [self.focus - half, self.focus + half]
    }

    /// Point that the camera looks at, local space.
    #[must_use]
    pub fn target(&self) -> DVec3 {
        self.eye + self.forward * self.focus
    }

    /// Whether the triangle a, b, c turns its outside (counter-clockwise) to the eye.
    ///
    /// Edge-on faces, within [`EDGE_ON_SINE`], count as averted.
    #[inline]
    #[must_use]
    pub fn faces_eye(&self, a: DVec3, b: DVec3, c: DVec3) -> bool {
        let normal = (b - a).cross(c - a);
        let to_eye = if self.perspective { self.eye - a } else { -self.forward };
        let d = normal.dot(to_eye);
        let limit = EDGE_ON_SINE * EDGE_ON_SINE;
        d > 0.0 && d * d > limit * normal.length_squared() * to_eye.length_squared()
    }
}
