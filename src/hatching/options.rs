//! [`HatchOptions`]: coverage for each bin of light, and the layers that supply it. This is the `[hatching]`
//! table of a style sheet.

use serde::{Deserialize, Deserializer};

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Length};
use crate::geometry::names::glob::Glob;
use crate::geometry::numbers::checked_number::{checked, share};
use crate::strokes::Ink;

/// Options of hatching.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HatchOptions {
    /// Whether surfaces are hatched. Default: false.
    pub enabled: bool,
    /// Share of the paper that ink covers in each bin, darkest first. If its length differs from the number
    /// of bins, it is interpolated. Default: 0.6, 0.35, 0.15, 0.
    pub coverage: Vec<f64>,
    /// Separate coverage for some materials. The last match counts.
    pub materials: Vec<(Glob, Vec<f64>)>,
    /// Whether surfaces cast shadows on each other. Default: false.
    pub cast_shadows: bool,
    /// How many of the darkest bins are painted solid, as spot blacks. Default: 0.
    pub blacks: usize,
    /// Width of the paper-coloured lines between blacks of different surfaces, as a share of the ink width
    /// that they replace. 0: no such lines. Default: 0.7.
    pub parting: f64,
    /// Patches of light or shade with less area than a square of this side are merged into a neighbour.
    /// Default: 4 px.
    pub crumb: Length,
    /// Layers of hatching. When the first layer is at its densest, the next one adds the rest on top of it.
    pub layers: Vec<HatchLayer>,
}

impl Default for HatchOptions {
    fn default() -> Self {
        Self {
            enabled: false,
            coverage: vec![0.6, 0.35, 0.15, 0.0],
            materials: Vec::new(),
            cast_shadows: false,
            blacks: 0,
            parting: 0.7,
            crumb: Length::px(4.0),
            layers: Vec::new(),
        }
    }
}

/// Kind of marks in a layer of hatching.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum HatchKind {
    /// Parallel strokes.
    #[default]
    Lines,
    /// Dots of a half-tone screen, sized by tone.
    Dots,
    /// Dots of one size, denser where the tone is darker (Secord, Weighted Voronoi stippling, 2002).
    Stipple,
}

/// Direction of strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Direction {
    /// At one fixed angle on the page.
    #[default]
    Page,
    /// Along the principal curvature of the surface.
    Surface,
    /// From light to shade (Singh and Schaefer, Suggestive hatching, 2010).
    Light,
    /// Along the texture coordinates of the model.
    Uv,
    /// Along planes that cut the model. The strokes are fixed to the model when it turns.
    Object,
}

