//! The tables `[fills.highlight]` and `highlight` of `[[fills.material]]`.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::ramp_source::RampSource;
use crate::colour::srgb::Colour;
use crate::error;
use crate::geometry::numbers::checked_number::fraction;
use crate::light::tones::tone_options::{Highlight, HighlightChange, exponent, thresholds};

/// The table `[fills.highlight]`, also used as a change to another one.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct HighlightTable {
    enabled: Option<bool>,
    #[serde(deserialize_with = "some_thresholds")]
    thresholds: Option<Vec<f64>>,
    #[serde(deserialize_with = "some_exponent")]
    exponent: Option<f64>,
    #[serde(alias = "color")]
    colour: Option<Colour>,
    #[serde(deserialize_with = "some_fraction")]
    strength: Option<f64>,
    ramp: Option<RampSource>,
    material: Option<bool>,
    #[serde(deserialize_with = "some_near")]
    near: Option<f64>,
}

/// The highlights of a material: on, off, or a table of changes.
#[derive(Debug, Clone)]
pub(crate) enum HighlightRule {
    Enabled(bool),
    Table(HighlightTable),
}

impl<'de> Deserialize<'de> for HighlightRule {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RuleVisitor)
    }
}

/// Dispatches on the type of the value, which keeps the position of errors in the sheet.
struct RuleVisitor;

impl<'de> Visitor<'de> for RuleVisitor {
    type Value = HighlightRule;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("true, false, or a table such as { exponent = 60 }")
    }

    fn visit_bool<E: Error>(self, enabled: bool) -> Result<HighlightRule, E> {
        Ok(HighlightRule::Enabled(enabled))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<HighlightRule, A::Error> {
        let table = HighlightTable::deserialize(MapAccessDeserializer::new(map))?;
        match table.near {
            Some(_) => {
                Err(A::Error::custom("`near` is the same for all materials; write it in [fills.highlight]"))
            }
            None => Ok(HighlightRule::Table(table)),
        }
    }
}

impl HighlightTable {
    /// Reads the picture of the ramp.
    pub(crate) fn read_pictures(&mut self) -> Result<(), error::Error> {
        self.ramp.iter_mut().try_for_each(RampSource::read)
    }

    pub(crate) fn into_change(self) -> HighlightChange {
        HighlightChange {
            enabled: self.enabled,
            thresholds: self.thresholds,
            exponent: self.exponent,
            colour: self.colour,
            strength: self.strength,
            ramp: self.ramp.and_then(RampSource::into_strip),
            material: self.material,
        }
    }

    pub(crate) fn into_options(self) -> Highlight {
        let near = self.near.unwrap_or_default();
        let mut highlight = Highlight { near, ..Highlight::default() };
        highlight.change(self.into_change());
        highlight
    }
}

impl HighlightRule {
    /// Reads the picture of the ramp.
    pub(crate) fn read_pictures(&mut self) -> Result<(), error::Error> {
        match self {
            Self::Enabled(_) => Ok(()),
            Self::Table(table) => table.read_pictures(),
        }
    }

    /// Converts to a change. A table enables highlights unless it sets `enabled`.
    pub(crate) fn into_change(self) -> HighlightChange {
        match self {
            Self::Enabled(enabled) => {
                HighlightChange { enabled: Some(enabled), ..HighlightChange::default() }
            }
            Self::Table(table) => {
                let change = table.into_change();
                HighlightChange { enabled: change.enabled.or(Some(true)), ..change }
            }
        }
    }
}

fn some_thresholds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<f64>>, D::Error> {
    thresholds(deserializer).map(Some)
}

fn some_exponent<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    exponent(deserializer).map(Some)
}

fn some_fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    fraction(deserializer).map(Some)
}

/// Parses the distance of the camera and the lights, in sides of the frame.
fn some_near<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if value == 0.0 || (0.1..=1000.0).contains(&value) {
        return Ok(Some(value));
    }
    Err(serde::de::Error::custom(format!("{value} is not a distance; write 0, or a number from 0.1 to 1000")))
}
