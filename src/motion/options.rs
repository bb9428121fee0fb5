//! [`MotionOptions`]: which bodies leave motion lines and how these are drawn. This is the `[motion]` table
//! of a style sheet.

use std::fmt;

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::tolerances;
use crate::colour::srgb::Colour;
use crate::drawing::Length;
use crate::geometry::names::glob::Glob;
use crate::geometry::numbers::checked_number::{checked, fraction};
use crate::strokes::Ink;

/// Greatest number of lines per body, and of segments per line.
const MAX_COUNT: u32 = 1000;

/// Greatest length of a fade, frames. Longer fades would hide short-lived strokes.
const MAX_FADE_FRAMES: u32 = 24;

/// Which bodies leave motion lines, and how these are drawn.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct MotionOptions {
    /// Whether motion lines are drawn. Default: false.
    pub enabled: bool,
    /// Number of lines per body. Default: 7.
    #[serde(deserialize_with = "count")]
    pub lines: u32,
    /// Length of lines in segments. Default: 20.
    #[serde(deserialize_with = "count")]
    pub segments: u32,
    /// Segments per second. Default: 24.
    #[serde(deserialize_with = "rate")]
    pub rate: f64,
    /// Names of parts, nodes and joints that leave lines, together with their descendants. Default: none.
    #[serde(deserialize_with = "globs")]
    pub parts: Vec<Glob>,
    /// Speed above which bodies leave lines. Default: half the model's size per second, if nothing else
    /// selects bodies.
    pub speed: Option<Speed>,
    /// Motion that lines follow. Default: vertex.
    pub path: TrailPath,
    /// Greatest angle between a trail's directions now and earlier, degrees. Past it the line ends; 180 means
    /// never. Default: 150.
    #[serde(deserialize_with = "angle")]
    pub turn: f64,
    /// Whether lines run over the body that leaves them, where they lie in front of it. Default: false.
    pub over: bool,
    /// Width of lines. Default: 1 px.
    pub width: Length,
    /// Colour of lines. Default: black.
    #[serde(alias = "color")]
    pub colour: Ink,
    /// Share of the width lost towards the far end, 0 to 1. Default: 0.
    #[serde(deserialize_with = "fraction")]
    pub taper: f64,
    /// Changes of single lines of a body, in order. Default: none.
    pub line: Vec<LineChange>,
    /// Length of the fade of strokes that appear or disappear in an animation, frames. Default: 0.
    #[serde(deserialize_with = "frames")]
    pub fade: u32,
    /// Property that fades. Default: width.
    pub fade_by: FadeBy,
}

/// Property of strokes that fades.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FadeBy {
    /// They become thinner.
    #[default]
    Width,
    /// They become paler.
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
            path: TrailPath::default(),
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

/// Motion that lines follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum TrailPath {
    /// That of the vertex where the line starts: arcs behind rotating bodies.
    #[default]
    Vertex,
    /// That of the body's centre, moved to each vertex: translation without rotation.
    Body,
}

/// Speed above which bodies leave lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Speed {
    /// Model units per second. Written as a number.
    Model(f64),
    /// Page length per second. Written as a string with a unit: `"200px"`.
    Page(Length),
}

/// Change of one line of a body.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct LineChange {
    /// Names of the parts or joints that it covers. Default: all.
    pub part: Option<Glob>,
    /// Number of the vertex in the part where the line starts.
    pub start: Option<u32>,
    /// Length in segments.
    #[serde(deserialize_with = "some_count")]
    pub length: Option<u32>,
    /// Width.
    pub width: Option<Length>,
    /// Colour.
    #[serde(alias = "color")]
    pub colour: Option<Ink>,
    /// Whether the line is drawn. Default: true.
    pub visible: Option<bool>,
}

/// Reads a number of lines or segments.
fn count<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    let is_count = |count: f64| (1.0..=f64::from(MAX_COUNT)).contains(&count) && count.fract() == 0.0;
    let advice = format!("is not a count; write a whole number from 1 to {MAX_COUNT}");
    Ok(checked(deserializer, is_count, &advice)? as u32)
}

fn some_count<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    count(deserializer).map(Some)
}

/// Reads a number of frames.
fn frames<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    let is_count =
        |frames: f64| (0.0..=f64::from(MAX_FADE_FRAMES)).contains(&frames) && frames.fract() == 0.0;
    let advice = format!("frames are not possible; write a whole number from 0 to {MAX_FADE_FRAMES}");
    Ok(checked(deserializer, is_count, &advice)? as u32)
}

/// Reads a number per second.
fn rate<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "segments per second are not possible; write a number from 0.001 to 10000";
    checked(deserializer, |rate| tolerances::SEGMENT_RATES_PER_S.contains(&rate), advice)
}

/// Reads an angle from 0 to 180 degrees.
fn angle<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "is not an angle; write degrees from 0 to 180";
    checked(deserializer, |degrees| (0.0..=180.0).contains(&degrees), advice)
}

/// Reads one name or a list of names.
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

/// Reads either form by its type, so that errors keep their position in the sheet.
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
