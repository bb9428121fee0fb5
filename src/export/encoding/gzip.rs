//! Compression and decompression of gzip, for `.svgz` files.
//!
//! Source: RFC 1952. Neither name nor time is written, so that equal bytes give equal files.

use std::io::Read;

use flate2::Compression;
use flate2::bufread::{GzDecoder, GzEncoder};

use crate::error::Error;

/// Compresses bytes as gzip.
#[must_use]
pub(crate) fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    // Reading from memory does not fail.
    let _ = GzEncoder::new(bytes, Compression::best()).read_to_end(&mut out);
    out
}

/// Whether bytes are gzip.
#[must_use]
pub(crate) fn is_packed(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x1f, 0x8b])
}

/// Decompresses the bytes of a file if they are gzip.
///
/// # Errors
/// If the gzip data is damaged, or contains more than `most` bytes.
pub(crate) fn plain(bytes: Vec<u8>, most: usize) -> Result<Vec<u8>, Error> {
    if !is_packed(&bytes) {
        return Ok(bytes);
    }
    unpacked(&bytes, most).ok_or_else(|| {
        Error::new("the gzip data is damaged or too large").remedy("unpack it with gunzip to see why")
    })
}

/// Decompresses gzip; `None` if it is damaged, contains more than `most` bytes or is followed by other bytes.
#[must_use]
pub(crate) fn unpacked(bytes: &[u8], most: usize) -> Option<Vec<u8>> {
    let mut decoder = GzDecoder::new(bytes);
    let mut out = Vec::new();
    decoder.by_ref().take(most as u64 + 1).read_to_end(&mut out).ok()?;
    (out.len() <= most && decoder.into_inner().is_empty()).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gzip_round_trips_and_rejects_damaged_files() {
        let text = b"<svg/> ".repeat(1000);
        let mut file = packed(&text);
        assert!(is_packed(&file) && file.len() < 200);
        assert_eq!(unpacked(&file, 1 << 20).as_deref(), Some(text.as_slice()));
        assert_eq!(unpacked(&file, 100), None);
        // A name and an extra field of three bytes.
        let mut named = file.clone();
        named[3] = 4 | 8;
        named.splice(10..10, *b"\x03\0xyza.svg\0");
        assert_eq!(unpacked(&named, 1 << 20).as_deref(), Some(text.as_slice()));
        for cut in 0..file.len() {
            assert_eq!(unpacked(&file[..cut], 1 << 20), None);
        }
        let last = file.len() - 5;
        file[last] ^= 1;
        assert_eq!(unpacked(&file, 1 << 20), None);
    }
}
