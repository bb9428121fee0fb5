//! Loads a style: follows `extends` from sheet to sheet, then merges their tables and the changes of the
//! command line.
//!
//! Every sheet and change is first deserialised separately, so an error can point into its own text.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::key_spelling::to_british;
use super::sheet_errors;
use super::toml_reader::{self, TomlFault};
use super::{SheetKeys, Style};
use crate::error::Error;
use crate::error::nearest::nearest;
use crate::style::files::artist_file::{place_artist_textures, read_artist_textures};
use crate::style::files::brush_file::place_brushes;
use crate::style::files::picture_file::place_paper;
use crate::style::files::tile_file::place_tiles;
use crate::style::tables::fills_table::remove_replaced_keys;
use crate::style::tables::ramp_source::place_pictures;
use crate::style::tables::style_sheet::StyleSheet;

/// A sheet that has been found.
struct SheetSource {
    /// Identity of the sheet: the built-in name, or the resolved path.
    identity: PathBuf,
    /// Name of the sheet in errors.
    shown: PathBuf,
    /// The folder that `extends` is relative to; `None` for built-in sheets.
    folder: Option<PathBuf>,
    text: String,
}

/// Loads a style, see [`Style::load`].
pub(crate) fn load_style(name_or_path: &str, sets: &[String]) -> Result<Style, Error> {
    merged_style(find(name_or_path, None)?, sets)
}

/// Reads the text of a sheet, see [`Style::from_toml`].
pub(crate) fn load_text(text: &str) -> Result<Style, Error> {
    let shown = PathBuf::from("style sheet");
    merged_style(SheetSource { identity: PathBuf::new(), shown, folder: None, text: text.to_owned() }, &[])
}

/// The style of a sheet, the sheets it extends, and changes.
fn merged_style(source: SheetSource, sets: &[String]) -> Result<Style, Error> {
    style_of(merged_table(source, sets)?)
}

/// A style with one more change.
pub(crate) fn changed(style: &Style, set: &str) -> Result<Style, Error> {
    let mut merged = style.keys.0.clone();
    merge(&mut merged, change(set)?);
    let mut changed = style_of(merged)?;
    changed.stroke.choice = style.stroke.choice.clone();
    let was_to_scale = style.clone().to_scale() == *style;
    Ok(if was_to_scale { changed.to_scale() } else { changed })
}

/// The style of merged keys. Reads the files that they name.
fn style_of(merged: Table) -> Result<Style, Error> {
    let mut sheet: StyleSheet =
        toml_reader::from_table(merged.clone()).map_err(|fault| Error::new(fault.message()))?;
    sheet.fills.read_pictures()?;
    sheet.fills.read_tiles()?;
    sheet.read_brushes()?;
    sheet.read_paper()?;
    read_artist_textures(&mut sheet.lines.artist_texture)?;
    Ok(Style { keys: SheetKeys(merged), ..sheet.into_style() })
}

/// The keys that a style sets, including those of the sheets it extends.
pub(crate) fn all_keys(name_or_path: &str) -> Result<Table, Error> {
    merged_table(find(name_or_path, None)?, &[])
}

/// The sheets of a style that are not built in: name in messages and keys, lowest priority first.
#[cfg(feature = "page")]
pub(crate) fn own_sheets(name_or_path: &str) -> Result<Vec<(PathBuf, Table)>, Error> {
    let chain = sheet_chain(find(name_or_path, None)?)?;
    Ok(chain
        .into_iter()
        .rev()
        .filter(|(source, _)| source.folder.is_some())
        .map(|(s, t)| (s.shown, t))
        .collect())
}

/// The merged keys of a sheet, the sheets it extends, and changes.
fn merged_table(source: SheetSource, sets: &[String]) -> Result<Table, Error> {
    let mut merged = Table::new();
    for (_, sheet) in sheet_chain(source)?.into_iter().rev() {
        merge(&mut merged, sheet);
    }
    for set in sets {
        merge(&mut merged, change(set)?);
    }
    merged.remove("extends");
    Ok(merged)
}

/// A sheet and the sheets it extends in turn, with their keys.
fn sheet_chain(source: SheetSource) -> Result<Vec<(SheetSource, Table)>, Error> {
    let mut sheets: Vec<(SheetSource, Table)> = Vec::new();
    let mut visited: Vec<PathBuf> = Vec::new();
    let mut next = Some(source);
    while let Some(source) = next.take() {
        let (sheet, mut table) = read(&source.text)
            .map_err(|error| sheet_errors::in_style_sheet(&source.text, &error).in_file(&source.shown))?;
        visited.push(source.identity.clone());
        if let Some(parent) = &sheet.extends {
            let extends_position = || sheet_errors::place_of_value(&source.text, "extends");
            let found = find(parent, source.folder.as_deref())
                .map_err(|error| error_in_sheet(error, &source.shown, &extends_position()))?;
            if visited.contains(&found.identity) {
                return Err(Error::new(format!(
                    "`extends = \"{parent}\"` leads back to a sheet it comes from"
                ))
                .in_file(&source.shown)
                .at(extends_position())
                .remedy("let one of the sheets extend another one, or none"));
            }
            next = Some(found);
        }
        let folder = source.folder.as_deref().unwrap_or(Path::new(""));
        place_pictures(&mut table, folder);
        place_brushes(&mut table, folder);
        place_artist_textures(&mut table, folder);
        place_tiles(&mut table, folder);
        place_paper(&mut table, folder);
        sheets.push((source, table));
    }
    Ok(sheets)
}

