//! [`BrushChange`]: a brush as written in a style sheet: a path, an SVG file or an image strip.

use std::path::PathBuf;
use std::sync::Arc;

use kurbo::{Affine, BezPath, Shape};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::brush::{Brush, BrushShape, TurnShapes};
use super::brush_strip::{BrushStrip, MIN_INK_DARKNESS};
use crate::colour::pixel_picture::Picture;
use crate::drawing::Length;

/// Change of brush: another brush, or none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum BrushChange {
    /// Plain lines: `"none"`.
    None,
    /// A brush whose file has not been read yet.
    Unread(Box<BrushSource>),
    /// A brush.
    Brush(Arc<Brush>),
}

impl BrushChange {
    /// The brush, or `None` while its file has not been read.
    #[must_use]
    pub(crate) fn brush(&self) -> Option<Arc<Brush>> {
        match self {
            Self::Brush(brush) => Some(Arc::clone(brush)),
            Self::None | Self::Unread(_) => None,
        }
    }
}

/// Brush whose shapes may be in files that have not been read.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BrushSource {
    /// Its shape.
    pub shape: ShapeSource,
    /// Shapes where lines turn.
    pub turns: Option<TurnSources>,
    /// Whether it is repeated along the line.
    pub repeats: bool,
    /// Length of one copy.
    pub length: Length,
}

/// Shapes for pieces of a line that turn. Absent ones use the straight shape.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TurnSources {
    /// To the left.
    pub left: Option<ShapeSource>,
    /// To the right.
    pub right: Option<ShapeSource>,
    /// Greatest turn that counts as straight, degrees.
    pub degrees: f64,
}

/// Source of a brush shape.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ShapeSource {
    /// The style sheet.
    Shape(BrushShape),
    /// The paths of an SVG file.
    Svg(PathBuf),
    /// A PNG, JPEG or WebP picture.
    Picture(PathBuf, PictureInside),
}

/// Treatment of the interior of a stroke's picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PictureInside {
    /// Paper between bristles is kept.
    #[default]
    Traced,
    /// Ink fills it from edge to edge.
    Solid,
    /// The picture itself is laid along the stroke. Its darkness becomes opacity.
    Image,
}

impl BrushSource {
    /// Reads the shapes with `read` and builds the brush.
    ///
    /// # Errors
    /// Errors of `read`.
    pub(crate) fn brush<E>(&self, read: impl Fn(&ShapeSource) -> Result<BrushShape, E>) -> Result<Brush, E> {
        let shape = read(&self.shape)?;
        let turned = |own: &Option<ShapeSource>| own.as_ref().map_or_else(|| Ok(shape.clone()), &read);
        let turns = match &self.turns {
            Some(TurnSources { left, right, degrees }) => {
                Some(TurnShapes { left: turned(left)?, right: turned(right)?, degrees: *degrees })
            }
            None => None,
        };
        Ok(Brush { shape, repeats: self.repeats, length: self.length, turns })
    }
}

impl BrushShape {
    /// A filled path of any size. Its bounding box is scaled to the brush's length and the pen's width.
    ///
    /// # Errors
    /// Describes the fault of the path.
    pub(crate) fn of_path(path: &BezPath) -> Result<Self, String> {
        let bounds = path.bounding_box();
        let (width, height) = (bounds.width(), bounds.height());
        if !(path.is_finite() && width > 0.0 && height > 0.0) {
            return Err("has no area".to_owned());
        }
        let to_unit = Affine::new([1.0 / width, 0.0, 0.0, 1.0 / height, 0.0, 0.0])
            * Affine::translate((-bounds.x0, -bounds.center().y));
        Ok(Self::Path(to_unit * path, width / height))
    }

    /// A picture of a stroke, dark on a light or transparent ground. It runs from left to right and is as
    /// high as the pen is wide.
    ///
    /// A solid picture becomes a profile: each column gives the extent of its ink up and down from the middle
    /// row. A column without ink has no width. A traced picture without paper inside becomes a profile as
    /// well.
    ///
    /// # Errors
    /// Describes the fault of the picture.
    pub(crate) fn of_picture(picture: &Picture, inside: PictureInside) -> Result<Self, String> {
        let middle = picture.height as f64 / 2.0;
        let dark = |column: usize, row: usize| {
            let c = picture.at(column, row);
            let grey = (f64::from(c.r) + f64::from(c.g) + f64::from(c.b)) / 765.0;
            let alpha = f64::from(c.a) / 255.0;
            1.0 - (grey * alpha + 1.0 - alpha) > MIN_INK_DARKNESS
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
        let ratio = picture.width as f64 / height;
        if inside == PictureInside::Image {
            return Ok(Self::Image(Arc::new(BrushStrip::of(picture)), ratio));
        }
        if inside == PictureInside::Traced {
            let strip = BrushStrip::of(picture);
            if !strip.is_solid() {
                return Ok(Self::Picture(strip, ratio));
            }
        }
        let profile = reaches.into_iter().map(|sides| sides.map(|reach| reach.max(0.0) / height)).collect();
        Ok(Self::Profile(profile, ratio))
    }
}

/// Fields of a brush table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BrushTable {
    path: Option<String>,
    file: Option<PathBuf>,
    image: Option<PathBuf>,
    inside: Option<PictureInside>,
    #[serde(default)]
    mode: BrushMode,
    length: Option<Length>,
    left: Option<TurnTable>,
    right: Option<TurnTable>,
    turn: Option<f64>,
}

