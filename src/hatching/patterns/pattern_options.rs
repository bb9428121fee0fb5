//! [`Pattern`]: the table `[[fills.pattern]]` of a style sheet. It lays dots, lines, crosses or tiles over
//! the tones of painted surfaces.

use std::path::PathBuf;

use kurbo::BezPath;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::tile::Tile;
use crate::colour::srgb::Colour;
use crate::drawing::Length;
use crate::geometry::names::glob::Glob;
use crate::geometry::numbers::checked_number::share;
use crate::strokes::Ink;

/// Content of a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PatternKind {
    /// Round dots in rows.
    #[default]
    Dots,
    /// Parallel lines.
    Lines,
    /// Small upright crosses in rows. Fixed to the surface, they become crossing lines.
    Crosses,
    /// A custom tile: path data, an SVG file or a picture.
    Tile,
}

/// Frame of reference of a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PatternFixed {
    /// The page: the pattern has the same size and direction everywhere.
    #[default]
    Page,
    /// The surface: the pattern turns and shrinks with it.
    Surface,
}

/// Pattern over selected tones of selected materials.
///
/// Source: Claes et al., Fast 3D cartoon rendering with improved quality by exploiting graphics hardware,
/// 2001, section 3.4 and figure 5d, where a texture replaces the colour of a tone.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Pattern {
    /// Glob for the names of the materials that it covers. Default: all.
    pub material: Glob,
    /// The tones that it covers: 0 is the darkest, −1 the lightest; empty means all. Default: all.
    pub tones: Vec<i32>,
    /// Content. Default: dots.
    pub kind: PatternKind,
    /// Distance from one dot, line, cross or tile to the next. Default: 8 px.
    #[serde(deserialize_with = "size")]
    pub size: Length,
    /// Width of lines, diameter of dots. Default: 1.5 px.
    #[serde(deserialize_with = "size")]
    pub width: Length,
    /// Rotation in degrees, counter-clockwise. Default: 0.
    pub angle: f64,
    /// Colour. Default: `#1a1a1a`.
    #[serde(alias = "color")]
    pub colour: Ink,
    /// Opacity, 0 to 1. Default: 1.
    #[serde(deserialize_with = "share")]
    pub opacity: f64,
    /// Frame of reference. Default: the page.
    pub fixed: PatternFixed,
    /// A tile as SVG path data in a square of side 10.
    #[serde(deserialize_with = "tile")]
    pub path: Option<BezPath>,
    /// Whether the path is filled. If not, it is drawn as lines. Default: false.
    pub fill: bool,
    /// A tile as an SVG file; its filled and stroked paths are used.
    pub file: Option<PathBuf>,
    /// A tile as a PNG, JPEG or WebP picture; its dark areas are traced.
    pub image: Option<PathBuf>,
    /// Darkness threshold of the picture, 0 (white) to 1: darker areas are drawn. Default: 0.5.
    #[serde(deserialize_with = "share")]
    pub level: f64,
    /// Whether it also covers surfaces without painted tones.
    #[serde(skip)]
    pub unpainted: bool,
    /// The tile, once it has been read.
    #[serde(skip)]
    pub tile: Tile,
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
            path: None,
            fill: false,
            file: None,
            image: None,
            level: 0.5,
            unpainted: false,
            tile: Tile::default(),
        }
    }
}

impl Pattern {
    /// Whether it covers a tone of a material with `count` tones. Tone 0 is the darkest.
    #[must_use]
    pub(crate) fn is_for(&self, material: &str, tone: u16, count: u16) -> bool {
        let (tone, count) = (i32::from(tone), i32::from(count));
        let of = |own: &i32| *own == tone || *own + count == tone;
        self.material.matches(material) && (self.tones.is_empty() || self.tones.iter().any(of))
    }
}

/// Reads SVG path data that can form a tile.
fn tile<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<BezPath>, D::Error> {
    let text = String::deserialize(deserializer)?;
    let wrong = |what: String| {
        D::Error::custom(format!(
            "the tile {what}; write SVG path data in a square of 10, such as \"M0 0L10 10\""
        ))
    };
    let path = BezPath::from_svg(&text).map_err(|error| wrong(format!("is not a path ({error})")))?;
    Tile::of_path(&path, None).map_err(wrong)?;
    Ok(Some(path))
}

fn size<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Length, D::Error> {
    let length = Length::deserialize(deserializer)?;
    if length.value > 0.0 && length.value.is_finite() {
        Ok(length)
    } else {
        Err(D::Error::custom("a pattern has a size above 0; write such as 8 or \"2mm\""))
    }
}
