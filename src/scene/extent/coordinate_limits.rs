//! Which coordinates can be drawn, and the box round points.

use crate::parallel::prelude::*;
use glam::DVec3;

/// Points handled at once by one thread.
const CHUNK: usize = 1 << 14;

/// Coordinates beyond this are refused like those that are not numbers: products of four of them
/// no longer fit into an `f64`.
pub const LARGEST: f64 = 1e60;

/// Whether all three coordinates are numbers not beyond [`LARGEST`].
#[inline]
#[must_use]
pub fn is_drawable(point: DVec3) -> bool {
    point.abs().cmple(DVec3::splat(LARGEST)).all()
}

/// How faces and lines left out for their coordinates are called in the warnings.
pub(crate) const NOT_DRAWABLE: &str =
    "faces or lines left out, with coordinates that are not numbers or too large";

/// Corners of the box round all finite points, or `None` if there are none.
#[must_use]
pub fn bounds(points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let of_chunk = |chunk: &[DVec3]| {
        let finite = chunk.iter().filter(|p| p.is_finite());
        finite.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)))
    };
    let (low, high) = points
        .par_chunks(CHUNK)
        .map(of_chunk)
        .reduce(|| (DVec3::INFINITY, DVec3::NEG_INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)));
    (low.is_finite() && high.is_finite()).then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbers_are_drawable() {
        assert!(is_drawable(DVec3::new(1e60, -1e60, 0.0)));
        for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e61] {
            assert!(!is_drawable(DVec3::new(0.0, bad, 0.0)));
        }
    }
}
