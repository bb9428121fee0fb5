//! [`HatchOptions`]: how dense surfaces are hatched in each bin of light, and with what: the `[hatching]`
//! table of a style sheet.

use serde::{Deserialize, Deserializer};

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Length};
use crate::geometry::names::glob::Glob;
use crate::strokes::Ink;

/// How surfaces are hatched.
#[derive(Debug, Clone, PartialEq)]
pub struct HatchOptions {
    /// Whether they are at all. Default: false.
    pub enabled: bool,
    /// The part of the paper that ink covers in each bin, darkest first; spread over the bins if there are
    /// more or fewer. Default: 0.6, 0.35, 0.15, 0.
    pub coverage: Vec<f64>,
    /// Coverage of their own for some materials, in order.
    pub materials: Vec<(Glob, Vec<f64>)>,
    /// Whether surfaces cast shadows on each other. Default: false.
    pub cast_shadows: bool,
    /// How many of the darkest bins are painted solid: spot blacks. Default: 0.
    pub blacks: usize,
    /// Width of the lines in the colour of the paper that part blacks of different surfaces, in parts of the
    /// width of the ink that they replace; 0 = none. Default: 0.7.
    pub parting: f64,
    /// Patches of light and shade of less area than a square with this side go to a neighbour. Default:
    /// 4 px.
    pub crumb: Length,
    /// What the hatching is made of. Where the first layer is as dense as it gets, the next one takes the
    /// rest, across it.
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

/// What a layer of hatching is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Strokes side by side.
    #[default]
    Lines,
    /// Dots of a half-tone screen, sized by tone.
    Dots,
    /// Dots of one size, as dense as the tone is dark (Secord, Weighted Voronoi stippling, 2002).
    Stipple,
}

/// Which way strokes run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// At one angle on the page.
    #[default]
    Page,
    /// Along the principal curvature of the surface.
    Surface,
    /// From light to shade (Singh and Schaefer, Suggestive hatching, 2010).
    Light,
    /// Along the texture coordinates of the model.
    Uv,
    /// Along cuts through the model: fixed to it when it turns.
    Object,
}

/// One layer of hatching: an entry of `[[hatching.layer]]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HatchLayer {
    /// What it is made of. Default: lines.
    pub kind: Kind,
    /// Which way strokes run. Default: page.
    pub direction: Direction,
    /// Angle from the direction, degrees, counter-clockwise; for `page` from the right. Default: 45.
    pub angle: f64,
    /// By how much the angle differs between parts at most, degrees. Default: 0.
    pub turn_parts: f64,
    /// Distance of strokes where they are densest; of dots from row to row. Default: 4 px; of dots that of a
    /// screen of 60 lines an inch.
    #[serde(deserialize_with = "some_above_zero")]
    pub spacing: Option<Length>,
    /// Dots and lines as a screen of this many lines an inch, in place of `spacing`.
    #[serde(deserialize_with = "lines_per_inch")]
    pub lpi: Option<f64>,
    /// Width of a stroke, diameter of a stippled dot. Default: 1 px.
    #[serde(deserialize_with = "above_zero")]
    pub width: Length,
    /// Strokes as wide as the tone is dark, in place of more or fewer of them: line screens and
    /// engravings. Default: false.
    pub swell: bool,
    /// Whether swelling lines, dots and stippling follow the light evenly, in place of bin by bin. Default:
    /// true.
    pub graded: bool,
    /// Colour; also a darker shade of the material. Default: `#1a1a1a`.
    #[serde(alias = "color")]
    pub colour: Ink,
    /// 0 to 1. Default: 1.
    #[serde(deserialize_with = "share")]
    pub opacity: f64,
    /// Ends of strokes that do not taper. Default: butt.
    pub cap: Cap,
    /// Length of a stroke; 0: without break. Default: 0.
    pub length: Length,
    /// Between the end of a stroke and the next one on its line, on average. Default: 0.
    pub gap: Length,
    /// How much strokes differ in length and place, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub uneven: f64,
    /// How far strokes are from their line, as a part of the spacing. Default: 0.
    #[serde(deserialize_with = "share")]
    pub stray: f64,
    /// By how much strokes are turned at most, degrees. Default: 0.
    pub turn: f64,
    /// How far the middle of a stroke bends away from its ends at most. Default: 0.
    pub bow: Length,
    /// How far lines tremble to the side. Default: 0.
    pub tremor: Length,
    /// How much strokes differ in width and opacity, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub pressure: f64,
    /// How much of its width a stroke loses at its ends, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub taper: f64,
    /// How far strokes run over the border of what they shade. Default: 0.
    pub overrun: Length,
    /// How far they fall short of it. Default: 0.
    pub short: Length,
    /// How much their ends there differ. Default: 0.
    pub ragged: Length,
    /// Shorter pieces are left out. Default: 1 px.
    pub least: Length,
    /// How much of a stroke the paper's tooth leaves white, 0 to 1. Default: 0.
    #[serde(deserialize_with = "share")]
    pub grain: f64,
}

impl Default for HatchLayer {
    fn default() -> Self {
        Self {
            kind: Kind::Lines,
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
    /// Whether the page must be asked at the points of a lattice for this layer.
    #[must_use]
    pub fn samples(&self) -> bool {
        self.kind != Kind::Lines
            || self.swell
            || matches!(self.direction, Direction::Surface | Direction::Light)
    }

    /// Distance from line to line: the spacing, or that of the screen.
    #[must_use]
    pub fn pitch(&self) -> Length {
        let screen = |lpi: f64| Length::mm(25.4 / lpi);
        let usual = if self.kind == Kind::Dots { screen(USUAL_SCREEN) } else { Length::px(4.0) };
        self.lpi.map(screen).or(self.spacing).unwrap_or(usual)
    }
}

fn share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if (0.0..=1.0).contains(&value) {
        return Ok(value);
    }
    Err(serde::de::Error::custom(format!("{value} is not a share; write a number from 0 to 1")))
}

fn above_zero<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Length, D::Error> {
    let length = Length::deserialize(deserializer)?;
    if length.value >= LEAST_LENGTH {
        return Ok(length);
    }
    Err(serde::de::Error::custom("a distance or width of hatching must be at least 0.05"))
}

fn some_above_zero<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Length>, D::Error> {
    above_zero(deserializer).map(Some)
}

fn lines_per_inch<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if (1.0..=300.0).contains(&value) {
        return Ok(Some(value));
    }
    Err(serde::de::Error::custom(format!(
        "{value} is not a number of lines per inch; write a number from 1 to 300"
    )))
}

/// Lines an inch of the screens that comics are printed with.
const USUAL_SCREEN: f64 = 60.0;

/// Finer hatching than this cannot be seen, and would take for ever.
const LEAST_LENGTH: f64 = 0.05;
