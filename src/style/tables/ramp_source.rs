//! Ramps and tables of tones in a style sheet: colours, or the path of a picture.

use std::fmt;
use std::path::{Path, PathBuf};

use serde::de::value::SeqAccessDeserializer;
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::error::Error;
use crate::light::tones::tone_ramps::{Strip, Table};

/// Maximum size of a picture of tones, bytes.
const MAX_FILE_BYTES: u64 = 1 << 24;

/// Maximum width and height of a table of tones, px.
const MAX_TABLE_SIDE_PX: usize = 1024;

/// A ramp: the path of a picture, or colours from dark to light.
#[derive(Debug, Clone)]
pub(crate) enum RampSource {
    Picture(PathBuf),
    Read(Strip),
}

/// A table of tones: the path of a picture, or rows of colours.
#[derive(Debug, Clone)]
pub(crate) enum TableSource {
    Picture(PathBuf),
    Read(Table),
}

impl RampSource {
    /// Reads the picture.
    pub(crate) fn read(&mut self) -> Result<(), Error> {
        if let Self::Picture(path) = self {
            let strip = Strip::of_picture(&picture(path)?).map_err(|message| unfit(path, message))?;
            *self = Self::Read(strip);
        }
        Ok(())
    }

    pub(crate) fn into_strip(self) -> Option<Strip> {
        match self {
            Self::Read(strip) => Some(strip),
            Self::Picture(_) => None,
        }
    }
}

impl TableSource {
    /// Reads the picture.
    pub(crate) fn read(&mut self) -> Result<(), Error> {
        if let Self::Picture(path) = self {
            let picture = picture(path)?;
            if picture.width.max(picture.height) > MAX_TABLE_SIDE_PX {
                return Err(unfit(path, format!("is larger than {MAX_TABLE_SIDE_PX} px")));
            }
            let table = Table::of_picture(&picture).map_err(|message| unfit(path, message))?;
            *self = Self::Read(table);
        }
        Ok(())
    }

    pub(crate) fn into_table(self) -> Option<Table> {
        match self {
            Self::Read(table) => Some(table),
            Self::Picture(_) => None,
        }
    }
}

/// Makes the paths of pictures of tones relative to the folder of their sheet.
pub(crate) fn place_pictures(sheet: &mut toml::Table, folder: &Path) {
    let Some(toml::Value::Table(fills)) = sheet.get_mut("fills") else { return };
    let place = |table: &mut toml::Table| {
        for key in ["ramp", "table"] {
            if let Some(toml::Value::String(path)) = table.get_mut(key) {
                *path = folder.join(&*path).to_string_lossy().into_owned();
            }
        }
    };
    place(fills);
    if let Some(toml::Value::Array(materials)) = fills.get_mut("material") {
        materials.iter_mut().filter_map(toml::Value::as_table_mut).for_each(place);
    }
}

fn picture(path: &Path) -> Result<Picture, Error> {
    let unread = |error: std::io::Error| {
        Error::io("cannot read the picture of tones", error).in_file(path).remedy("check the path")
    };
    if std::fs::metadata(path).map_err(unread)?.len() > MAX_FILE_BYTES {
        return Err(unfit(path, "is too large"));
    }
    let bytes = std::fs::read(path).map_err(unread)?;
    Picture::decode(&bytes).map_err(|message| unfit(path, message))
}

fn unfit(path: &Path, message: impl fmt::Display) -> Error {
    Error::new(format!("the picture of tones {message}"))
        .in_file(path)
        .remedy("give a small PNG, JPEG or WebP whose pixels are tones")
}

impl<'de> Deserialize<'de> for RampSource {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RampVisitor)
    }
}

impl<'de> Deserialize<'de> for TableSource {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TableVisitor)
    }
}

/// Dispatches on the type of the value, which keeps the position of errors in the sheet.
struct RampVisitor;

impl<'de> Visitor<'de> for RampVisitor {
    type Value = RampSource;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the path of a picture, or a list of colours from dark to light")
    }

    fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<RampSource, E> {
        Ok(RampSource::Picture(path.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<RampSource, A::Error> {
        let colours = Vec::<Colour>::deserialize(SeqAccessDeserializer::new(list))?;
        let strip = Strip::of_columns(&colours);
        strip.map(RampSource::Read).map_err(|m| serde::de::Error::custom(format!("the ramp {m}")))
    }
}

/// Dispatches on the type of the value, which keeps the position of errors in the sheet.
struct TableVisitor;

impl<'de> Visitor<'de> for TableVisitor {
    type Value = TableSource;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the path of a picture, or a list of rows of colours")
    }

    fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<TableSource, E> {
        Ok(TableSource::Picture(path.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<TableSource, A::Error> {
        let rows = Vec::<Vec<Colour>>::deserialize(SeqAccessDeserializer::new(list))?;
        let table = Table::of_rows(&rows);
        table.map(TableSource::Read).map_err(|m| serde::de::Error::custom(format!("the table {m}")))
    }
}