/// Finds a sheet: a built-in name, or a path relative to `folder`.
fn find(name: &str, folder: Option<&Path>) -> Result<SheetSource, Error> {
    if let Some(text) = Style::sheet_text(name) {
        let shown = PathBuf::from(format!("styles/{name}.toml"));
        return Ok(SheetSource { identity: PathBuf::from(name), shown, folder: None, text: text.to_owned() });
    }
    let path = folder.map_or_else(|| PathBuf::from(name), |folder| folder.join(name));
    let looks_like_path = name.ends_with(".toml") || name.contains(['/', '\\']);
    if !looks_like_path && !path.is_file() {
        let known: Vec<&str> = Style::names().collect();
        let remedy = match nearest(name, &known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("built-in styles: {}; or name a sheet's file, such as my.toml", known.join(", ")),
        };
        return Err(Error::new(format!("there is no style `{name}`")).remedy(remedy));
    }
    let bytes = std::fs::read(&path).map_err(|error| {
        Error::io("cannot read the style sheet", error).in_file(&path).remedy("check the path")
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        Error::new("is not UTF-8 text")
            .in_file(&path)
            .at(format!("byte {}", error.utf8_error().valid_up_to()))
            .remedy("save the style sheet as UTF-8")
    })?;
    let identity = std::fs::canonicalize(&path).unwrap_or_else(|_| path.clone());
    let folder = path.parent().map(Path::to_path_buf);
    Ok(SheetSource { identity, shown: path, folder, text })
}

/// Reports an error at the sheet that names a missing sheet.
fn error_in_sheet(mut error: Error, sheet: &Path, place: &str) -> Error {
    if let Some(file) = &error.file {
        error.message = format!("{}: {}", file.display(), error.message);
    }
    error.in_file(sheet).at(place)
}

/// Reads a sheet twice: as options, to find errors, and as a table, to merge it.
fn read(text: &str) -> Result<(StyleSheet, Table), TomlFault> {
    let (sheet, mut table) = (toml_reader::from_text(text)?, toml::from_str(text)?);
    to_british(&mut table);
    Ok((sheet, table))
}

/// Checks a change and makes the paths in it relative to `folder`.
#[cfg(feature = "page")]
pub(crate) fn placed_change(set: &str, folder: &Path) -> Result<String, Error> {
    let mut table = change(set)?;
    place_pictures(&mut table, folder);
    place_brushes(&mut table, folder);
    place_artist_textures(&mut table, folder);
    place_tiles(&mut table, folder);
    place_paper(&mut table, folder);
    Ok(table.iter().map(|(key, value)| format!("{key}={value}")).collect())
}

/// Parses a change of the command line into a table.
pub(crate) fn change(set: &str) -> Result<Table, Error> {
    let wrong = |message: &str| {
        Error::new(message).at(format!("--set {set}")).remedy("write KEY=VALUE, such as --set pen.width=1.5")
    };
    let (key, value) = set.split_once('=').ok_or_else(|| wrong("there is no `=`"))?;
    let (key, value) = (key.trim(), value.trim());
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    if key.is_empty() || !key.split('.').all(|part| !part.is_empty() && part.chars().all(plain)) {
        return Err(wrong(&format!("`{key}` is not a key")));
    }
    let quoted = Value::String(value.to_owned()).to_string();
    let written = format!("{key} = {value}");
    let mut readings = Vec::new();
    // A value with line breaks could contain further keys.
    if !value.contains(['\n', '\r']) && toml::from_str::<Table>(&written).is_ok() {
        readings.push(written);
        match value {
            "0" => readings.push(format!("{key} = false")),
            "1" => readings.push(format!("{key} = true")),
            _ => {}
        }
    }
    readings.push(format!("{key} = {quoted}"));
    let mut first_error = None;
    for text in readings {
        match read(&text) {
            Ok((_, table)) if table.contains_key("extends") => {
                return Err(wrong("`extends` cannot be set").remedy("name the sheet with --style"));
            }
            Ok((_, table)) => return Ok(table),
            Err(error) => {
                first_error.get_or_insert_with(|| sheet_errors::in_change(set, &text, &error));
            }
        }
    }
    Err(first_error.unwrap_or_else(|| wrong("is not understood")))
}

/// Merges a table into another one: tables key by key, lists of tables (rules, materials) appended, other
/// values replaced.
fn merge(base: &mut Table, over: Table) {
    for (key, value) in over {
        match (base.get_mut(&key), value) {
            (Some(Value::Table(below)), Value::Table(above)) => {
                if key == "fills" {
                    remove_replaced_keys(below, &above);
                }
                merge(below, above);
            }
            (Some(Value::Array(below)), Value::Array(above)) if key == "rule" || key == "material" => {
                below.extend(above)
            }
            (_, value) => {
                base.insert(key, value);
            }
        }
    }
}
