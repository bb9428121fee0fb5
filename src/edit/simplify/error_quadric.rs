//! [`Quadric`]: the sum of squared distances from planes, as a quadratic function of a point.
//!
//! Source: M. Garland and P. S. Heckbert, *Surface simplification using quadric error metrics*, SIGGRAPH
//! 1997.

use glam::DVec3;

/// Weighted sum of squared distances from planes: `p·A·p + 2 b·p + c`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Quadric {
    /// Upper triangle of `A`: xx, xy, xz, yy, yz, zz.
    a: [f64; 6],
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// Squared distance from the plane through a point with a unit normal, times `weight`.
    #[inline]
    pub(crate) fn of_plane(normal: DVec3, through: DVec3, weight: f64) -> Self {
        let distance = -normal.dot(through);
        let scaled = normal * weight;
        let [x, y, z] = normal.to_array();
        Self {
            a: [scaled.x * x, scaled.x * y, scaled.x * z, scaled.y * y, scaled.y * z, scaled.z * z],
            b: scaled * distance,
            c: weight * distance * distance,
        }
    }

    /// Adds the planes of another quadric.
    #[inline]
    pub(crate) fn add(&mut self, other: &Self) {
        for (coefficient, addend) in self.a.iter_mut().zip(other.a) {
            *coefficient += addend;
        }
        self.b += other.b;
        self.c += other.c;
    }

    /// The same planes with all weights scaled.
    pub(crate) fn scaled(&self, by: f64) -> Self {
        Self { a: self.a.map(|a| a * by), b: self.b * by, c: self.c * by }
    }

    /// Total weight of the planes.
    pub(crate) fn weight(&self) -> f64 {
        let [xx, _, _, yy, _, zz] = self.a;
        xx + yy + zz
    }

    /// Value at a point, never negative.
    #[inline]
    pub(crate) fn at(&self, p: DVec3) -> f64 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let x = xx * p.x + 2.0 * (xy * p.y + xz * p.z + self.b.x);
        let y = yy * p.y + 2.0 * (yz * p.z + self.b.y);
        let z = zz * p.z + 2.0 * self.b.z;
        (x * p.x + y * p.y + z * p.z + self.c).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadric_is_the_weighted_squared_distance_from_planes() {
        let normal = DVec3::new(2.0, -1.0, 2.0) / 3.0;
        let mut sum = Quadric::of_plane(normal, DVec3::new(1.0, 2.0, 3.0), 2.0);
        sum.add(&Quadric::of_plane(DVec3::Z, DVec3::Z, 0.5));
        let p = DVec3::new(-4.0, 0.5, 7.0);
        let far = (p - DVec3::new(1.0, 2.0, 3.0)).dot(normal);
        assert!((sum.at(p) - (2.0 * far * far + 0.5 * 36.0)).abs() < 1e-12);
        assert!((sum.scaled(3.0).at(p) - 3.0 * sum.at(p)).abs() < 1e-11);
        assert!((sum.weight() - 2.5).abs() < 1e-12);
        assert!(sum.at(DVec3::new(1.0, 2.0, 1.0)) > 0.0);
        assert_eq!(Quadric::default().at(p), 0.0);
    }
}