/// Fields that give the source of a brush shape.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct ShapeTable {
    path: Option<String>,
    file: Option<PathBuf>,
    image: Option<PathBuf>,
    inside: Option<PictureInside>,
}

/// Shape of a turn: path data, or a table.
enum TurnTable {
    Path(String),
    Shape(ShapeTable),
}

impl<'de> Deserialize<'de> for TurnTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TurnVisitor)
    }
}

/// Reads either form by its type, so that errors keep their position in the sheet.
struct TurnVisitor;

impl<'de> Visitor<'de> for TurnVisitor {
    type Value = TurnTable;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("path data such as \"M0 0L10 1L0 2Z\", or a table with `path`, `file` or `image`")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<TurnTable, E> {
        Ok(TurnTable::Path(text.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TurnTable, A::Error> {
        ShapeTable::deserialize(MapAccessDeserializer::new(map)).map(TurnTable::Shape)
    }
}

/// Default of the greatest turn that counts as straight, degrees.
const DEFAULT_TURN_DEG: f64 = 10.0;

#[derive(Deserialize, Default, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum BrushMode {
    #[default]
    Stretch,
    Repeat,
}

impl TryFrom<ShapeTable> for ShapeSource {
    type Error = String;

    fn try_from(table: ShapeTable) -> Result<Self, String> {
        if table.inside.is_some() && table.image.is_none() {
            return Err("`inside` goes with an `image`".to_owned());
        }
        match (table.path, table.file, table.image) {
            (Some(text), None, None) => {
                let path =
                    BezPath::from_svg(&text).map_err(|e| format!("the brush is not SVG path data: {e}"))?;
                let shape = BrushShape::of_path(&path).map_err(|e| format!("the brush {e}"))?;
                Ok(Self::Shape(shape))
            }
            (None, Some(file), None) => Ok(Self::Svg(file)),
            (None, None, Some(file)) => Ok(Self::Picture(file, table.inside.unwrap_or_default())),
            _ => Err("a brush has one of `path`, `file` and `image`".to_owned()),
        }
    }
}

impl TryFrom<TurnTable> for ShapeSource {
    type Error = String;

    fn try_from(table: TurnTable) -> Result<Self, String> {
        Self::try_from(match table {
            TurnTable::Path(text) => ShapeTable { path: Some(text), ..ShapeTable::default() },
            TurnTable::Shape(table) => table,
        })
    }
}

impl TryFrom<BrushTable> for BrushChange {
    type Error = String;

    fn try_from(table: BrushTable) -> Result<Self, String> {
        let BrushTable { path, file, image, inside, mode, length, left, right, turn } = table;
        let repeats = mode == BrushMode::Repeat;
        let turned = left.is_some() || right.is_some() || turn.is_some();
        if turned && !repeats {
            return Err("`left`, `right` and `turn` go with a brush that is repeated: add mode = \"repeat\""
                .to_owned());
        }
        let degrees = turn.unwrap_or(DEFAULT_TURN_DEG);
        if !(0.0..=180.0).contains(&degrees) {
            return Err(format!("{degrees} is not an angle; write degrees from 0 to 180"));
        }
        let shape = ShapeSource::try_from(ShapeTable { path, file, image, inside })?;
        let [left, right] = [left, right].map(|own| own.map(ShapeSource::try_from).transpose());
        let turns = turned.then_some(TurnSources { left: left?, right: right?, degrees });
        let source = BrushSource { shape, turns, repeats, length: length.unwrap_or(Length::px(0.0)) };
        // A brush without files is ready at once.
        let own = |shape: &ShapeSource| match shape {
            ShapeSource::Shape(shape) => Ok(shape.clone()),
            ShapeSource::Svg(_) | ShapeSource::Picture(..) => Err(()),
        };
        Ok(match source.brush(own) {
            Ok(brush) => Self::Brush(Arc::new(brush)),
            Err(()) => Self::Unread(Box::new(source)),
        })
    }
}

impl<'de> Deserialize<'de> for BrushChange {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(BrushVisitor)
    }
}

/// Reads either form by its type, so that errors keep their position in the sheet.
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
