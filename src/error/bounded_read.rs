//! [`read_up_to`]: the bytes of a file that is not too large.

use std::io;
use std::path::Path;

/// Reads a file; `None` if it has more than `most` bytes.
pub(crate) fn read_up_to(path: &Path, most: u64) -> io::Result<Option<Vec<u8>>> {
    if std::fs::metadata(path)?.len() > most { Ok(None) } else { std::fs::read(path).map(Some) }
}
