//! Which coordinates can be drawn.

use glam::DVec3;

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
