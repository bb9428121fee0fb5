//! [`Swell`]: how the width of a line follows its ends, its bends, the light and the depth: the table
//! `[pen.swell]` of a style sheet.
//!
//! Source: strokes chosen by the turn to the next piece of the line, Lake, Marshall, Harris and
//! Blackstein, Stylized rendering techniques for scalable real-time 3D animation, 2000, section 4.3; here
//! the width follows the curvature itself.

use serde::Deserialize;

use crate::drawing::Length;
use crate::strokes::fraction::fraction;

/// How the width of a line varies along it. All is off by default; what is on multiplies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swell {
    /// Length at each open end over which the width falls; shorter lines fall over their half. Default: 0.
    pub taper: Length,
    /// The part of the width that is left at a tapered end. Default: 0.2.
    pub taper_to: f64,
    /// By how much bends are thicker where the line bulges out of the shape and thinner where it bulges in, 0
    /// to 1. Default: 0.
    pub bend: f64,
    /// The radius of bends of half that effect. Default: 40 px.
    pub bend_radius: Length,
    /// The part of the width that is lost where the surface beside the line is fully lit, 0 to 1. Default: 0.
    pub lit: f64,
    /// The part of the width that the farthest lines lose, 0 to 1; the nearest lose none. Default: 0.
    pub near: f64,
    /// The part of the width that is lost where what lies behind the line touches it, 0 to 1; before background
    /// none is. Default: 0.
    pub gap: f64,
    /// The part of the width that a line loses by chance at most, 0 to 1: each its own part. Default: 0.
    pub chance: f64,
}

impl Default for Swell {
    fn default() -> Self {
        Self {
            taper: Length::px(0.0),
            taper_to: 0.2,
            bend: 0.0,
            bend_radius: Length::px(40.0),
            lit: 0.0,
            near: 0.0,
            gap: 0.0,
            chance: 0.0,
        }
    }
}

impl Swell {
    /// Whether the width varies at all.
    #[must_use]
    pub fn is_on(&self) -> bool {
        self.taper.value > 0.0
            || [self.bend, self.lit, self.near, self.gap, self.chance].iter().any(|part| *part > 0.0)
    }

    /// Whether the width follows anything that has to be asked beside the line.
    #[must_use]
    pub fn asks(&self) -> bool {
        self.bend > 0.0 || self.lit > 0.0 || self.gap > 0.0
    }
}

/// The fields of a swell that are to change; the others stay.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SwellChange {
    /// Length of the tapered ends.
    pub taper: Option<Length>,
    /// What is left at a tapered end.
    #[serde(deserialize_with = "fraction")]
    pub taper_to: Option<f64>,
    /// How much bends count.
    #[serde(deserialize_with = "fraction")]
    pub bend: Option<f64>,
    /// The radius of bends of half the effect.
    pub bend_radius: Option<Length>,
    /// What is lost in the light.
    #[serde(deserialize_with = "fraction")]
    pub lit: Option<f64>,
    /// What the farthest lines lose.
    #[serde(deserialize_with = "fraction")]
    pub near: Option<f64>,
    /// What is lost without a gap in depth.
    #[serde(deserialize_with = "fraction")]
    pub gap: Option<f64>,
    /// What is lost by chance at most.
    #[serde(deserialize_with = "fraction")]
    pub chance: Option<f64>,
}

impl SwellChange {
    /// Changes the fields that are named.
    pub fn apply(&self, swell: &mut Swell) {
        *swell = Swell {
            taper: self.taper.unwrap_or(swell.taper),
            taper_to: self.taper_to.unwrap_or(swell.taper_to),
            bend: self.bend.unwrap_or(swell.bend),
            bend_radius: self.bend_radius.unwrap_or(swell.bend_radius),
            lit: self.lit.unwrap_or(swell.lit),
            near: self.near.unwrap_or(swell.near),
            gap: self.gap.unwrap_or(swell.gap),
            chance: self.chance.unwrap_or(swell.chance),
        };
    }
}
