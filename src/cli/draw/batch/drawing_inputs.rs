//! Input files of a drawing, and whether the drawing is newer than all of them.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::output::file_stamp::stamp;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::viewpoint::ViewRequest;
use crate::style::Style;

/// Maximum number of input files. Stops at cyclic style sheets.
const MAX_INPUT_FILES: usize = 32;

/// Input files of a drawing: the model, the camera record, the style sheet and the sheets it extends.
pub(crate) fn inputs(request: &DrawRequest) -> Vec<PathBuf> {
    let mut files = Vec::new();
    if request.piped.is_none() {
        files.push(request.model.clone());
    }
    if let ViewRequest::Recorded(name) = &request.view {
        files.extend(Some(PathBuf::from(name)).filter(|path| path.is_file()));
    }
    let mut sheet = sheet(&request.how.style, Path::new(""));
    while let Some(path) = sheet.filter(|path| files.len() < MAX_INPUT_FILES && !files.contains(path)) {
        sheet = parent(&path);
        files.push(path);
    }
    files
}

/// Path of a style sheet; none for a built-in style.
fn sheet(name: &str, folder: &Path) -> Option<PathBuf> {
    Style::sheet_text(name).is_none().then(|| folder.join(name))
}

/// Style sheet that a sheet extends.
fn parent(path: &Path) -> Option<PathBuf> {
    let table: toml::Table = fs::read_to_string(path).ok()?.parse().ok()?;
    sheet(table.get("extends")?.as_str()?, path.parent().unwrap_or(Path::new("")))
}

/// Whether all files of a drawing exist and are newer than all its inputs.
///
/// A file with the same time as its model is drawn again, because clocks of file systems can be seconds
/// coarse.
pub(crate) fn is_current(request: &DrawRequest) -> bool {
    let time = |path: &Path| stamp(path).map(|(time, _)| time);
    let Some(oldest) = request.outputs.iter().map(|output| time(&output.path)).min().flatten() else {
        return false;
    };
    // The previous contents of standard input are unknown.
    request.piped.is_none()
        && inputs(request).iter().all(|input| time(input).is_some_and(|time| time < oldest))
}
