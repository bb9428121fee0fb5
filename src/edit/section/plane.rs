//! [`Plane`]: plane in world space with exact side tests.

use glam::{DVec2, DVec3};
use robust::{Coord3D, orient3d};

/// Plane in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    origin: DVec3,
    /// Two orthonormal vectors in the plane, and its normal.
    axes: [DVec3; 3],
}

impl Plane {
    /// Plane through a point with a normal of any length; `None` if the normal has no direction. The normal
    /// points to the front.
    #[must_use]
    pub fn new(point: DVec3, normal: DVec3) -> Option<Self> {
        let normal = normal.try_normalize().filter(|_| point.is_finite())?;
        // A plane and its reverse use the same three points, so both classify points consistently.
        let turned = normal.to_array().into_iter().find(|x| *x != 0.0).is_some_and(|x| x < 0.0);
        let towards = if turned { -normal } else { normal };
        let least = towards.abs().min_element();
        let across = if towards.x.abs() == least {
            DVec3::X
        } else if towards.y.abs() == least {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let u = towards.cross(across).normalize();
        let v = towards.cross(u).normalize();
        let axes = if turned { [v, u, normal] } else { [u, v, normal] };
        Some(Self { origin: point, axes })
    }

    /// A point of the plane, world space.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.origin
    }

    /// Unit normal, world space.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.axes[2]
    }

    /// The same plane with front and back exchanged.
    #[must_use]
    pub fn turned(&self) -> Self {
        let [u, v, normal] = self.axes;
        Self { origin: self.origin, axes: [v, u, -normal] }
    }

    /// Side of a point, by exact predicate: 1 in front, -1 behind, 0 on the plane. The plane is that of the
    /// origin and the points one unit along both axes.
    #[must_use]
    pub fn side(&self, p: DVec3) -> i8 {
        let [u, v, _] = self.axes;
        let coord = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
        let o = self.origin;
        // The predicate is positive below the triangle.
        let below = orient3d(coord(o), coord(o + u), coord(o + v), coord(p));
        i8::from(below < 0.0) - i8::from(below > 0.0)
    }

    /// Signed distance of a point, rounded; positive in front.
    #[must_use]
    pub fn distance(&self, p: DVec3) -> f64 {
        (p - self.origin).dot(self.axes[2])
    }

    /// Projection of a point onto the plane.
    pub(crate) fn nearest(&self, p: DVec3) -> DVec3 {
        p - self.axes[2] * self.distance(p)
    }

    /// Coordinates of a point along the axes of the plane.
    #[must_use]
    pub fn flat(&self, p: DVec3) -> DVec2 {
        let p = p - self.origin;
        DVec2::new(p.dot(self.axes[0]), p.dot(self.axes[1]))
    }

    /// World position of a point with coordinates along the axes of the plane.
    #[must_use]
    pub fn raised(&self, p: DVec2) -> DVec3 {
        self.origin + self.axes[0] * p.x + self.axes[1] * p.y
    }

    /// Intersection with the segment between two points on different sides, and its parameter from `a`.
    pub(crate) fn crossing(&self, a: DVec3, b: DVec3) -> (DVec3, f64) {
        let (from, to) = (self.distance(a), self.distance(b));
        let t = from / (from - to);
        let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.5 };
        let p = a + (b - a) * t;
        (p - self.axes[2] * self.distance(p), t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_axes_are_right_handed_around_the_normal() {
        for normal in [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::new(-1.0, 2.0, 0.5)] {
            let plane = Plane::new(DVec3::splat(3.0), normal).unwrap();
            for plane in [plane, plane.turned()] {
                let [u, v, n] = plane.axes;
                assert!((u.cross(v) - n).length() < 1e-15, "{normal}");
            }
            assert!((plane.normal() - normal.normalize()).length() < 1e-15);
        }
        assert_eq!(Plane::new(DVec3::ZERO, DVec3::ZERO), None);
    }

    #[test]
    fn plane_side_is_exact_to_the_last_bit() {
        let plane = Plane::new(DVec3::new(0.1, 7.0, -3.0), DVec3::X).unwrap();
        let beside = |x: f64| DVec3::new(x, 0.3, 12.7);
        assert_eq!(plane.side(beside(0.1)), 0);
        assert_eq!(plane.side(beside(0.1_f64.next_up())), 1);
        assert_eq!(plane.side(beside(0.1_f64.next_down())), -1);
        assert_eq!(plane.turned().side(beside(0.1_f64.next_up())), -1);
        let slanting = Plane::new(DVec3::ONE, DVec3::new(1.0, 2.0, 3.0)).unwrap();
        assert_eq!(slanting.side(DVec3::splat(2.0)), 1);
        assert!((slanting.distance(slanting.raised(DVec2::new(4.0, -2.0)))).abs() < 1e-14);
    }
}
