//! [`Hand`]: hand-drawn effects on a line: the table `[pen.hand]` of a style sheet.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::drawing::Length;

/// Random hand-drawn effects on a line, all off by default. `seed` in the style selects the random numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hand {
    /// Greatest sideways motion of a line. Its ends and corners stay. Default: 0.
    pub tremor: Length,
    /// Wavelength of that motion. Default: 60 px.
    pub tremor_length: Length,
    /// Greatest extension of open ends. With it, the pen is also lifted at corners. Default: 0.
    pub overshoot: Length,
    /// Mean distance between small gaps; 0 for none. Default: 0.
    pub breaks: Length,
    /// Length of a gap. Default: 3 px.
    pub break_gap: Length,
    /// Number of times each line is drawn, 1 to 8. Default: 1.
    pub passes: u8,
    /// Greatest drift of all passes except the first, including their ends. Default: 1 px.
    pub stray: Length,
}

impl Default for Hand {
    fn default() -> Self {
        Self {
            tremor: Length::px(0.0),
            tremor_length: Length::px(60.0),
            overshoot: Length::px(0.0),
            breaks: Length::px(0.0),
            break_gap: Length::px(3.0),
            passes: 1,
            stray: Length::px(1.0),
        }
    }
}

impl Hand {
    /// Whether it changes lines at all.
    #[must_use]
    pub(crate) fn is_on(&self) -> bool {
        self.passes > 1 || [self.tremor, self.overshoot, self.breaks].iter().any(|length| length.value > 0.0)
    }
}

/// Fields of a hand to be changed. Absent ones stay.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct HandChange {
    /// Sideways motion.
    pub tremor: Option<Length>,
    /// Wavelength of that motion.
    pub tremor_length: Option<Length>,
    /// Extension of open ends.
    pub overshoot: Option<Length>,
    /// Mean distance between gaps.
    pub breaks: Option<Length>,
    /// Length of a gap.
    pub break_gap: Option<Length>,
    /// Number of times each line is drawn.
    #[serde(deserialize_with = "passes")]
    pub passes: Option<u8>,
    /// Drift of further passes.
    pub stray: Option<Length>,
}

impl HandChange {
    /// Applies the present fields.
    pub(crate) fn apply(&self, hand: &mut Hand) {
        *hand = Hand {
            tremor: self.tremor.unwrap_or(hand.tremor),
            tremor_length: self.tremor_length.unwrap_or(hand.tremor_length),
            overshoot: self.overshoot.unwrap_or(hand.overshoot),
            breaks: self.breaks.unwrap_or(hand.breaks),
            break_gap: self.break_gap.unwrap_or(hand.break_gap),
            passes: self.passes.unwrap_or(hand.passes),
            stray: self.stray.unwrap_or(hand.stray),
        };
    }
}

/// Reads a number from 1 to 8.
fn passes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u8>, D::Error> {
    let value = i64::deserialize(deserializer)?;
    match u8::try_from(value) {
        Ok(passes @ 1..=8) => Ok(Some(passes)),
        _ => Err(D::Error::custom(format!("{value} is not a number of passes; write 1 to 8"))),
    }
}
