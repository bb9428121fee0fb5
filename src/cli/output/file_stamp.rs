//! [`FileStamp`]: modification time and size of a file, to detect changes and to wait for them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// Time between two checks of all files.
const POLL_INTERVAL: Duration = Duration::from_millis(60);

/// Time that a file must stay unchanged before it is read, because programs write files in several steps.
const SETTLE_TIME: Duration = Duration::from_millis(80);

/// Modification time and size of a file; none if there is no file.
pub(crate) type FileStamp = Option<(SystemTime, u64)>;

/// The stamps of several files.
pub(crate) type FileStamps = BTreeMap<PathBuf, FileStamp>;

/// Reads the modification time and size of a file.
pub(crate) fn stamp(path: &Path) -> FileStamp {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}

/// Reads the stamps of several files.
pub(crate) fn stamps<'a>(files: impl Iterator<Item = &'a PathBuf>) -> FileStamps {
    files.map(|path| (path.clone(), stamp(path))).collect()
}

/// Waits until the stamps of files differ from earlier ones and stay the same for a while. Returns them.
pub(crate) fn changed_stamps<'a>(
    files: impl Iterator<Item = &'a PathBuf> + Clone,
    earlier: &FileStamps,
) -> FileStamps {
    let mut now = earlier.clone();
    while now == *earlier {
        sleep(POLL_INTERVAL);
        now = stamps(files.clone());
    }
    loop {
        sleep(SETTLE_TIME);
        let later = stamps(files.clone());
        if later == now {
            return now;
        }
        now = later;
    }
}
