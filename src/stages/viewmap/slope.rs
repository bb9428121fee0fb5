//! [`Slope`]: how near a triangle is at least over the squares of a row of a grid.

use glam::{DVec2, DVec3};

use super::limits::{Limits, Slack};
use crate::view::Frame;

/// By how much farther than a triangle all is that it hides for sure: twice what counts as touching where it is nearest.
#[inline]
pub(super) fn step(points: &[DVec3; 3], limits: &Limits, slack: &Slack, frame: &Frame) -> f64 {
    2.0 * limits.step(points[0].z.max(points[1].z).max(points[2].z), slack, false, frame)
}

/// The nearness of a triangle over the squares of a row: that of its farthest point over each.
#[derive(Clone, Copy)]
pub(super) struct Slope {
    /// In x and y, user units.
    slope: DVec2,
    /// A point of the plane.
    base: DVec3,
    /// How much less it may be than at the centre of a square.
    spread: f64,
    /// That of the farthest corner.
    least: f64,
}

impl Slope {
    /// That of a triangle over squares, half of whose side is `half`; everything less by `step`. The plane of a thin triangle is not
    /// known well, and it counts as far as its farthest corner.
    #[inline]
    pub(super) fn new(points: &[DVec3; 3], half: f64, step: f64, limits: &Limits) -> Self {
        let (u, v) = (points[1] - points[0], points[2] - points[0]);
        let area = u.truncate().perp_dot(v.truncate());
        let is_thin = area.abs() <= limits.height * u.truncate().length().max(v.truncate().length());
        let least = points[0].z.min(points[1].z).min(points[2].z) - step;
        let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
        let (slope, base) =
            if is_thin { (DVec2::ZERO, points[0].truncate().extend(least)) } else { (slope, points[0]) };
        let spread = if is_thin { 0.0 } else { (slope.x.abs() + slope.y.abs()) * half + step };
        Self { slope, base, spread, least }
    }

    /// Over squares that begin at the one with this centre and follow each other in x, each as long as told.
    #[inline]
    pub(super) fn over(&self, centre: DVec2, side: f64) -> impl Iterator<Item = f64> {
        let first = self.base.z + self.slope.dot(centre - self.base.truncate()) - self.spread;
        let (along, least) = (self.slope.x * side, self.least);
        (0u32..).map(move |k| (first + along * f64::from(k)).max(least))
    }
}
