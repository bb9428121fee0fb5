//! Transcendental functions with the same last bit on every machine.
//!
//! The standard library's `sin` and similar functions call the C library of the platform, whose results
//! differ between machines. These call the portable `libm` instead, and `clippy.toml` forbids the others.
//! Square roots are exact everywhere and need no replacement.

/// Sine of an angle in radians.
#[must_use]
pub(crate) fn sin(radians: f64) -> f64 {
    libm::sin(radians)
}

/// Cosine of an angle in radians.
#[must_use]
pub(crate) fn cos(radians: f64) -> f64 {
    libm::cos(radians)
}

/// Tangent of an angle in radians.
#[must_use]
pub(crate) fn tan(radians: f64) -> f64 {
    libm::tan(radians)
}

/// Angle of the vector (x, y) from the x axis, in radians, −π to π.
#[must_use]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Angle in radians, 0 to π, whose cosine is `x` (clamped to −1..=1).
#[must_use]
pub(crate) fn acos(x: f64) -> f64 {
    libm::acos(x.clamp(-1.0, 1.0))
}

/// Cube root.
#[must_use]
pub(crate) fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// Natural logarithm.
#[must_use]
pub(crate) fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// e to the power `x`.
#[must_use]
pub(crate) fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// `base` to the power `exponent`.
#[must_use]
pub(crate) fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}
