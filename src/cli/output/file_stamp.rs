//! [`Stamp`]: how a file was found, to tell whether it has changed.

use std::fs;
use std::path::Path;
use std::time::SystemTime;

/// How a file was found.
pub(crate) type Stamp = Option<(SystemTime, u64)>;

/// When a file was changed, and how large it is; none where there is no file.
pub(crate) fn stamp(path: &Path) -> Stamp {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}
