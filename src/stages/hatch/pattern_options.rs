//! [`Pattern`]: what is laid over one tone of one material: a table `[[fills.pattern]]` of a style sheet.

use kurbo::{BezPath, Point};
use serde::de::Error;
use serde::{Deserialize, Deserializer};

use crate::drawing::Length;
use crate::math::colour::Colour;
use crate::math::glob::Glob;
use crate::stroke::Ink;

/// What a pattern is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PatternKind {
    /// Round dots in rows.
    #[default]
    Dots,
    /// Parallel lines.
    Lines,
    /// Small upright crosses in rows; fixed to the surface, lines that cross.
    Crosses,
    /// The lines of a tile of one's own.
    Tile,
}

/// What a pattern keeps its place on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PatternFixed {
    /// The page: the same size everywhere, through which surfaces show.
    #[default]
    Page,
    /// The surface: it turns and shrinks with it. Lines and crosses only.
    Surface,
}

/// A pattern over one tone of one material.
///
/// Source: Claes et al., Fast 3D cartoon rendering with improved quality by exploiting graphics hardware, 2001, section 3.4 and figure 5d:
/// a texture in place of the colour of a tone.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pattern {
    /// Names of the materials it is for. Default: all.
    pub material: Glob,
    /// The tones it is for: 0 is the darkest, −1 the lightest; empty = all. Default: all.
    pub tones: Vec<i32>,
    /// What it is made of. Default: dots.
    pub kind: PatternKind,
    /// From one dot, line, cross or tile to the next. Default: 8 px.
    #[serde(deserialize_with = "size")]
    pub size: Length,
    /// Width of lines, diameter of dots. Default: 1.5 px.
    #[serde(deserialize_with = "size")]
    pub width: Length,
    /// Degrees that it is turned by, counter-clockwise. Default: 0.
    pub angle: f64,
    /// Its colour. Default: `#1a1a1a`.
    pub colour: Ink,
    /// How opaque it is, 0 to 1. Default: 1.
    #[serde(deserialize_with = "fraction")]
    pub opacity: f64,
    /// What it keeps its place on. Default: the page.
    pub fixed: PatternFixed,
    /// The lines of a tile, SVG path data in a square of side 10.
    #[serde(deserialize_with = "tile")]
    pub path: Vec<Vec<Point>>,
}

impl Default for Pattern {
    fn default() -> Self {
        Self {
            material: Glob::new("*"),
            tones: Vec::new(),
            kind: PatternKind::Dots,
            size: Length::px(8.0),
            width: Length::px(1.5),
            angle: 0.0,
            colour: Ink::Fixed(Colour::rgb(0x1a, 0x1a, 0x1a)),
            opacity: 1.0,
            fixed: PatternFixed::Page,
            path: Vec::new(),
        }
    }
}

impl Pattern {
    /// Whether it is for a tone, 0 the darkest, of a material that has `count` of them.
    #[must_use]
    pub fn is_for(&self, material: &str, tone: u16, count: u16) -> bool {
        let (tone, count) = (i32::from(tone), i32::from(count));
        let of = |own: &i32| *own == tone || *own + count == tone;
        self.material.matches(material) && (self.tones.is_empty() || self.tones.iter().any(of))
    }
}

/// Side of the square that the path of a tile is drawn in.
const TILE: f64 = 10.0;

/// How far the lines of a tile may be from its curves, as part of its side.
const FLAT: f64 = 0.002;

/// Points of all lines of a tile.
const MOST_POINTS: usize = 10_000;

/// The lines of path data, in a square of side 1.
fn tile<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec<Point>>, D::Error> {
    let text = String::deserialize(deserializer)?;
    let wrong = |what: String| {
        D::Error::custom(format!(
            "the tile {what}; write SVG path data in a square of 10, such as \"M0 0L10 10\""
        ))
    };
    let path = BezPath::from_svg(&text).map_err(|error| wrong(format!("is no path ({error})")))?;
    let mut lines: Vec<Vec<Point>> = Vec::new();
    kurbo::flatten(&path, FLAT * TILE, |element| match element {
        kurbo::PathEl::MoveTo(p) => lines.push(vec![p]),
        kurbo::PathEl::LineTo(p) => lines.last_mut().into_iter().for_each(|line| line.push(p)),
        kurbo::PathEl::ClosePath => lines.last_mut().into_iter().for_each(|line| line.push(line[0])),
        kurbo::PathEl::QuadTo(..) | kurbo::PathEl::CurveTo(..) => {}
    });
    lines.retain(|line| line.len() > 1);
    lines.iter_mut().flatten().for_each(|p| *p = Point::new(p.x / TILE, p.y / TILE));
    if lines.is_empty() || lines.iter().map(Vec::len).sum::<usize>() > MOST_POINTS {
        return Err(wrong("has no lines, or too many".to_owned()));
    }
    if lines.iter().flatten().any(|p| !p.is_finite() || p.x.abs() > 10.0 || p.y.abs() > 10.0) {
        return Err(wrong("reaches far beyond its square".to_owned()));
    }
    Ok(lines)
}

fn size<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Length, D::Error> {
    let length = Length::deserialize(deserializer)?;
    if length.value > 0.0 && length.value.is_finite() {
        Ok(length)
    } else {
        Err(D::Error::custom("a pattern has a size above 0; write such as 8 or \"2mm\""))
    }
}

fn fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if (0.0..=1.0).contains(&value) {
        Ok(value)
    } else {
        Err(D::Error::custom(format!("{value} is no part of a whole; write a number from 0 to 1")))
    }
}
