//! Highlights: specular reflection of a light towards the eye.

use glam::DVec3;

use crate::geometry::numbers::portable_math::pow;

/// (n·h)^exponent, with h halfway between the light and the eye; 0 to 1.
///
/// Source: Blinn, Models of light reflection for computer synthesized pictures, 1977; for cartoons
/// as in Lake et al. 2000, section 3.2.
#[must_use]
pub(crate) fn blinn_phong(normal: DVec3, towards_light: DVec3, to_eye: DVec3, exponent: f64) -> f64 {
    let half = (towards_light + to_eye).normalize_or_zero();
    pow(normal.dot(half).clamp(0.0, 1.0), exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};

    #[test]
    fn blinn_phong_peaks_halfway_between_light_and_eye() {
        let towards = |angle: f64| DVec3::new(sin(angle), 0.0, cos(angle));
        let at = |angle: f64| blinn_phong(towards(angle), towards(0.8), towards(0.0), 20.0);
        assert!((at(0.4) - 1.0).abs() < 1e-12);
        assert!((at(0.1) - at(0.7)).abs() < 1e-12);
        assert!((at(0.1) - pow(cos(0.3), 20.0)).abs() < 1e-12);
        assert_eq!(blinn_phong(DVec3::Z, DVec3::NEG_Z, DVec3::Z, 5.0), 0.0);
    }
}
