//! [`Bounds`]: axis-parallel box.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::tolerances::PARAMETER_ROUNDING;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Axis-parallel box in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Bounds {
    /// Box of nothing, neutral for [`Self::union`].
    pub(crate) const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The box around some points.
    pub(crate) fn of(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with)
    }

    /// The box around many points.
    pub(crate) fn of_many(points: &[DVec3]) -> Self {
        let parts = points.par_iter().with_min_len(MIN_TASK_ITEMS);
        parts.fold(|| Self::EMPTY, |around, point| around.with(*point)).reduce(|| Self::EMPTY, Self::union)
    }

    /// The box around a box and a point.
    #[inline]
    pub(crate) fn with(self, point: DVec3) -> Self {
        Self { low: self.low.min(point), high: self.high.max(point) }
    }

    /// The box around two boxes.
    #[inline]
    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The box with its sides moved outward.
    pub(crate) fn grown(self, by: f64) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    /// Whether the box holds no point.
    pub(crate) fn is_empty(&self) -> bool {
        self.low.x > self.high.x
    }

    /// Length of each side.
    pub(crate) fn size(&self) -> DVec3 {
        self.high - self.low
    }

    /// Length of the diagonal.
    pub(crate) fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// The middle of the box.
    pub(crate) fn middle(&self) -> DVec3 {
        (self.low + self.high) / 2.0
    }

    /// Absolute value of the largest coordinate.
    pub(crate) fn largest_coordinate(&self) -> f64 {
        self.low.abs().max(self.high.abs()).max_element()
    }

    /// Whether two boxes have a common point.
    #[inline]
    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    /// Whether another box lies in this one.
    pub(crate) fn contains(&self, other: &Self) -> bool {
        self.low.cmple(other.low).all() && self.high.cmpge(other.high).all()
    }

    /// Squared distance from a point.
    pub(crate) fn squared_distance(&self, point: DVec3) -> f64 {
        (point.clamp(self.low, self.high) - point).length_squared()
    }
}

/// Straight line from a point, with a search distance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SearchLine {
    start: DVec3,
    /// Inverse of the vector along each axis; infinite where that is zero.
    per_way: DVec3,
    /// Length in lengths of the vector.
    until: f64,
    reach: f64,
}

impl SearchLine {
    /// Line along a vector, `until` times as long. It finds all boxes within `reach` along each axis.
    pub(crate) fn new(start: DVec3, way: DVec3, until: f64, reach: f64) -> Self {
        Self { start, per_way: way.recip(), until, reach }
    }

    /// Whether the line comes within reach of a box along each axis. May rarely return true for a box out of
    /// reach.
    #[inline]
    pub(crate) fn meets(&self, around: &Bounds) -> bool {
        let (low, high) = (around.low - self.start - self.reach, around.high - self.start + self.reach);
        let (mut from, mut to) = (0.0f64, self.until);
        for axis in 0..3 {
            if self.per_way[axis].is_infinite() {
                if low[axis] > 0.0 || high[axis] < 0.0 {
                    return false;
                }
                continue;
            }
            let (a, b) = (low[axis] * self.per_way[axis], high[axis] * self.per_way[axis]);
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        from <= to + PARAMETER_ROUNDING
    }
}
