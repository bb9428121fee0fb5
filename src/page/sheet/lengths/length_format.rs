//! [`LengthFormat`]: formats lengths for dimensions.
//!
//! 1. A length is rounded to the precision of the input, a power of ten in model units. For example,
//!    53.974998 in single precision becomes 53.975 again.
//! 2. It is converted from the unit of the model to the unit of the dimensions.
//! 3. It is rounded to the number of decimals, ties away from zero. A length above 0 keeps its first digit.
//! 4. Trailing zeros are removed (ISO 129-1).

use toml::Spanned;

use super::length_precision::{LengthPrecision, power_of_ten};
use crate::error::Error;
use crate::geometry::numbers::length_units::LENGTH_UNITS_MM;
use crate::page::page_source::PageSource;
use crate::page::sheet::keys::sheet_keys::SheetPage;
use crate::page::tolerances::TIE_ROUNDING_SHARE;

/// Default maximum of decimals, in millimetres and in other units.
const DEFAULT_MAX_DECIMALS: [u8; 2] = [2, 3];

/// Largest number of decimals in a page file.
const MAX_DECIMALS: u8 = 9;

/// Decimals that are enough for the smallest double.
const DOUBLE_DECIMALS: usize = 330;

/// Doubles are integers from here on (2^53).
const MAX_EXACT_INTEGER: f64 = 9_007_199_254_740_992.0;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LengthUnit {
    pub name: &'static str,
    /// Millimetres per unit.
    pub mm: f64,
}

impl LengthUnit {
    /// Parses the unit in a key.
    ///
    /// # Errors
    /// Returns an error if there is no such unit.
    pub(crate) fn read(told: &Spanned<String>, source: &PageSource) -> Result<Self, Error> {
        let found = Self::all().into_iter().find(|unit| unit.name == told.get_ref());
        found.ok_or_else(|| source.unknown(told, "unit", &Self::all().map(|unit| unit.name)))
    }

    /// The units that a page file may name: millimetres, centimetres, metres, inches and feet.
    fn all() -> [Self; 5] {
        LENGTH_UNITS_MM.map(|(name, mm)| Self { name, mm })
    }
}

/// The format of lengths on a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LengthFormat {
    /// Unit of the model, and unit of the dimensions.
    model: LengthUnit,
    pub unit: LengthUnit,
    decimals: u8,
    has_comma: bool,
}

impl LengthFormat {
    /// Reads the format from the keys of a sheet. `is_gltf` makes the metre the default unit of the model.
    ///
    /// # Errors
    /// Returns an error if a unit is unknown, or there are too many decimals.
    pub(crate) fn new(sheet: &SheetPage, is_gltf: bool, source: &PageSource) -> Result<Self, Error> {
        let [mm, _, metre, inch, foot] = LengthUnit::all();
        let model = match &sheet.unit {
            Some(told) => LengthUnit::read(told, source)?,
            None if is_gltf => metre,
            None => mm,
        };
        let unit = match &sheet.dimension_unit {
            Some(told) => LengthUnit::read(told, source)?,
            None if model == inch || model == foot => model,
            None => mm,
        };
        let decimals = match &sheet.decimals {
            None => DEFAULT_MAX_DECIMALS[usize::from(unit != mm)],
            Some(told) => {
                u8::try_from(*told.get_ref()).ok().filter(|n| *n <= MAX_DECIMALS).ok_or_else(|| {
                    let advice = format!("write a whole number from 0 to {MAX_DECIMALS}");
                    source.fault(&told.span(), "this is not a number of decimals", &advice)
                })?
            }
        };
        Ok(Self { model, unit, decimals, has_comma: sheet.decimal_comma })
    }

    /// Millimetres per model unit.
    pub(crate) fn unit_mm(&self) -> f64 {
        self.model.mm
    }

    /// Formats a length in model units.
    pub(crate) fn written(&self, length: f64, precision: LengthPrecision) -> String {
        let carried = precision.rounded(length.abs());
        let value = if self.model == self.unit { carried } else { carried * self.model.mm / self.unit.mm };
        let text = format_decimal(value, usize::from(self.decimals));
        if self.has_comma { text.replace('.', ",") } else { text }
    }
}

/// Formats a non-negative number with at most `decimals` decimals, or more if it would be written as 0.
fn format_decimal(value: f64, decimals: usize) -> String {
    let rounded = |decimals: usize| {
        let power = power_of_ten(decimals);
        let scaled = value * power * (1.0 + TIE_ROUNDING_SHARE);
        if scaled < MAX_EXACT_INTEGER { (scaled + 0.5).floor() / power } else { value }
    };
    let mut decimals = decimals;
    while value > 0.0 && rounded(decimals) == 0.0 {
        decimals += 1;
    }
    if power_of_ten(decimals).is_infinite() {
        decimals = DOUBLE_DECIMALS;
    }
    let text = format!("{:.decimals$}", rounded(decimals));
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn format_decimal_rounds_ties_away_from_zero() {
        for (value, decimals, wanted) in [
            (53.975, 2, "53.98"),
            (9.525, 2, "9.53"),
            (20.125, 2, "20.13"),
            (1.005, 2, "1.01"),
            (1370.965, 2, "1370.97"),
            (53.975 * 25.4, 2, "1370.97"),
            (0.125, 2, "0.13"),
            (2.5, 0, "3"),
            (3.5, 0, "4"),
            (53.974_9, 2, "53.97"),
            (120.0, 2, "120"),
            (120.0, 0, "120"),
            (1e20, 2, "100000000000000000000"),
            (0.1 + 0.2, 9, "0.3"),
        ] {
            assert_eq!(format_decimal(value, decimals), wanted, "{value}");
        }
    }

    #[test]
    fn format_decimal_keeps_a_digit_of_nonzero_lengths() {
        for (value, decimals, wanted) in [
            (0.004, 2, "0.004"),
            (0.004_6, 2, "0.005"),
            (0.04, 0, "0.04"),
            (0.4, 0, "0.4"),
            (0.5, 0, "1"),
            (0.000_095, 2, "0.0001"),
            (0.0, 2, "0"),
            (0.0, 0, "0"),
        ] {
            assert_eq!(format_decimal(value, decimals), wanted, "{value}");
        }
        for value in [1e-300, f64::MIN_POSITIVE, 5e-324] {
            assert!(format_decimal(value, 2).starts_with("0.0"));
        }
    }
}
