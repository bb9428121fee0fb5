//! [`Swell`]: variation of line width by ends, bends, light and depth: the table `[pen.swell]` of a style
//! sheet.
//!
//! Source: Lake, Marshall, Harris and Blackstein, Stylized rendering techniques for scalable real-time 3D
//! animation, 2000, section 4.3, where strokes are chosen by the turn to the next piece of the line. Here the
//! width follows the curvature.

use serde::Deserialize;

use crate::drawing::Length;
use crate::geometry::numbers::checked_number::some_fraction;

/// Variation of the width along a line. All effects are off by default and multiply.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Swell {
    /// Length of the taper at each open end. Shorter lines taper over their half. Default: 0.
    pub taper: Length,
    /// Share of the width left at a tapered end. Default: 0.2.
    pub taper_to: f64,
    /// Effect of bends, 0 to 1: thicker where the line bulges out of the shape, thinner where it bulges in.
    /// Default: 0.
    pub bend: f64,
    /// Bend radius where the effect is half. Default: 40 px.
    pub bend_radius: Length,
    /// Share of the width lost where the surface next to the line is fully lit, 0 to 1. Default: 0.
    pub lit: f64,
    /// Share of the width that the farthest lines lose, 0 to 1. The nearest lose none. Default: 0.
    pub near: f64,
    /// Share of the width lost where the surface behind touches the line, 0 to 1. In front of the background
    /// nothing is lost. Default: 0.
    pub gap: f64,
    /// Greatest random share of the width that a line loses, 0 to 1. It is constant along a line. Default: 0.
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
    pub(crate) fn is_on(&self) -> bool {
        self.taper.value > 0.0
            || [self.bend, self.lit, self.near, self.gap, self.chance].iter().any(|part| *part > 0.0)
    }

    /// Whether the width depends on samples next to the line.
    #[must_use]
    pub(crate) fn needs_side_samples(&self) -> bool {
        self.bend > 0.0 || self.lit > 0.0 || self.gap > 0.0
    }
}

/// Fields of a swell to be changed. Absent ones stay.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct SwellChange {
    /// Length of the tapered ends.
    pub taper: Option<Length>,
    /// Share of the width left at a tapered end.
    #[serde(deserialize_with = "some_fraction")]
    pub taper_to: Option<f64>,
    /// Effect of bends.
    #[serde(deserialize_with = "some_fraction")]
    pub bend: Option<f64>,
    /// Bend radius where the effect is half.
    pub bend_radius: Option<Length>,
    /// Share of the width lost in full light.
    #[serde(deserialize_with = "some_fraction")]
    pub lit: Option<f64>,
    /// Share of the width that the farthest lines lose.
    #[serde(deserialize_with = "some_fraction")]
    pub near: Option<f64>,
    /// Share of the width lost without a gap in depth.
    #[serde(deserialize_with = "some_fraction")]
    pub gap: Option<f64>,
    /// Greatest random loss of width.
    #[serde(deserialize_with = "some_fraction")]
    pub chance: Option<f64>,
}

impl SwellChange {
    /// Applies the present fields.
    pub(crate) fn apply(&self, swell: &mut Swell) {
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
