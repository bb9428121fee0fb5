//! [`FileStamp`]: modification time and size of a file, to detect changes.

use std::fs;
use std::path::Path;
use std::time::SystemTime;

/// Modification time and size of a file; none if there is no file.
pub(crate) type FileStamp = Option<(SystemTime, u64)>;

/// Reads the modification time and size of a file.
pub(crate) fn stamp(path: &Path) -> FileStamp {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}
