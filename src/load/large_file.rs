//! [`read`]: a whole file, by several threads where it is large.
//!
//! What is copied from the system lands in memory that nobody has touched, and the system clears each page of it first: of
//! a file of 400 MB one thread did nothing else for a tenth of the time that its drawing took.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

use rayon::prelude::*;

/// Smaller files may land in memory that was used before, which one thread has to clear: nothing is gained.
const LEAST: u64 = 256 << 20;

/// What is read as one piece of work.
const CHUNK: usize = 4 << 20;

/// All bytes of a file.
pub(super) fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_from(path, LEAST)
}

/// As [`read`], by several threads from so many bytes on.
fn read_from(path: &Path, least: u64) -> io::Result<Vec<u8>> {
    let about = fs::metadata(path)?;
    let room = usize::try_from(about.len()).ok().filter(|_| about.is_file() && about.len() >= least);
    // Whether there is room is asked first, since to be given none when it is needed ends the program.
    match room.filter(|size| Vec::<u8>::new().try_reserve_exact(*size).is_ok()) {
        // What cannot be read so, as a file that becomes shorter meanwhile, is read from its beginning to wherever it ends.
        Some(size) => in_chunks(path, size).or_else(|_| fs::read(path)),
        None => fs::read(path),
    }
}

fn in_chunks(path: &Path, size: usize) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; size];
    bytes.par_chunks_mut(CHUNK).enumerate().try_for_each(|(k, chunk)| {
        let mut file = File::open(path)?;
        file.seek(SeekFrom::Start((k * CHUNK) as u64))?;
        file.read_exact(chunk)
    })?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_read_in_chunks_is_the_file() {
        let path = std::env::temp_dir().join(format!("ligne-large-file-{}", std::process::id()));
        for size in [1, CHUNK - 1, CHUNK, 2 * CHUNK + 12_345] {
            let bytes: Vec<u8> = (0..size).map(|k| ((k * 31) % 251) as u8).collect();
            fs::write(&path, &bytes).expect("a file");
            assert!(read_from(&path, 1).expect("its bytes") == bytes, "{size}");
            // What has become shorter is an error here, and is then read in one go.
            assert!(in_chunks(&path, size + 1).is_err());
        }
        fs::remove_file(&path).expect("the file goes");
        assert!(read(&path).is_err());
    }
}
