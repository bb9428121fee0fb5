//! [`Hand`]: how unsteady the hand is that draws a line: the table `[pen.hand]` of a style sheet.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::drawing::Length;

/// What chance does to a line. All is off by default; `seed` decides the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// How far a line strays to either side, at most; its ends and corners stay. Default: 0.
    pub tremor: Length,
    /// How long the waves are in which it does. Default: 60 px.
    pub tremor_length: Length,
    /// How far open ends run on, at most; lines are then also lifted at their corners. Default: 0.
    pub overshoot: Length,
    /// Mean distance of small gaps in a line; 0 = none. Default: 0.
    pub breaks: Length,
    /// Length of such a gap. Default: 3 px.
    pub break_gap: Length,
    /// How often each line is drawn, 1 to 8. Default: 1.
    pub passes: u8,
    /// How far all passes but the first stray, at most, their ends as well. Default: 1 px.
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
    /// Whether it does anything to lines.
    #[must_use]
    pub fn is_on(&self) -> bool {
        self.passes > 1 || [self.tremor, self.overshoot, self.breaks].iter().any(|length| length.value > 0.0)
    }
}

/// The fields of a hand that are to change; the others stay.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HandChange {
    /// How far a line strays.
    pub tremor: Option<Length>,
    /// How long the waves of that are.
    pub tremor_length: Option<Length>,
    /// How far open ends run on.
    pub overshoot: Option<Length>,
    /// Mean distance of gaps.
    pub breaks: Option<Length>,
    /// Length of a gap.
    pub break_gap: Option<Length>,
    /// How often each line is drawn.
    #[serde(deserialize_with = "passes")]
    pub passes: Option<u8>,
    /// How far further passes stray.
    pub stray: Option<Length>,
}

impl HandChange {
    /// Changes the fields that are named.
    pub fn apply(&self, hand: &mut Hand) {
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

/// A number from 1 to 8.
fn passes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u8>, D::Error> {
    let value = i64::deserialize(deserializer)?;
    match u8::try_from(value) {
        Ok(passes @ 1..=8) => Ok(Some(passes)),
        _ => Err(D::Error::custom(format!("{value} is not a number of passes; write 1 to 8"))),
    }
}
