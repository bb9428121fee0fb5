//! Scan of the numbers of an attribute: their decimals and their range.

/// Numbers from this on are refused. A hundred million px are 26 km, more than any drawing needs.
const MAX_NUMBER: f64 = 1e8;

/// Result of a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct NumberScan {
    /// Largest number of decimals.
    pub decimals: u8,
    /// Byte offset of the first number that is too large.
    pub too_large: Option<usize>,
}

/// Scans the numbers in path data or another attribute.
pub(crate) fn scan(text: &str) -> NumberScan {
    let bytes = text.as_bytes();
    let mut found = NumberScan::default();
    let mut at = 0;
    let digits = |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let is = |at: usize, wanted: &[u8]| bytes.get(at).is_some_and(|b| wanted.contains(b));
    while let Some(skipped) = bytes[at..].iter().position(|b| b.is_ascii_digit() || *b == b'.') {
        let start = at + skipped;
        let point = digits(start);
        at = if is(point, b".") { digits(point + 1) } else { point };
        let mut decimals = at.saturating_sub(point + 1) as i64;
        // `em` and `ex` are units.
        let exponent_start = at + 1 + usize::from(is(at + 1, b"+-"));
        let has_exponent = is(at, b"eE") && is(exponent_start, b"0123456789");
        if has_exponent {
            let end = digits(exponent_start);
            let exponent = text[at + 1..end].parse::<f64>().unwrap_or(0.0);
            decimals = decimals.saturating_sub(exponent as i64).max(0);
            at = end;
        }
        found.decimals = found.decimals.max(u8::try_from(decimals).unwrap_or(u8::MAX));
        let may_be_large = found.too_large.is_none() && (has_exponent || at - start > 8);
        if may_be_large && text[start..at].parse::<f64>().is_ok_and(|number| number >= MAX_NUMBER) {
            found.too_large = Some(start);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::scan;

    #[test]
    fn scan_finds_decimals_and_too_large_numbers() {
        for (text, decimals) in [
            ("M1 2L3 4", 0),
            ("M1.5.25-3.125", 3),
            ("M12.50", 2),
            ("1.5e-3", 4),
            ("1.25e2", 0),
            ("12em", 0),
            ("", 0),
        ] {
            assert_eq!(scan(text).decimals, decimals, "{text}");
            assert_eq!(scan(text).too_large, None, "{text}");
        }
        for (text, place) in [("M1 1e30", 3), ("123456789", 0), ("0.5 1e9", 4), ("9e99999999999999999999", 0)]
        {
            assert_eq!(scan(text).too_large, Some(place), "{text}");
        }
        for text in ["0000000000000001", "12345678", "1.123456789012345", "0.000000001e9", "1e-99999999999"] {
            assert_eq!(scan(text).too_large, None, "{text}");
        }
    }
}
