//! Formats numbers for the text output of the program: counts, file sizes, lengths and coordinates.

use crate::cli::tolerances::MIN_DECIMAL_NUMBER;

/// Digits in groups of three: `69,451`.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A count with its noun and a plural s: `1 path`, `74 paths`.
pub(crate) fn counted(n: u64, noun: &str) -> String {
    format!("{} {noun}{}", grouped(n), if n == 1 { "" } else { "s" })
}

/// A file size in decimal units: `812 B`, `18.2 kB`, `1.4 MB`.
pub(crate) fn bytes(n: u64) -> String {
    match n {
        0..1_000 => format!("{n} B"),
        1_000..999_950 => format!("{:.1} kB", n as f64 / 1e3),
        _ => format!("{:.1} MB", n as f64 / 1e6),
    }
}

/// A length with at most `decimals` decimals, without trailing zeros.
pub(crate) fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A coordinate with about six significant digits.
pub(crate) fn short(value: f64) -> String {
    let large = value.abs() >= 1e9 || (value != 0.0 && value.abs() < MIN_DECIMAL_NUMBER);
    if large {
        return format!("{value:.5e}");
    }
    let before_point = if value.abs() < 1.0 { 0 } else { value.abs() as u64 }.to_string().len();
    plain(value, 7_usize.saturating_sub(before_point).min(6))
}

/// A small length with three significant digits: `0.0009`, `1.19e-7`.
pub(crate) fn three_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if rounded != 0.0 && rounded.abs() < MIN_DECIMAL_NUMBER {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn number_texts_have_digit_groups_plurals_and_units() {
        assert_eq!(
            [0, 999, 1_000, 69_451, 1_234_567].map(grouped),
            ["0", "999", "1,000", "69,451", "1,234,567"]
        );
        assert_eq!([1, 2].map(|n| counted(n, "path")), ["1 path", "2 paths"]);
        assert_eq!([999, 18_249, 999_949, 999_950].map(bytes), ["999 B", "18.2 kB", "999.9 kB", "1.0 MB"]);
        assert_eq!([210.0, 297.5, -0.0, 0.12345].map(|v| plain(v, 3)), ["210", "297.5", "0", "0.123"]);
        assert_eq!(plain(100.0, 0), "100");
    }

    #[test]
    fn short_and_three_digits_limit_significant_digits() {
        let numbers = [0.0, -1.5, 4_600_000.123, 1e-7, 3e9, 77.990_000_1, 0.25];
        let texts = ["0", "-1.5", "4600000", "1.00000e-7", "3.00000e9", "77.99", "0.25"];
        assert_eq!(numbers.map(short), texts);
        let numbers = [0.0, 1e-3, 9e-4, 1.192_092_9e-7, 9e-5, 0.062_5, 1234.0];
        let texts = ["0", "0.001", "0.0009", "1.19e-7", "9e-5", "0.0625", "1230"];
        assert_eq!(numbers.map(three_digits), texts);
    }
}
