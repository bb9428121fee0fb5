//! [`Values`]: lengths as dimensions write them.
//!
//! 1. A length is rounded to the precision of the input, a power of ten in units of the model. So a length of 53.975 that a file
//!    in single precision holds as 53.974998 is 53.975 again.
//! 2. It is converted from the unit of the model to the unit of the dimensions.
//! 3. It is rounded to the number of decimals. Ties go away from zero. A length that is not 0 keeps its first digit.
//! 4. Zeros at the end of the decimals are left out (ISO 129-1).

use toml::Spanned;

use super::length_precision::{Precision, power_of_ten};
use crate::error::Error;
use crate::page::page_source::Source;
use crate::page::sheet::keys::sheet_keys::SheetPage;

/// The units of length that a page file may name, with their millimetres.
const UNITS: [Unit; 5] = [
    Unit { name: "mm", mm: 1.0 },
    Unit { name: "cm", mm: 10.0 },
    Unit { name: "m", mm: 1000.0 },
    Unit { name: "in", mm: 25.4 },
    Unit { name: "ft", mm: 304.8 },
];

/// Most decimals by default, in millimetres and in other units.
const DECIMALS: [u8; 2] = [2, 3];

/// Most decimals that a page file may ask for.
const MAX_DECIMALS: u8 = 9;

/// Decimals that the smallest numbers have a digit in.
const ALL_DECIMALS: usize = 330;

/// A product of few factors in double precision is off by no more than this share. A value so near below a tie is one.
const TIE: f64 = 8.0 * f64::EPSILON;

/// Whole numbers from here on have no neighbours between them.
const WHOLE: f64 = 9_007_199_254_740_992.0;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Unit {
    pub name: &'static str,
    /// Millimetres in it.
    pub mm: f64,
}

impl Unit {
    /// The unit that a key names.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn read(told: &Spanned<String>, source: &Source) -> Result<Self, Error> {
        let found = UNITS.into_iter().find(|unit| unit.name == told.get_ref());
        found.ok_or_else(|| source.unknown(told, "unit", &UNITS.map(|unit| unit.name)))
    }
}

/// How a sheet writes lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Values {
    /// The unit of the model, and that of the dimensions.
    model: Unit,
    pub unit: Unit,
    decimals: u8,
    has_comma: bool,
}

impl Values {
    /// As the keys of a sheet have it; `is_gltf` if the model's own unit is the metre.
    ///
    /// # Errors
    /// If a unit is not known, or there are too many decimals.
    pub fn new(sheet: &SheetPage, is_gltf: bool, source: &Source) -> Result<Self, Error> {
        let [mm, _, metre, inch, foot] = UNITS;
        let model = match &sheet.unit {
            Some(told) => Unit::read(told, source)?,
            None if is_gltf => metre,
            None => mm,
        };
        let unit = match &sheet.dimension_unit {
            Some(told) => Unit::read(told, source)?,
            None if model == inch || model == foot => model,
            None => mm,
        };
        let decimals = match &sheet.decimals {
            None => DECIMALS[usize::from(unit != mm)],
            Some(told) => {
                u8::try_from(*told.get_ref()).ok().filter(|n| *n <= MAX_DECIMALS).ok_or_else(|| {
                    let advice = format!("write a whole number from 0 to {MAX_DECIMALS}");
                    source.fault(&told.span(), "this is not a number of decimals", &advice)
                })?
            }
        };
        Ok(Self { model, unit, decimals, has_comma: sheet.decimal_comma })
    }

    /// Millimetres in a unit of the model.
    pub fn unit_mm(&self) -> f64 {
        self.model.mm
    }

    /// A length in units of the model, as it is written.
    pub fn written(&self, length: f64, precision: Precision) -> String {
        let carried = precision.rounded(length.abs());
        let value = if self.model == self.unit { carried } else { carried * self.model.mm / self.unit.mm };
        let text = decimal(value, usize::from(self.decimals));
        if self.has_comma { text.replace('.', ",") } else { text }
    }
}

/// A number that is not negative, with at most so many decimals, or more where it would be 0.
fn decimal(value: f64, decimals: usize) -> String {
    let rounded = |decimals: usize| {
        let power = power_of_ten(decimals);
        let scaled = value * power * (1.0 + TIE);
        if scaled < WHOLE { (scaled + 0.5).floor() / power } else { value }
    };
    let mut decimals = decimals;
    while value > 0.0 && rounded(decimals) == 0.0 {
        decimals += 1;
    }
    if power_of_ten(decimals).is_infinite() {
        decimals = ALL_DECIMALS;
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
    fn ties_go_away_from_zero() {
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
            assert_eq!(decimal(value, decimals), wanted, "{value}");
        }
    }

    #[test]
    fn a_length_that_is_not_0_keeps_a_digit() {
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
            assert_eq!(decimal(value, decimals), wanted, "{value}");
        }
        for value in [1e-300, f64::MIN_POSITIVE, 5e-324] {
            assert!(decimal(value, 2).starts_with("0.0"));
        }
    }
}
