//! Values of lengths as they are written, and the size of letters and arrows (ISO 129-1).

/// Height of values, and length of arrows, mm.
pub(super) const HIGH: f64 = 3.5;
pub(super) const ARROW: f64 = 3.0;

/// A length as it is written: whole, or with one or two decimals.
pub(super) fn value(mm: f64) -> String {
    let rounded = (mm * 100.0).round() / 100.0;
    format!("{}", rounded + 0.0)
}
