//! Waits for changes of a page file and its input files.

use std::path::{Path, PathBuf};

use crate::cli::output::file_stamp::{FileStamps, changed_stamps, stamps};
use crate::page::PageFile;

/// Watch over a page file and its inputs.
pub(crate) struct PageWatch<'a> {
    page: &'a Path,
    files: Vec<PathBuf>,
    last_stamps: FileStamps,
}

impl<'a> PageWatch<'a> {
    /// Starts watching. Later changes are detected.
    pub(crate) fn new(page: &'a Path) -> Self {
        let files = files(page).unwrap_or_else(|| vec![page.to_path_buf()]);
        let seen = stamps(files.iter());
        Self { page, files, last_stamps: seen }
    }

    /// Waits for a change.
    pub(crate) fn changed(&mut self) {
        loop {
            let now = changed_stamps(self.files.iter(), &self.last_stamps);
            // A missing file may come back: programs often save by replacing a file.
            let is_there =
                now.values().all(Option::is_some) || self.last_stamps.values().any(Option::is_none);
            if !is_there {
                continue;
            }
            // An unreadable page file keeps its previous inputs.
            self.files = files(self.page).unwrap_or_else(|| self.files.clone());
            self.last_stamps = stamps(self.files.iter());
            return;
        }
    }
}

fn files(page: &Path) -> Option<Vec<PathBuf>> {
    PageFile::open(page).ok().map(|file| file.inputs())
}
