//! Waiting until a page file, or a file that it names, changes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::cli::output::file_stamp::{Stamp, stamp};
use crate::page::PageFile;

/// Time between two looks at all files.
const LOOK: Duration = Duration::from_millis(60);

/// How long a file is to stay as it is before it is read: programs write in several strokes.
const REST: Duration = Duration::from_millis(80);

type Stamps = BTreeMap<PathBuf, Stamp>;

/// Looks at the files of a page file.
pub(crate) struct Watch<'a> {
    page: &'a Path,
    files: Vec<PathBuf>,
    seen: Stamps,
}

impl<'a> Watch<'a> {
    /// Begins; what changes from now on is noticed.
    pub(crate) fn new(page: &'a Path) -> Self {
        let files = files(page).unwrap_or_else(|| vec![page.to_path_buf()]);
        let seen = stamps(&files);
        Self { page, files, seen }
    }

    /// Waits until something has changed.
    pub(crate) fn changed(&mut self) {
        loop {
            std::thread::sleep(LOOK);
            let mut now = stamps(&self.files);
            if now == self.seen {
                continue;
            }
            loop {
                std::thread::sleep(REST);
                let later = stamps(&self.files);
                let rests = later == now;
                now = later;
                if rests {
                    break;
                }
            }
            // A file that is away may be on its way back: programs that save replace files.
            let is_there = now.values().all(Option::is_some) || self.seen.values().any(Option::is_none);
            if !is_there {
                continue;
            }
            // While the page file cannot be read, it may name what it did before.
            self.files = files(self.page).unwrap_or_else(|| self.files.clone());
            self.seen = stamps(&self.files);
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
