//! [`Length`]: a length on the page, in px or mm.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Unit;

/// Millimetres in a px: CSS's 96 px an inch.
pub const MM_PER_PX: f64 = 25.4 / 96.0;

/// A length on the page. Written as a number (px) or as a string with a unit (`"0.35mm"`).
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

    /// The length in user units of a drawing whose unit is `unit`.
    #[must_use]
    pub fn in_unit(self, unit: Unit) -> f64 {
        match (self.unit, unit) {
            (Unit::Px, Unit::Px) | (Unit::Mm, Unit::Mm) => self.value,
            (Unit::Px, Unit::Mm) => self.value * MM_PER_PX,
            (Unit::Mm, Unit::Px) => self.value / MM_PER_PX,
        }
    }

    /// Reads `1.5`, `1.5px`, `0.35mm`, `1cm`, `0.1in` or `1pt`.
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
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Integer(i64),
            Number(f64),
            Text(String),
        }
        let wrong = || {
            serde::de::Error::custom("a length is a number of px or a string with a unit, such as \"0.35mm\"")
        };
        match Written::deserialize(deserializer).map_err(|_| wrong())? {
            Written::Integer(px) => Ok(Self::px(px as f64)),
            Written::Number(px) => Ok(Self::px(px)),
            Written::Text(text) => Self::parse(&text).ok_or_else(wrong),
        }
    }
}
