//! Powers of two around a number.
//!
//! As cell sizes they stay the same when the measured length changes slightly, and division by them is exact.

/// Greatest power of two that is at most `x`; 1 if there is none.
#[must_use]
pub(crate) fn power_of_two_below(x: f64) -> f64 {
    if x.is_normal() && x > 0.0 { f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000) } else { 1.0 }
}

/// Least power of two that is greater than `x`; 1 if there is none.
#[must_use]
pub(crate) fn power_of_two_above(x: f64) -> f64 {
    let above = 2.0 * power_of_two_below(x);
    if x.is_normal() && x > 0.0 && above.is_finite() { above } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_below_and_above_enclose_a_number() {
        for (x, below, above) in [(1.0, 1.0, 2.0), (0.3, 0.25, 0.5), (1000.0, 512.0, 1024.0)] {
            assert_eq!((power_of_two_below(x), power_of_two_above(x)), (below, above));
        }
        for x in [0.0, -3.0, f64::NAN, f64::INFINITY] {
            assert_eq!((power_of_two_below(x), power_of_two_above(x)), (1.0, 1.0));
        }
    }
}
