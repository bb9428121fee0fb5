//! [`read`]: a whole file, by several threads where it is large.
//!
//! What is copied from the system lands in memory that nobody has touched, and the system clears each page of it first: of
//! a file of 400 MB one thread did nothing else for a tenth of the time that its drawing took.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use crate::parallel::prelude::*;

/// Smaller files are read in less time than it takes to share them out.
const LEAST: u64 = 8 << 20;

/// What is read at once.
const BLOCK: usize = 64 << 10;

/// Blocks that are read as one piece of work.
const CHUNK: usize = 16;

/// All bytes of a file.
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_from(path, LEAST)
}

/// As [`read`], by several threads from so many bytes on.
fn read_from(path: &Path, least: u64) -> io::Result<Vec<u8>> {
    let about = fs::metadata(path)?;
    let room = usize::try_from(about.len()).ok().filter(|_| about.is_file() && about.len() >= least);
    // Whether there is room is asked first, since to be given none when it is needed ends the program.
    match room.filter(|size| Vec::<u8>::new().try_reserve_exact(*size).is_ok()) {
        // What cannot be read so, as a file that becomes shorter meanwhile, is read from its beginning to wherever it ends.
        Some(size) => in_blocks(path, size).or_else(|_| fs::read(path)),
        None => fs::read(path),
    }
}

/// A file of so many bytes, block by block. Blocks are told by their values, so that the memory they land in is touched first by
/// whoever reads them: asked to be empty before, one thread would write all of it.
fn in_blocks(path: &Path, size: usize) -> io::Result<Vec<u8>> {
    let failed = Mutex::new(None);
    let read = |file: &mut io::Result<File>, k: usize| -> io::Result<[u8; BLOCK]> {
        let mut block = [0; BLOCK];
        let file = file.as_mut().map_err(|error| io::Error::from(error.kind()))?;
        file.seek(SeekFrom::Start((k * BLOCK) as u64))?;
        file.read_exact(&mut block[..BLOCK.min(size - k * BLOCK)])?;
        Ok(block)
    };
    let blocks: Vec<[u8; BLOCK]> = (0..size.div_ceil(BLOCK))
        .into_par_iter()
        .with_min_len(CHUNK)
        .with_max_len(CHUNK)
        .map_init(
            || File::open(path),
            |file, k| {
                read(file, k).unwrap_or_else(|error| {
                    failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                    [0; BLOCK]
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
    fn a_file_read_in_blocks_is_the_file() {
        let path = std::env::temp_dir().join(format!("ligne-large-file-{}", std::process::id()));
        for size in [1, BLOCK - 1, BLOCK, 40 * BLOCK + 12_345] {
            let bytes: Vec<u8> = (0..size).map(|k| ((k * 31) % 251) as u8).collect();
            fs::write(&path, &bytes).expect("a file");
            assert!(read_from(&path, 1).expect("its bytes") == bytes, "{size}");
            // What has become shorter is an error here, and is then read in one go.
            assert!(in_blocks(&path, size + 1).is_err());
        }
        fs::remove_file(&path).expect("the file goes");
        assert!(read(&path).is_err());
    }
}
