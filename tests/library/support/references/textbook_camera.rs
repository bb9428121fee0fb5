//! Reference for projection and clipping: a camera by the textbook formulas.

use glam::{DVec3, DVec4};
use kurbo::Point;
use ligne::scene::{Camera, Projection};

/// Position, axes and scale of a camera.
pub(crate) struct TextbookCamera {
    pub position: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
    pub perspective: bool,
    /// Px per unit of tangent (perspective), or per world unit (orthographic).
    pub scale: f64,
    width: f64,
    height: f64,
}

impl TextbookCamera {
    pub(crate) fn new(camera: &Camera) -> Self {
        let forward = (camera.target - camera.eye).normalize();
        let right = forward.cross(camera.up).normalize();
        let (perspective, scale) = match camera.projection {
            Projection::Perspective { fov_y_deg } => {
                (true, camera.height / (2.0 * libm::tan(fov_y_deg.to_radians() / 2.0)))
            }
            Projection::Orthographic { height } => (false, camera.height / height),
        };
        let up = right.cross(forward);
        let (width, height) = (camera.width, camera.height);
        Self { position: camera.eye, right, up, forward, perspective, scale, width, height }
    }

    /// Distance of a point along the viewing direction.
    pub(crate) fn depth(&self, p: DVec3) -> f64 {
        (p - self.position).dot(self.forward)
    }

    /// The image position of a world point.
    pub(crate) fn project(&self, p: DVec3) -> Point {
        let d = p - self.position;
        let k = self.scale / if self.perspective { d.dot(self.forward) } else { 1.0 };
        Point::new(self.width / 2.0 + k * d.dot(self.right), self.height / 2.0 - k * d.dot(self.up))
    }

    /// The images of the ends of world segments.
    pub(crate) fn project_segments(&self, segments: &[[DVec3; 2]]) -> Vec<[Point; 2]> {
        segments.iter().map(|s| s.map(|p| self.project(p))).collect()
    }

    /// The world point at an image position and a depth.
    pub(crate) fn unproject(&self, image: Point, depth: f64) -> DVec3 {
        let k = if self.perspective { depth } else { 1.0 } / self.scale;
        let (x, y) = (image.x - self.width / 2.0, self.height / 2.0 - image.y);
        self.position + self.right * (x * k) + self.up * (y * k) + self.forward * depth
    }

    /// The part of a world segment inside the frame and farther than the depth `near`, by clipping with up to
    /// five half-spaces.
    pub(crate) fn clip_segment(&self, a: DVec3, b: DVec3, near: Option<f64>) -> Option<[DVec3; 2]> {
        let (x, y) = (self.width / 2.0 / self.scale, self.height / 2.0 / self.scale);
        // Homogeneous camera coordinates (right, up, forward, 1); the dot product with a plane is positive
        // inside.
        let side = |d: DVec3, half: f64| match self.perspective {
            true => DVec4::new(d.x, d.y, half, 0.0),
            false => DVec4::new(d.x, d.y, 0.0, half),
        };
        let mut planes = vec![side(DVec3::X, x), side(-DVec3::X, x), side(DVec3::Y, y), side(-DVec3::Y, y)];
        planes.extend(near.map(|near| DVec4::new(0.0, 0.0, 1.0, -near)));
        let local = |p: DVec3| {
            let d = p - self.position;
            DVec4::new(d.dot(self.right), d.dot(self.up), d.dot(self.forward), 1.0)
        };
        let (start, end) = (local(a), local(b));
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for plane in planes {
            let (at_a, at_b) = (plane.dot(start), plane.dot(end));
            match (at_a < 0.0, at_b < 0.0) {
                (true, true) => return None,
                (true, false) => from = from.max(at_a / (at_a - at_b)),
                (false, true) => to = to.min(at_a / (at_a - at_b)),
                (false, false) => {}
            }
        }
        (from < to).then(|| [a.lerp(b, from), a.lerp(b, to)])
    }
}
