//! Brushes from files: SVG paths and pictures of strokes.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use kurbo::BezPath;
use toml::Value;

use super::svg_file;
use crate::colour::pixel_picture::Picture;
use crate::error::Error;
use crate::strokes::{BrushChange, BrushShape, ShapeSource};

/// Maximum size of a brush file, bytes.
const MAX_FILE_BYTES: u64 = 1 << 24;

/// Reads the files of a brush that has not been read.
pub(crate) fn read_brush(change: &mut BrushChange) -> Result<(), Error> {
    if let BrushChange::Unread(source) = change {
        let brush = source.brush(read)?;
        *change = BrushChange::Brush(Arc::new(brush));
    }
    Ok(())
}

/// Makes the paths of brushes relative to the folder of their sheet.
pub(crate) fn place_brushes(sheet: &mut toml::Table, folder: &Path) {
    let place_shape = |shape: &mut toml::Table| {
        for key in ["file", "image"] {
            if let Some(Value::String(path)) = shape.get_mut(key) {
                *path = folder.join(&*path).to_string_lossy().into_owned();
            }
        }
    };
    let place = |pen: &mut toml::Table| {
        let Some(Value::Table(brush)) = pen.get_mut("brush") else { return };
        place_shape(brush);
        for turn in ["left", "right"] {
            if let Some(Value::Table(shape)) = brush.get_mut(turn) {
                place_shape(shape);
            }
        }
    };
    if let Some(Value::Table(pens)) = sheet.get_mut("pen") {
        place(pens);
        pens.iter_mut().filter_map(|(_, pen)| pen.as_table_mut()).for_each(place);
    }
    if let Some(Value::Array(rules)) = sheet.get_mut("rule") {
        let pens = rules.iter_mut().filter_map(|rule| rule.get_mut("pen")?.as_table_mut());
        pens.for_each(place);
    }
}

fn read(source: &ShapeSource) -> Result<BrushShape, Error> {
    let (path, inside) = match source {
        ShapeSource::Shape(shape) => return Ok(shape.clone()),
        ShapeSource::Svg(path) => (path, None),
        ShapeSource::Picture(path, inside) => (path, Some(*inside)),
    };
    let unread = |error: std::io::Error| {
        Error::io("cannot read the brush", error).in_file(path).remedy("check the path")
    };
    if std::fs::metadata(path).map_err(unread)?.len() > MAX_FILE_BYTES {
        return Err(unfit(path, "is too large"));
    }
    let bytes = std::fs::read(path).map_err(unread)?;
    let shape = match inside {
        Some(inside) => Picture::decode(&bytes).and_then(|picture| BrushShape::of_picture(&picture, inside)),
        None => svg_file::read(&bytes).and_then(|svg| {
            let all: BezPath = svg.paths.iter().flatten().collect();
            BrushShape::of_path(&all)
        }),
    };
    shape.map_err(|message| unfit(path, message))
}

fn unfit(path: &Path, message: impl fmt::Display) -> Error {
    Error::new(format!("the brush {message}"))
        .in_file(path)
        .remedy("give an SVG file with a filled path, or a PNG, JPEG or WebP picture of a stroke")
}
