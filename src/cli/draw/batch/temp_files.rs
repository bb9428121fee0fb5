//! What killed runs left beside drawings: files that had not come to their places.

use std::collections::{BTreeSet, HashSet};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::output::output_files::staged_for;

/// Removes what was being written for these drawings when a run was killed. Whoever is to draw them is alone in that, so
/// that nobody loses a file.
pub(crate) fn sweep<'a>(drawings: impl Iterator<Item = &'a Path>) {
    let drawings: HashSet<&Path> = drawings.collect();
    let folders: BTreeSet<&Path> = drawings.iter().filter_map(|drawing| drawing.parent()).collect();
    for folder in folders {
        let listed = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // Where nothing was drawn yet, nothing was left.
        let names: Vec<OsString> =
            fs::read_dir(listed).into_iter().flatten().flatten().map(|entry| entry.file_name()).collect();
        for name in names {
            let drawing = name.to_str().and_then(staged_for).map(|drawing| folder.join(drawing));
            if drawing.is_some_and(|drawing: PathBuf| drawings.contains(drawing.as_path())) {
                // One that stays does no harm.
                let _ = fs::remove_file(folder.join(&name));
            }
        }
    }
}
