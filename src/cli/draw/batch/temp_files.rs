//! Removes unfinished files of stopped runs.

use std::collections::{BTreeSet, HashSet};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::output::output_files::staged_target;

/// Removes unfinished files of these drawings. Only one run may draw them at a time, so no other run loses a
/// file.
pub(crate) fn remove_temp_files<'a>(drawings: impl Iterator<Item = &'a Path>) {
    let drawings: HashSet<&Path> = drawings.collect();
    let folders: BTreeSet<&Path> = drawings.iter().filter_map(|drawing| drawing.parent()).collect();
    for folder in folders {
        let listed = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // A folder that cannot be listed contains no such files.
        let names: Vec<OsString> =
            fs::read_dir(listed).into_iter().flatten().flatten().map(|entry| entry.file_name()).collect();
        for name in names {
            let drawing = name.to_str().and_then(staged_target).map(|drawing| folder.join(drawing));
            if drawing.is_some_and(|drawing: PathBuf| drawings.contains(drawing.as_path())) {
                // A file that cannot be removed does no harm.
                let _ = fs::remove_file(folder.join(&name));
            }
        }
    }
}
