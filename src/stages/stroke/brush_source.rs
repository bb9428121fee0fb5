//! [`BrushChange`]: a brush as a style sheet writes it: a path, an SVG file or an image strip.

use std::path::PathBuf;
use std::sync::Arc;

use kurbo::{Affine, BezPath, Shape};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::brush::{Brush, BrushShape, Turns};
use crate::drawing::Length;
use crate::math::picture::Picture;

/// Pixels of a strip darker than this, on white, are ink.
const DARK: f64 = 0.5;

/// Another brush, or none.
#[derive(Debug, Clone, PartialEq)]
pub enum BrushChange {
    /// Plain lines: `"none"`.
    None,
    /// A brush whose file has not been read yet.
    Unread(BrushSource),
    /// A brush.
    Brush(Arc<Brush>),
}

impl BrushChange {
    /// The brush; none as long as its file is not read.
    #[must_use]
    pub fn brush(&self) -> Option<Arc<Brush>> {
        match self {
            Self::Brush(brush) => Some(Arc::clone(brush)),
            Self::None | Self::Unread(_) => None,
        }
    }
}

/// A brush in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct BrushSource {
    /// An SVG file, whose paths are the brush, or a PNG, JPEG or WebP picture.
    pub file: PathBuf,
    /// Whether it is a picture.
    pub is_image: bool,
    /// Whether it is drawn again and again.
    pub repeats: bool,
    /// Length of one.
    pub length: Length,
}

impl Brush {
    /// A brush from a filled path of any size: its box is as long as the brush and as wide as the pen.
    ///
    /// # Errors
    /// Says what is wrong with the path.
    pub fn of_path(path: &BezPath, repeats: bool, length: Length) -> Result<Self, String> {
        let bounds = path.bounding_box();
        let (width, height) = (bounds.width(), bounds.height());
        if !(path.is_finite() && width > 0.0 && height > 0.0) {
            return Err("has no area".to_owned());
        }
        let to_unit = Affine::new([1.0 / width, 0.0, 0.0, 1.0 / height, 0.0, 0.0])
            * Affine::translate((-bounds.x0, -bounds.center().y));
        Ok(Self { shape: BrushShape::Path(to_unit * path, width / height), repeats, length, turns: None })
    }

    /// A brush from a picture of a stroke, dark on light or on nothing, that runs from left to right: each column
    /// gives how far its ink reaches up and down from the middle row. A column without ink has no width.
    ///
    /// # Errors
    /// Says what is wrong with the picture.
    pub fn of_picture(picture: &Picture, repeats: bool, length: Length) -> Result<Self, String> {
        let middle = picture.height as f64 / 2.0;
        let dark = |column: usize, row: usize| {
            let c = picture.at(column, row);
            let grey = (f64::from(c.r) + f64::from(c.g) + f64::from(c.b)) / 765.0;
            let alpha = f64::from(c.a) / 255.0;
            1.0 - (grey * alpha + 1.0 - alpha) > DARK
        };
        let reach = |column: usize| {
            let rows = || (0..picture.height).filter(|row| dark(column, *row));
            match (rows().next(), rows().next_back()) {
                (Some(top), Some(bottom)) => [middle - top as f64, bottom as f64 + 1.0 - middle],
                _ => [0.0, 0.0],
            }
        };
        let reaches: Vec<[f64; 2]> = (0..picture.width).map(reach).collect();
        if reaches.iter().all(|[up, down]| up + down <= 0.0) {
            return Err("has no dark pixels".to_owned());
        }
        let height = picture.height as f64;
        let profile = reaches.into_iter().map(|sides| sides.map(|reach| reach.max(0.0) / height)).collect();
        let shape = BrushShape::Profile(profile, picture.width as f64 / height);
        Ok(Self { shape, repeats, length, turns: None })
    }
}

/// A brush as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BrushTable {
    path: Option<String>,
    file: Option<PathBuf>,
    image: Option<PathBuf>,
    #[serde(default)]
    mode: Mode,
    length: Option<Length>,
    left: Option<String>,
    right: Option<String>,
    turn: Option<f64>,
}

/// Turns of no more than this many degrees are straight, unless a brush says otherwise.
const TURN_DEG: f64 = 10.0;

#[derive(Deserialize, Default, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Mode {
    #[default]
    Stretch,
    Repeat,
}

impl TryFrom<BrushTable> for BrushChange {
    type Error = String;

    fn try_from(table: BrushTable) -> Result<Self, String> {
        let repeats = table.mode == Mode::Repeat;
        let length = table.length.unwrap_or(Length::px(0.0));
        let turned = table.left.is_some() || table.right.is_some() || table.turn.is_some();
        if turned && !(repeats && table.path.is_some()) {
            return Err(
                "`left`, `right` and `turn` go with a `path` that is repeated: add mode = \"repeat\""
                    .to_owned(),
            );
        }
        let degrees = table.turn.unwrap_or(TURN_DEG);
        if !(0.0..=180.0).contains(&degrees) {
            return Err(format!("{degrees} is no turn; write degrees from 0 to 180"));
        }
        match (table.path, table.file, table.image) {
            (Some(text), None, None) => {
                let of_text = |text: &str| {
                    let path =
                        BezPath::from_svg(text).map_err(|e| format!("the brush is no SVG path data: {e}"))?;
                    Brush::of_path(&path, repeats, length).map_err(|e| format!("the brush {e}"))
                };
                let mut brush = of_text(&text)?;
                if turned {
                    let shape = |own: Option<String>| match of_text(own.as_ref().unwrap_or(&text))?.shape {
                        BrushShape::Path(path, _) => Ok::<_, String>(path),
                        BrushShape::Profile(..) => Ok(BezPath::new()),
                    };
                    let (left, right) = (shape(table.left)?, shape(table.right)?);
                    brush.turns = Some(Turns { left, right, degrees });
                }
                Ok(Self::Brush(Arc::new(brush)))
            }
            (None, Some(file), None) => {
                Ok(Self::Unread(BrushSource { file, is_image: false, repeats, length }))
            }
            (None, None, Some(file)) => {
                Ok(Self::Unread(BrushSource { file, is_image: true, repeats, length }))
            }
            _ => Err("a brush has one of `path`, `file` and `image`".to_owned()),
        }
    }
}

impl<'de> Deserialize<'de> for BrushChange {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(BrushVisitor)
    }
}

/// Reads either form by what it meets, so that errors keep their place in the sheet.
struct BrushVisitor;

impl<'de> Visitor<'de> for BrushVisitor {
    type Value = BrushChange;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a brush such as { path = \"M0 0L10 1L0 2Z\" }, { file = \"brush.svg\" } or { image = \"brush.png\" }, or \"none\"")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<BrushChange, E> {
        match text {
            "none" => Ok(BrushChange::None),
            _ => Err(E::custom(format!("`{text}` is not a brush; write {{ path = \"…\" }} or \"none\""))),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<BrushChange, A::Error> {
        let table = BrushTable::deserialize(MapAccessDeserializer::new(map))?;
        BrushChange::try_from(table).map_err(A::Error::custom)
    }
}
