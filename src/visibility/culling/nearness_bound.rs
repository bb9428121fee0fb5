//! [`NearnessBound`]: a lower bound of the nearness of a triangle over the squares of a grid row.

use glam::{DVec2, DVec3};

use crate::view::Frame;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::{FaceTolerances, ViewTolerances};

/// Value of a square that nothing fills.
pub(crate) const UNCOVERED: f32 = f32::NEG_INFINITY;

/// Sets a value to the nearer of two.
#[inline]
pub(crate) fn raise(bound: &mut f32, candidate: f32) {
    // `f32::max` is slower, because it also checks for NaN.
    *bound = if candidate > *bound { candidate } else { *bound };
}

/// Difference in nearness that certainly hides: twice the touching tolerance at the nearest corner of the
/// triangle.
#[inline]
pub(crate) fn step(
    points: &[DVec3; 3],
    limits: &ViewTolerances,
    slack: &FaceTolerances,
    frame: &Frame,
) -> f64 {
    2.0 * limits.step(points[0].z.max(points[1].z).max(points[2].z), slack, false, frame)
}

/// Lower bound of the nearness of a triangle over the squares of a row: that of its farthest point over each.
///
/// In single precision, and below the exact value.
#[derive(Clone, Copy)]
pub(crate) struct NearnessBound {
    /// Change of the nearness with x and y, per user unit.
    slope: DVec2,
    /// Point of the image, with the bound for a square centred there.
    base: DVec3,
    /// Overall lower bound.
    minimum: f32,
}

/// Magnitude near which numbers of single precision overflow.
const MAX_MAGNITUDE: f64 = 1e37;

impl NearnessBound {
    /// Bound for a triangle over squares that meet it and have the half side `half`, lowered by `step`.
    ///
    /// The plane of a thin triangle is unreliable, so its farthest corner counts.
    #[inline]
    pub(crate) fn new(points: &[DVec3; 3], half: f64, step: f64, limits: &ViewTolerances) -> Self {
        let (u, v) = (points[1] - points[0], points[2] - points[0]);
        let area = u.truncate().perp_dot(v.truncate());
        let is_thin = area.abs() <= limits.height * u.truncate().length().max(v.truncate().length());
        let (low, high) =
            (points[0].z.min(points[1].z).min(points[2].z), points[0].z.max(points[1].z).max(points[2].z));
        let lower_bound = low - step;
        if is_thin {
            return Self::of_plane(
                DVec2::ZERO,
                points[0].truncate().extend(lower_bound),
                lower_bound,
                lower_bound.abs(),
            );
        }
        let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
        let spread = (slope.x.abs() + slope.y.abs()) * half;
        // Largest magnitude at the centre of a square that meets the triangle.
        let max_magnitude = low.abs().max(high.abs()) + 2.0 * spread + step;
        Self::of_plane(slope, points[0] - DVec3::Z * (spread + step), lower_bound, max_magnitude)
    }

    /// Bound for the plane through `base`, at least `lower_bound`.
    ///
    /// `max_magnitude` is an upper bound for the magnitude of every sum and partial sum to be evaluated.
    #[inline]
    fn of_plane(slope: DVec2, base: DVec3, lower_bound: f64, max_magnitude: f64) -> Self {
        if max_magnitude < MAX_MAGNITUDE {
            let margin =
                tolerances::NEARNESS_ROUNDING_SHARE * max_magnitude + tolerances::MIN_NEARNESS_MAGNITUDE;
            Self { slope, base: base - DVec3::Z * margin, minimum: (lower_bound - margin) as f32 }
        } else {
            Self { slope: DVec2::ZERO, base: DVec3::ZERO.with_z(f64::NEG_INFINITY), minimum: UNCOVERED }
        }
    }

    /// Bounds of `count` squares with side `side`, from the one with this centre on in x.
    #[inline]
    pub(crate) fn over(&self, centre: DVec2, side: f64, count: usize) -> impl Iterator<Item = f32> {
        let first = (self.base.z + self.slope.dot(centre - self.base.truncate())) as f32;
        let (along, lower_bound) = ((self.slope.x * side) as f32, self.minimum);
        (0..count as i32).map(move |k| {
            let z = first + along * k as f32;
            if z > lower_bound { z } else { lower_bound }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;

    #[test]
    fn nearness_bound_is_below_the_exact_value_at_any_scale() {
        let part = |n: u64, axis: u64| hash(axis, &[n]) as f64 / u64::MAX as f64 * 2.0 - 1.0;
        let mut apart = 0;
        for n in 0..4000 {
            let scale = 10.0_f64.powi((n % 90) as i32 - 45);
            let slope = DVec2::new(part(n, 0), part(n, 1)) * scale;
            let base = DVec3::new(part(n, 2), part(n, 3), part(n, 4) * scale);
            let lower_bound = (part(n, 5) - 1.0) * scale;
            let plane = NearnessBound::of_plane(slope, base, lower_bound, 8.0 * scale);
            let (centre, side) = (DVec2::new(part(n, 6), part(n, 7)), 0.01);
            for (k, found) in plane.over(centre, side, 100).enumerate() {
                let at = centre + DVec2::X * side * k as f64 - base.truncate();
                let exact = (base.z + slope.dot(at)).max(lower_bound);
                assert!(f64::from(found) < exact, "{n} {k}: {found} {exact}");
                apart += u32::from(f64::from(found) < exact - 1e-5 * scale);
            }
        }
        // The bound is loose only where numbers are too small or too large.
        assert!(apart < 400_000 / 4, "{apart}");
        let overflowing = NearnessBound::of_plane(DVec2::ZERO, DVec3::splat(1e300), 1e300, 1e300);
        assert_eq!(overflowing.over(DVec2::ZERO, 1.0, 3).collect::<Vec<_>>(), [UNCOVERED; 3]);
    }

    #[test]
    fn raise_keeps_the_nearer_bound() {
        let raised = |mut bound: f32, candidate: f32| {
            raise(&mut bound, candidate);
            bound
        };
        assert_eq!([raised(UNCOVERED, -2.0), raised(-2.0, -3.0), raised(-3.0, -2.0)], [-2.0; 3]);
        assert_eq!([raised(1.0, f32::NAN), raised(1.0, UNCOVERED)], [1.0; 2]);
    }
}
