//! [`Mm`]: a length on a page, where a bare number is in millimetres.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};

use crate::drawing::{Length, Unit};

/// A length on a page in mm: a number of mm, or a string with a unit (`"0.25in"`). May be negative.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub(crate) struct Mm(pub f64);

impl Mm {
    /// Parses `5`, `5mm`, `0.2in` or `12pt`.
    #[must_use]
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let bare = text.trim().ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let length = Length::parse(text)?;
        Some(Self(if bare { length.value } else { length.in_unit(Unit::Mm) }))
    }
}

impl<'de> Deserialize<'de> for Mm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MmVisitor)
    }
}

struct MmVisitor;

impl Visitor<'_> for MmVisitor {
    type Value = Mm;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a length: a number of mm or a string with a unit, such as \"0.25in\"")
    }

    fn visit_i64<E: Error>(self, mm: i64) -> Result<Mm, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_u64<E: Error>(self, mm: u64) -> Result<Mm, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_f64<E: Error>(self, mm: f64) -> Result<Mm, E> {
        if mm.is_finite() && mm.abs() <= MAX_LENGTH_MM {
            Ok(Mm(mm))
        } else {
            Err(E::custom(format!(
                "a length of {mm} mm is too large; at most {MAX_LENGTH_MM} mm are possible"
            )))
        }
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Mm, E> {
        let Mm(mm) = Mm::parse(text).ok_or_else(|| {
            E::custom(format!(
                "`{text}` is not a length; write a number of mm or a string with a unit, such as \"0.25in\""
            ))
        })?;
        self.visit_f64(mm)
    }
}

/// Largest length, mm; longer ones are typing errors.
const MAX_LENGTH_MM: f64 = 20_000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mm_parse_reads_plain_numbers_as_mm_and_converts_units() {
        let near = |text: &str, mm: f64| (Mm::parse(text).unwrap().0 - mm).abs() < 1e-9;
        assert!(near("5", 5.0) && near("5.", 5.0) && near("0.5in", 12.7) && near("-3mm", -3.0));
        assert_eq!(Mm::parse("5 ells"), None);
    }
}
