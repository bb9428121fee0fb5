//! [`Length`]: a length on the page, in px or mm.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Unit;

/// Millimetres per px (CSS: 96 px per inch).
pub(crate) const MM_PER_PX: f64 = 25.4 / 96.0;

/// A length on the page, at least 0 in style sheets: a number of px, or a string with a unit (`"0.35mm"`).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Length {
    /// The number.
    pub value: f64,
    /// Its unit.
    pub unit: Unit,
}

impl Length {
    /// A length in px.
    #[must_use]
    pub const fn px(value: f64) -> Self {
        Self { value, unit: Unit::Px }
    }

    /// A length in millimetres.
    #[must_use]
    pub const fn mm(value: f64) -> Self {
        Self { value, unit: Unit::Mm }
    }

    /// The length in user units of a drawing with the given unit.
    #[must_use]
    pub fn in_unit(self, unit: Unit) -> f64 {
        match (self.unit, unit) {
            (Unit::Px, Unit::Px) | (Unit::Mm, Unit::Mm) => self.value,
            (Unit::Px, Unit::Mm) => self.value * MM_PER_PX,
            (Unit::Mm, Unit::Px) => self.value / MM_PER_PX,
        }
    }

    /// Parses `1.5`, `1.5px`, `0.35mm`, `1cm`, `0.1in` or `1pt`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let split =
            text.find(|c: char| c.is_ascii_alphabetic() && c != 'e' && c != 'E').unwrap_or(text.len());
        let (number, unit) = text.split_at(split);
        let value: f64 = number.trim().parse().ok().filter(|v: &f64| v.is_finite())?;
        match unit {
            "" | "px" => Some(Self::px(value)),
            "mm" => Some(Self::mm(value)),
            "cm" => Some(Self::mm(value * 10.0)),
            "in" => Some(Self::mm(value * 25.4)),
            "pt" => Some(Self::mm(value * 25.4 / 72.0)),
            _ => None,
        }
    }
}

impl Unit {
    /// Millimetres in the unit.
    pub(crate) const fn mm(self) -> f64 {
        match self {
            Self::Px => MM_PER_PX,
            Self::Mm => 1.0,
        }
    }
}

impl Serialize for Length {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.unit {
            Unit::Px => serializer.serialize_f64(self.value),
            Unit::Mm => serializer.serialize_str(&format!("{}mm", self.value)),
        }
    }
}

impl<'de> Deserialize<'de> for Length {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LengthVisitor)
    }
}

/// Dispatches on the type of the value, which keeps the position of errors in the file.
struct LengthVisitor;

impl Visitor<'_> for LengthVisitor {
    type Value = Length;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a length: a number of px or a string with a unit, such as \"0.35mm\"")
    }

    fn visit_i64<E: Error>(self, px: i64) -> Result<Length, E> {
        self.visit_f64(px as f64)
    }

    fn visit_u64<E: Error>(self, px: u64) -> Result<Length, E> {
        self.visit_f64(px as f64)
    }

    fn visit_f64<E: Error>(self, px: f64) -> Result<Length, E> {
        in_range(Length::px(px), &px.to_string())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Length, E> {
        let length = Length::parse(text).ok_or_else(|| {
            E::custom(format!(
                "`{text}` is not a length; write a number of px or a string with a unit, such as \"0.35mm\""
            ))
        })?;
        in_range(length, text)
    }
}

/// Returns the length if it is finite and not negative.
fn in_range<E: Error>(length: Length, text: &str) -> Result<Length, E> {
    if length.value.is_finite() && length.value >= 0.0 {
        Ok(length)
    } else {
        Err(E::custom(format!("`{text}` is not a length; it must be finite and at least 0")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn length_parses_text_and_converts_units() {
        assert_eq!(Length::parse("0.35mm"), Some(Length::mm(0.35)));
        assert_eq!(Length::parse(" 2 px "), Some(Length::px(2.0)));
        assert_eq!(Length::parse("1e1"), Some(Length::px(10.0)));
        assert_eq!(Length::parse("1in").map(|length| length.in_unit(Unit::Px).round()), Some(96.0));
        assert_eq!(Length::parse("mm"), None);
        assert_eq!(Length::parse("1 ell"), None);
        assert_eq!(Length::parse("inf"), None);
        assert!((Length::px(96.0).in_unit(Unit::Mm) - 25.4).abs() < 1e-12);
    }
}
