//! Reads the tiles of patterns: path data, SVG files and pictures.

use std::fmt;
use std::path::Path;

use toml::Value;

use super::svg_file;
use crate::colour::pixel_picture::Picture;
use crate::error::Error;
use crate::hatching::{Pattern, PatternKind, Tile, WindingRule};

/// Maximum size of a tile file, bytes.
const MAX_FILE_BYTES: u64 = 1 << 24;

/// Reads the tile of a pattern of tiles; does nothing for other patterns.
pub(crate) fn read_tile(pattern: &mut Pattern) -> Result<(), Error> {
    let named = [pattern.path.is_some(), pattern.file.is_some(), pattern.image.is_some()];
    if pattern.kind != PatternKind::Tile {
        // A `path` without effect is accepted, as it always was.
        if named[1] || named[2] {
            return Err(Error::new("`file` and `image` of a pattern are tiles")
                .at("fills.pattern")
                .remedy("add kind = \"tile\""));
        }
        return Ok(());
    }
    if named.iter().filter(|named| **named).count() != 1 {
        return Err(Error::new("a pattern of tiles has one of `path`, `file` and `image`")
            .at("fills.pattern")
            .remedy("write such as path = \"M0 0L10 10\", or image = \"tile.png\""));
    }
    pattern.tile = if let Some(path) = &pattern.path {
        Tile::of_path(path, pattern.fill.then_some(WindingRule::NonZero)).map_err(|message| {
            Error::new(format!("the tile {message}"))
                .at("fills.pattern")
                .remedy("write SVG path data in a square of 10, such as \"M0 0L10 10\"")
        })?
    } else if let Some(file) = &pattern.file {
        svg_file::read(&bytes(file)?)
            .and_then(|svg| Tile::of_shapes(&svg.painted, svg.size))
            .map_err(|message| unfit(file, message))?
    } else if let Some(file) = &pattern.image {
        Picture::decode(&bytes(file)?)
            .and_then(|picture| Tile::of_picture(&picture, pattern.level))
            .map_err(|message| unfit(file, message))?
    } else {
        Tile::default()
    };
    Ok(())
}

/// Makes the paths of tiles relative to the folder of their sheet.
pub(crate) fn place_tiles(sheet: &mut toml::Table, folder: &Path) {
    let Some(Value::Table(fills)) = sheet.get_mut("fills") else { return };
    let Some(Value::Array(patterns)) = fills.get_mut("pattern") else { return };
    for pattern in patterns.iter_mut().filter_map(Value::as_table_mut) {
        for key in ["file", "image"] {
            if let Some(Value::String(path)) = pattern.get_mut(key) {
                *path = folder.join(&*path).to_string_lossy().into_owned();
            }
        }
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let unread = |error: std::io::Error| {
        Error::io("cannot read the tile", error).in_file(path).remedy("check the path")
    };
    if std::fs::metadata(path).map_err(unread)?.len() > MAX_FILE_BYTES {
        return Err(unfit(path, "is too large"));
    }
    std::fs::read(path).map_err(unread)
}

fn unfit(path: &Path, message: impl fmt::Display) -> Error {
    Error::new(format!("the tile {message}"))
        .in_file(path)
        .remedy("give an SVG file with dark paths, or a small PNG, JPEG or WebP picture, dark on light")
}
