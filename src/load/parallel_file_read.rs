//! [`read`]: reads a file, on several threads if it is large.
//!
//! The system clears each new memory page when it is first written. With one thread this takes a tenth of the
//! total time for a file of 400 MB, so all threads share it.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use crate::parallel::prelude::*;

/// Minimum size for parallel reading, bytes. Distributing smaller files takes longer than reading them.
const MIN_PARALLEL_BYTES: u64 = 8 << 20;

/// Bytes per read call.
const BLOCK_BYTES: usize = 64 << 10;

/// Blocks per parallel task.
const BLOCKS_PER_TASK: usize = 16;

/// Reads all bytes of a file.
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_from(path, MIN_PARALLEL_BYTES)
}

/// As [`read`], parallel from a size of `least` bytes on.
fn read_from(path: &Path, least: u64) -> io::Result<Vec<u8>> {
    let about = fs::metadata(path)?;
    let room = usize::try_from(about.len()).ok().filter(|_| about.is_file() && about.len() >= least);
    // Test the allocation first, because a failed allocation would abort the program.
    match room.filter(|size| Vec::<u8>::new().try_reserve_exact(*size).is_ok()) {
        // A file that cannot be read in blocks, for example because it has become shorter, is read
        // sequentially.
        Some(size) => in_blocks(path, size).or_else(|_| fs::read(path)),
        None => fs::read(path),
    }
}

/// Reads a file block by block. Blocks are values, so each thread is the first to touch the memory of its
/// blocks; a zeroed vector would be touched by one thread.
fn in_blocks(path: &Path, size: usize) -> io::Result<Vec<u8>> {
    let failed = Mutex::new(None);
    let read = |file: &mut io::Result<File>, k: usize| -> io::Result<[u8; BLOCK_BYTES]> {
        let mut block = [0; BLOCK_BYTES];
        let file = file.as_mut().map_err(|error| io::Error::from(error.kind()))?;
        file.seek(SeekFrom::Start((k * BLOCK_BYTES) as u64))?;
        file.read_exact(&mut block[..BLOCK_BYTES.min(size - k * BLOCK_BYTES)])?;
        Ok(block)
    };
    let blocks: Vec<[u8; BLOCK_BYTES]> = (0..size.div_ceil(BLOCK_BYTES))
        .into_par_iter()
        .with_min_len(BLOCKS_PER_TASK)
        .with_max_len(BLOCKS_PER_TASK)
        .map_init(
            || File::open(path),
            |file, k| {
                read(file, k).unwrap_or_else(|error| {
                    failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                    [0; BLOCK_BYTES]
                })
            },
        )
        .collect();
    if let Some(error) = failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(error);
    }
    let mut bytes = blocks.into_flattened();
    bytes.truncate(size);
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_file_read_returns_the_bytes_of_the_file() {
        let path = std::env::temp_dir().join(format!("ligne-large-file-{}", std::process::id()));
        for size in [1, BLOCK_BYTES - 1, BLOCK_BYTES, 40 * BLOCK_BYTES + 12_345] {
            let bytes: Vec<u8> = (0..size).map(|k| ((k * 31) % 251) as u8).collect();
            fs::write(&path, &bytes).expect("a file");
            assert!(read_from(&path, 1).expect("its bytes") == bytes, "{size}");
            // A file that has become shorter gives an error here, and is then read sequentially.
            assert!(in_blocks(&path, size + 1).is_err());
        }
        fs::remove_file(&path).expect("the file goes");
        assert!(read(&path).is_err());
    }
}
