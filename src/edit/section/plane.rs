//! [`Plane`]: a plane in the world, and on which side of it a point lies, by exact sign.

use glam::{DVec2, DVec3};
use robust::{Coord3D, orient3d};

/// A plane in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    origin: DVec3,
    /// Unit vectors at right angles in the plane, and its normal.
    axes: [DVec3; 3],
}

impl Plane {
    /// The plane through a point, across a normal of any length; `None` where that is no direction. What lies where the normal points
    /// is in front of the plane.
    #[must_use]
    pub fn new(point: DVec3, normal: DVec3) -> Option<Self> {
        let normal = normal.try_normalize().filter(|_| point.is_finite())?;
        // A plane and the same plane turned round have the same three points, so that they part space alike.
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

    /// A point of the plane, world.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.origin
    }

    /// Its unit normal, world.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.axes[2]
    }

    /// The same plane seen from its other side.
    #[must_use]
    pub fn turned(&self) -> Self {
        let [u, v, normal] = self.axes;
        Self { origin: self.origin, axes: [v, u, -normal] }
    }

    /// On which side a point lies: 1 in front, -1 behind, 0 on the plane through the origin and the two points that are a unit from it
    /// along the axes.
    #[must_use]
    pub fn side(&self, p: DVec3) -> i8 {
        let [u, v, _] = self.axes;
        let coord = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
        let o = self.origin;
        // The predicate is positive below the triangle.
        let below = orient3d(coord(o), coord(o + u), coord(o + v), coord(p));
        i8::from(below < 0.0) - i8::from(below > 0.0)
    }

    /// How far in front of the plane a point lies, rounded.
    #[must_use]
    pub fn distance(&self, p: DVec3) -> f64 {
        (p - self.origin).dot(self.axes[2])
    }

    /// The point of the plane that is nearest to one next to it.
    pub(crate) fn nearest(&self, p: DVec3) -> DVec3 {
        p - self.axes[2] * self.distance(p)
    }

    /// Where a point lies along the axes of the plane.
    #[must_use]
    pub fn flat(&self, p: DVec3) -> DVec2 {
        let p = p - self.origin;
        DVec2::new(p.dot(self.axes[0]), p.dot(self.axes[1]))
    }

    /// The point of the plane that lies so along its axes, world.
    #[must_use]
    pub fn raised(&self, p: DVec2) -> DVec3 {
        self.origin + self.axes[0] * p.x + self.axes[1] * p.y
    }

    /// Where the plane crosses the way between two points on different sides of it, and at which part of that.
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
    fn axes_turn_from_the_first_to_the_second_round_the_normal() {
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
    fn sides_are_told_to_the_last_bit() {
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
