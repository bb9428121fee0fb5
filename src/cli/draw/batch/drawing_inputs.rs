//! What a drawing is made from, and whether that is younger than the drawing.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::output::file_stamp::stamp;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::viewpoint::View;
use crate::style::Style;

/// Sheets that extend one another, at most.
const MOST_SHEETS: usize = 32;

/// The files that a drawing is made from: the model, the style sheet and those it extends, the camera record.
pub(crate) fn inputs(request: &DrawRequest) -> Vec<PathBuf> {
    let mut files = Vec::new();
    if request.piped.is_none() {
        files.push(request.model.clone());
    }
    if let View::Recorded(name) = &request.view {
        files.extend(Some(PathBuf::from(name)).filter(|path| path.is_file()));
    }
    let mut sheet = sheet(&request.style, Path::new(""));
    while let Some(path) = sheet.filter(|path| files.len() < MOST_SHEETS && !files.contains(path)) {
        sheet = parent(&path);
        files.push(path);
    }
    files
}

/// The file of a style that is not built in.
fn sheet(name: &str, folder: &Path) -> Option<PathBuf> {
    Style::sheet_text(name).is_none().then(|| folder.join(name))
}

/// The sheet that a sheet extends.
fn parent(path: &Path) -> Option<PathBuf> {
    let table: toml::Table = fs::read_to_string(path).ok()?.parse().ok()?;
    sheet(table.get("extends")?.as_str()?, path.parent().unwrap_or(Path::new("")))
}

/// Whether all files of a drawing are there, and younger than all they are made from.
///
/// A file of the same time as its model is made again: clocks of file systems may stand still for seconds.
pub(crate) fn is_current(request: &DrawRequest) -> bool {
    let time = |path: &Path| stamp(path).map(|(time, _)| time);
    let Some(oldest) = request.outputs.iter().map(|output| time(&output.path)).min().flatten() else {
        return false;
    };
    // What standard input held before, nobody knows.
    request.piped.is_none()
        && inputs(request).iter().all(|input| time(input).is_some_and(|time| time < oldest))
}