/// One layer of hatching: an entry of `[[hatching.layer]]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct HatchLayer {
    /// Kind of marks. Default: lines.
    pub kind: HatchKind,
    /// Direction of strokes. Default: page.
    pub direction: Direction,
    /// Angle from the direction, degrees, counter-clockwise. For `page` it is measured from the right.
    /// Default: 45.
    pub angle: f64,
    /// Greatest random difference of the angle between parts, degrees. Default: 0.
    pub turn_parts: f64,
    /// Distance of strokes where they are densest, or of dots from row to row. Default: 4 px, and for dots
    /// that of a screen of 60 lines per inch.
    #[serde(deserialize_with = "some_above_zero")]
    pub spacing: Option<Length>,
    /// Screen ruling of dots and lines, lines per inch; replaces `spacing`.
    #[serde(deserialize_with = "lines_per_inch")]
    pub lpi: Option<f64>,
    /// Width of a stroke, diameter of a stippled dot. Default: 1 px.
    #[serde(deserialize_with = "above_zero")]
    pub width: Length,
    /// Whether stroke width instead of stroke density follows the tone, as in line screens and engravings.
    /// Default: false.
    pub swell: bool,
    /// Whether swelling lines, dots and stippling follow the light continuously instead of bin by bin.
    /// Default: true.
    pub graded: bool,
    /// Colour, or a darker shade of the material. Default: `#1a1a1a`.
    #[serde(alias = "color")]
    pub colour: Ink,
    /// Opacity, 0 to 1. Default: 1.
    #[serde(deserialize_with = "share")]
    pub opacity: f64,
    /// Caps of strokes that do not taper. Default: butt.
    pub cap: Cap,
    /// Length of a stroke; 0 means unbroken. Default: 0.
    pub length: Length,
    /// Mean gap between consecutive strokes of one line. Default: 0.
    pub gap: Length,
    /// Random variation of stroke length and position, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub uneven: f64,
    /// Greatest offset of strokes from their line, as a share of the spacing. Default: 0.
    #[serde(deserialize_with = "share")]
    pub stray: f64,
    /// Greatest random turn of strokes, degrees. Default: 0.
    pub turn: f64,
    /// Greatest bow of the middle of a stroke. Default: 0.
    pub bow: Length,
    /// Amplitude of sideways tremor. Default: 0.
    pub tremor: Length,
    /// Variation of stroke width and opacity, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub pressure: f64,
    /// Share of the width that a stroke loses at its ends, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub taper: f64,
    /// How far strokes run over the border of the shaded area. Default: 0.
    pub overrun: Length,
    /// How far strokes stop short of the border. Default: 0.
    pub short: Length,
    /// Random variation of the ends at the border. Default: 0.
    pub ragged: Length,
    /// Shorter pieces are dropped. Default: 1 px.
    pub least: Length,
    /// Share of a stroke that paper tooth leaves white, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub grain: f64,
}

impl Default for HatchLayer {
    fn default() -> Self {
        Self {
            kind: HatchKind::Lines,
            direction: Direction::Page,
            angle: 45.0,
            turn_parts: 0.0,
            spacing: None,
            lpi: None,
            width: Length::px(1.0),
            swell: false,
            graded: true,
            colour: Ink::Fixed(Colour::rgb(0x1a, 0x1a, 0x1a)),
            opacity: 1.0,
            cap: Cap::Butt,
            length: Length::px(0.0),
            gap: Length::px(0.0),
            uneven: 0.0,
            stray: 0.0,
            turn: 0.0,
            bow: Length::px(0.0),
            tremor: Length::px(0.0),
            pressure: 0.0,
            taper: 0.0,
            overrun: Length::px(0.0),
            short: Length::px(0.0),
            ragged: Length::px(0.0),
            least: Length::px(1.0),
            grain: 0.0,
        }
    }
}

impl HatchLayer {
    /// Whether this layer needs light or directions sampled at a lattice of page points.
    #[must_use]
    pub(crate) fn samples(&self) -> bool {
        self.kind != HatchKind::Lines
            || self.swell
            || matches!(self.direction, Direction::Surface | Direction::Light)
    }

    /// Distance from line to line: the spacing, or that of the screen ruling.
    #[must_use]
    pub(crate) fn pitch(&self) -> Length {
        let screen = |lpi: f64| Length::mm(25.4 / lpi);
        let usual = if self.kind == HatchKind::Dots { screen(DEFAULT_SCREEN_LPI) } else { Length::px(4.0) };
        self.lpi.map(screen).or(self.spacing).unwrap_or(usual)
    }
}

fn above_zero<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Length, D::Error> {
    let length = Length::deserialize(deserializer)?;
    if length.value >= MIN_LENGTH {
        return Ok(length);
    }
    Err(serde::de::Error::custom("a distance or width of hatching must be at least 0.05"))
}

fn some_above_zero<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Length>, D::Error> {
    above_zero(deserializer).map(Some)
}

fn lines_per_inch<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let advice = "is not a number of lines per inch; write a number from 1 to 300";
    checked(deserializer, |lpi| (1.0..=300.0).contains(&lpi), advice).map(Some)
}

/// Default screen ruling, lines per inch, as used in printed comics.
const DEFAULT_SCREEN_LPI: f64 = 60.0;

/// Least length of hatching, in the unit of the length. Finer hatching would be invisible and very slow.
const MIN_LENGTH: f64 = 0.05;
