//! Waits for changes of a page file and its input files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::cli::output::file_stamp::{FileStamp, stamp};
use crate::page::PageFile;

/// Time between two checks of all files.
const POLL_INTERVAL: Duration = Duration::from_millis(60);

/// Time that a file must stay unchanged before it is read, because programs write files in several steps.
const SETTLE_TIME: Duration = Duration::from_millis(80);

type Stamps = BTreeMap<PathBuf, FileStamp>;

/// Watch over a page file and its inputs.
pub(crate) struct PageWatch<'a> {
    page: &'a Path,
    files: Vec<PathBuf>,
    last_stamps: Stamps,
}

impl<'a> PageWatch<'a> {
    /// Starts watching. Later changes are detected.
    pub(crate) fn new(page: &'a Path) -> Self {
        let files = files(page).unwrap_or_else(|| vec![page.to_path_buf()]);
        let seen = stamps(&files);
        Self { page, files, last_stamps: seen }
    }

    /// Waits for a change.
    pub(crate) fn changed(&mut self) {
        loop {
            std::thread::sleep(POLL_INTERVAL);
            let mut now = stamps(&self.files);
            if now == self.last_stamps {
                continue;
            }
            loop {
                std::thread::sleep(SETTLE_TIME);
                let later = stamps(&self.files);
                let rests = later == now;
                now = later;
                if rests {
                    break;
                }
            }
            // A missing file may come back: programs often save by replacing a file.
            let is_there =
                now.values().all(Option::is_some) || self.last_stamps.values().any(Option::is_none);
            if !is_there {
                continue;
            }
            // An unreadable page file keeps its previous inputs.
            self.files = files(self.page).unwrap_or_else(|| self.files.clone());
            self.last_stamps = stamps(&self.files);
            return;
        }
    }
}

fn files(page: &Path) -> Option<Vec<PathBuf>> {
    PageFile::open(page).ok().map(|file| file.inputs())
}

fn stamps(files: &[PathBuf]) -> Stamps {
    files.iter().map(|path| (path.clone(), stamp(path))).collect()
}
