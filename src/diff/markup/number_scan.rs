//! Scan of the numbers of an attribute: their decimals and their range, without parsing them.

/// Most digits before the point. Ten million px are 2.6 km, more than any drawing needs.
const MAX_INTEGER_DIGITS: i64 = 8;

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
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    while at < bytes.len() {
        if !(bytes[at].is_ascii_digit() || bytes[at] == b'.') {
            at += 1;
            continue;
        }
        let start = at;
        let zeros = bytes[at..].iter().take_while(|b| **b == b'0').count();
        let mut whole = (digits(at) - zeros) as i64;
        at += digits(at);
        let mut decimals = 0;
        if bytes.get(at) == Some(&b'.') {
            decimals = digits(at + 1) as i64;
            if whole == 0 {
                // Leading zeros of the fraction count against an exponent.
                whole = -(bytes[at + 1..].iter().take_while(|b| **b == b'0').count() as i64);
            }
            at += 1 + decimals as usize;
        }
        if let Some((exponent, length)) = exponent(&bytes[at..]) {
            at += length;
            whole = whole.saturating_add(exponent);
            decimals = decimals.saturating_sub(exponent).max(0);
        }
        found.decimals = found.decimals.max(u8::try_from(decimals).unwrap_or(u8::MAX));
        if whole > MAX_INTEGER_DIGITS && found.too_large.is_none() {
            found.too_large = Some(start);
        }
    }
    found
}

/// Value and length of the exponent that continues a number. `em` and `ex` are units.
fn exponent(bytes: &[u8]) -> Option<(i64, usize)> {
    if !matches!(bytes.first(), Some(b'e' | b'E')) {
        return None;
    }
    let signed = matches!(bytes.get(1), Some(b'+' | b'-'));
    let from = 1 + usize::from(signed);
    let count = bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    if count == 0 {
        return None;
    }
    let digits = bytes[from..from + count].iter();
    let value = digits.fold(0i64, |sum, b| sum.saturating_mul(10).saturating_add(i64::from(b - b'0')));
    let value = value.min(1_000_000);
    Some((if bytes[1] == b'-' { -value } else { value }, from + count))
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
