//! [`MotionOptions`]: which bodies leave motion lines, and how these are drawn: the `[motion]` table of a style sheet.

use std::fmt;

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::colour::srgb::Colour;
use crate::drawing::Length;
use crate::geometry::names::glob::Glob;
use crate::strokes::Ink;

/// More lines a body, or more segments a line, than this are a mistake.
const MOST: u32 = 1000;

/// Strokes that come over more frames than this never are there.
const MOST_FRAMES: u32 = 24;

/// Which bodies leave motion lines, and how these are drawn.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MotionOptions {
    /// Draw motion lines at all. Default: false.
    pub enabled: bool,
    /// How many lines a body leaves. Default: 7.
    #[serde(deserialize_with = "count")]
    pub lines: u32,
    /// How many segments long lines are. Default: 20.
    #[serde(deserialize_with = "count")]
    pub segments: u32,
    /// How many segments stand for a second. Default: 24.
    #[serde(deserialize_with = "rate")]
    pub rate: f64,
    /// Names of parts, nodes and joints that leave lines, with all that hangs on them. Default: none.
    #[serde(deserialize_with = "globs")]
    pub parts: Vec<Glob>,
    /// The speed above which bodies leave lines. Default: half the model's size a second if nothing else chooses them.
    pub speed: Option<Speed>,
    /// Whose way lines show. Default: vertex.
    pub path: Path,
    /// A line ends where the way ran elsewhere than now by more than this many degrees; 180 = nowhere. Default: 150.
    #[serde(deserialize_with = "angle")]
    pub turn: f64,
    /// Whether lines run over the body that leaves them, where they lie in front of it. Default: false.
    pub over: bool,
    /// Width of lines. Default: 1 px.
    pub width: Length,
    /// Colour of lines. Default: black.
    #[serde(alias = "color")]
    pub colour: Ink,
    /// How much of its width a line loses up to its far end: 0 = nothing, 1 = all. Default: 0.
    #[serde(deserialize_with = "part")]
    pub taper: f64,
    /// The lines of a body that differ, in their order. Default: none.
    pub line: Vec<LineChange>,
    /// Over how many frames strokes of an animation grow or fade that come or go. Default: 0.
    #[serde(deserialize_with = "frames")]
    pub fade: u32,
    /// What such strokes lack. Default: width.
    pub fade_by: FadeBy,
}

/// What strokes lack that come or go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FadeBy {
    /// They are thinner.
    #[default]
    Width,
    /// They are paler.
    Opacity,
}

impl Default for MotionOptions {
    fn default() -> Self {
        Self {
            enabled: false,
            lines: 7,
            segments: 20,
            rate: 24.0,
            parts: Vec::new(),
            speed: None,
            path: Path::default(),
            turn: 150.0,
            over: false,
            width: Length::px(1.0),
            colour: Ink::Fixed(Colour::BLACK),
            taper: 0.0,
            line: Vec::new(),
            fade: 0,
            fade_by: FadeBy::default(),
        }
    }
}

/// Whose way lines show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Path {
    /// Each line that of the vertex it begins at: arcs behind what turns.
    #[default]
    Vertex,
    /// All lines that of the body's middle, moved to their vertices: how it went, not how it turned.
    Body,
}

/// A speed: above it bodies leave lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Speed {
    /// In model units a second. Written as a number.
    Model(f64),
    /// On the page, a second. Written as a string with a unit: `"200px"`.
    Page(Length),
}

/// How one line of a body differs from the others.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LineChange {
    /// Of which parts or joints, by name; all if it is left out.
    pub part: Option<Glob>,
    /// The vertex it begins at, by its number in the part.
    pub start: Option<u32>,
    /// How many segments long it is.
    #[serde(deserialize_with = "some_count")]
    pub length: Option<u32>,
    /// Its width.
    pub width: Option<Length>,
    /// Its colour.
    #[serde(alias = "color")]
    pub colour: Option<Ink>,
    /// Whether it is drawn; it is if this is left out.
    pub visible: Option<bool>,
}

/// A number of lines or segments.
fn count<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    let count = f64::deserialize(deserializer)?;
    if (1.0..=f64::from(MOST)).contains(&count) && count.fract() == 0.0 {
        Ok(count as u32)
    } else {
        Err(D::Error::custom(format!("{count} is not a count; write a whole number from 1 to {MOST}")))
    }
}

fn some_count<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    count(deserializer).map(Some)
}

/// A number of frames.
fn frames<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    let frames = f64::deserialize(deserializer)?;
    if (0.0..=f64::from(MOST_FRAMES)).contains(&frames) && frames.fract() == 0.0 {
        Ok(frames as u32)
    } else {
        Err(D::Error::custom(format!(
            "{frames} frames are not possible; write a whole number from 0 to {MOST_FRAMES}"
        )))
    }
}

/// So many a second.
fn rate<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let rate = f64::deserialize(deserializer)?;
    if (1e-3..=1e4).contains(&rate) {
        Ok(rate)
    } else {
        Err(D::Error::custom(format!(
            "{rate} segments per second are not possible; write a number from 0.001 to 10000"
        )))
    }
}

/// An angle of 0 to 180 degrees.
fn angle<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let degrees = f64::deserialize(deserializer)?;
    if (0.0..=180.0).contains(&degrees) {
        Ok(degrees)
    } else {
        Err(D::Error::custom(format!("{degrees} is not an angle; write degrees from 0 to 180")))
    }
}

/// A part of a whole.
fn part<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(crate::strokes::fraction::fraction(deserializer)?.unwrap_or_default())
}

/// One name or a list of them.
fn globs<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Glob>, D::Error> {
    struct Globs;

    impl<'de> Visitor<'de> for Globs {
        type Value = Vec<Glob>;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("the name of a part, or a list of names, such as [\"brick*\"]")
        }

        fn visit_str<E: Error>(self, name: &str) -> Result<Vec<Glob>, E> {
            Ok(vec![Glob::new(name)])
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut names: A) -> Result<Vec<Glob>, A::Error> {
            let mut globs = Vec::new();
            while let Some(name) = names.next_element::<String>()? {
                globs.push(Glob::new(name));
            }
            Ok(globs)
        }
    }

    deserializer.deserialize_any(Globs)
}

impl<'de> Deserialize<'de> for Speed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SpeedVisitor)
    }
}

/// Reads either form by what it meets, so that errors keep their place in the sheet.
struct SpeedVisitor;

impl Visitor<'_> for SpeedVisitor {
    type Value = Speed;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a speed: model units a second, or a string with a unit of the page, such as \"200px\"")
    }

    fn visit_i64<E: Error>(self, speed: i64) -> Result<Speed, E> {
        self.visit_f64(speed as f64)
    }

    fn visit_u64<E: Error>(self, speed: u64) -> Result<Speed, E> {
        self.visit_f64(speed as f64)
    }

    fn visit_f64<E: Error>(self, speed: f64) -> Result<Speed, E> {
        if speed.is_finite() && speed >= 0.0 {
            return Ok(Speed::Model(speed));
        }
        Err(E::custom(format!("{speed} is not a speed; write model units per second, at least 0")))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Speed, E> {
        let wrong = || {
            E::custom(format!(
                "`{text}` is not a speed; write model units a second, or a length of the page a second, such as \
                 \"200px\""
            ))
        };
        let length = Length::parse(text.trim().trim_end_matches("/s")).ok_or_else(wrong)?;
        if length.value < 0.0 {
            return Err(wrong());
        }
        Ok(Speed::Page(length))
    }
}
