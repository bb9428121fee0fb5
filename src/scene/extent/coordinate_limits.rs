//! Limits of coordinates that can be drawn, and bounding boxes of points.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::space::bounds::Bounds;

/// Points per parallel task.
const POINTS_PER_TASK: usize = 1 << 14;

/// Maximum absolute coordinate. Products of four larger ones overflow an `f64`, so these are rejected like
/// NaN.
pub(crate) const MAX_COORDINATE: f64 = 1e60;

/// Whether all three coordinates are numbers up to [`MAX_COORDINATE`].
#[inline]
#[must_use]
pub(crate) fn is_drawable(point: DVec3) -> bool {
    point.abs().cmple(DVec3::splat(MAX_COORDINATE)).all()
}

/// Warning about faces and lines that are left out because of their coordinates.
pub(crate) const NOT_DRAWABLE_WARNING: &str =
    "faces or lines left out, with coordinates that are not numbers or too large";

/// Bounding box of all finite points, as lower and upper corner; `None` if there are none.
#[must_use]
pub(crate) fn bounds(points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let of_chunk = |chunk: &[DVec3]| Bounds::of(chunk.iter().copied().filter(|p| p.is_finite()));
    let chunks = points.par_chunks(POINTS_PER_TASK).map(of_chunk);
    let around = chunks.reduce(|| Bounds::EMPTY, Bounds::union);
    (!around.is_empty()).then_some((around.low, around.high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_drawable_refuses_non_finite_and_huge_coordinates() {
        assert!(is_drawable(DVec3::new(1e60, -1e60, 0.0)));
        for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e61] {
            assert!(!is_drawable(DVec3::new(0.0, bad, 0.0)));
        }
    }
}
