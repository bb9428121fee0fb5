//! [`ColourFactor`]: a multiplier for each channel of a colour.

use std::fmt;

use serde::de::value::SeqAccessDeserializer;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::srgb::Colour;

/// Multipliers of red, green and blue in sRGB.
///
/// Style sheets write one number for all three (0 to 2), a list of three numbers, or a colour whose channels
/// count from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ColourFactor(pub [f64; 3]);

impl ColourFactor {
    /// Multiplies every channel by 0: the result is black.
    pub(crate) const NONE: Self = Self([0.0; 3]);
    /// Leaves colours unchanged.
    pub(crate) const ALL: Self = Self([1.0; 3]);
}

impl From<Colour> for ColourFactor {
    fn from(colour: Colour) -> Self {
        Self(colour.channels())
    }
}

impl<'de> Deserialize<'de> for ColourFactor {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColourFactorVisitor)
    }
}

/// Accepts all three notations in one visitor, so that errors keep their position in the style sheet.
struct ColourFactorVisitor;

impl<'de> Visitor<'de> for ColourFactorVisitor {
    type Value = ColourFactor;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number from 0 to 2, three such numbers, or a colour such as \"#a09ab8\"")
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<ColourFactor, E> {
        self.visit_f64(number as f64)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<ColourFactor, E> {
        self.visit_f64(number as f64)
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<ColourFactor, E> {
        if (0.0..=2.0).contains(&number) {
            Ok(ColourFactor([number; 3]))
        } else {
            Err(E::custom(format!("{number} is not a colour factor; write a number from 0 to 2")))
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<ColourFactor, A::Error> {
        let list = Vec::<f64>::deserialize(SeqAccessDeserializer::new(list))?;
        let count = list.len();
        let numbers: [f64; 3] = list.try_into().map_err(|_| {
            A::Error::custom(format!("{count} numbers are not a factor of red, green and blue; write three"))
        })?;
        match numbers.iter().find(|number| !(0.0..=2.0).contains(*number)) {
            Some(number) => Err(A::Error::custom(format!(
                "{number} is not a factor of colours; write numbers from 0 to 2"
            ))),
            None => Ok(ColourFactor(numbers)),
        }
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<ColourFactor, E> {
        Colour::try_from(text.to_owned()).map(ColourFactor::from).map_err(E::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Deserialize)]
    struct Sheet {
        factor: ColourFactor,
    }

    #[test]
    fn colour_factor_parses_numbers_colours_and_lists() {
        let read = |text: &str| toml::from_str::<Sheet>(&format!("factor = {text}")).map(|s| s.factor);
        assert_eq!(read("0.5"), Ok(ColourFactor([0.5; 3])));
        assert_eq!(read("1"), Ok(ColourFactor::ALL));
        assert_eq!(read("\"#ff0000\""), Ok(ColourFactor([1.0, 0.0, 0.0])));
        assert_eq!(read("[0.7, 0.66, 0.78]"), Ok(ColourFactor([0.7, 0.66, 0.78])));
        for wrong in ["-1", "3", "nan", "\"red-ish\"", "[1]", "[1, 1, 3]", "[0, 0, 0, 0]"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
