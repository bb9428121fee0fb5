//! Compression and decompression of gzip, for `.svgz` files.
//!
//! Source: RFC 1952. Neither name nor time is written, so that equal bytes give equal files.

use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

use crate::error::Error;

/// Compression level, 0 to 10.
const DEFLATE_LEVEL: u8 = 9;

/// Magic number, method, flags, time, extra flags (best compression), system (unknown).
const GZIP_HEADER: [u8; 10] = [0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 2, 255];

/// Compresses bytes as gzip.
#[must_use]
pub(crate) fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut out = GZIP_HEADER.to_vec();
    out.extend_from_slice(&compress_to_vec(bytes, DEFLATE_LEVEL));
    out.extend_from_slice(&crc32(bytes).to_le_bytes());
    // The format stores the length modulo 2^32.
    out.extend_from_slice(&(bytes.len() as u32).to_le_bytes());
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

/// Decompresses gzip; `None` if it is damaged or contains more than `most` bytes.
#[must_use]
pub(crate) fn unpacked(bytes: &[u8], most: usize) -> Option<Vec<u8>> {
    let (head, rest) = bytes.split_at_checked(GZIP_HEADER.len())?;
    let [0x1f, 0x8b, 8, flags, ..] = *head else { return None };
    let (body, tail) = rest.split_at_checked(rest.len().checked_sub(8)?)?;
    let body = body.get(extras(body, flags)?..)?;
    let out = decompress_to_vec_with_limit(body, most).ok()?;
    let (sum, length) = tail.split_at_checked(4)?;
    let right = sum == crc32(&out).to_le_bytes() && length == (out.len() as u32).to_le_bytes();
    right.then_some(out)
}

/// Length of the optional header fields selected by the flags.
fn extras(body: &[u8], flags: u8) -> Option<usize> {
    /// The header has a checksum.
    const CHECKED: u8 = 2;
    /// The header has an extra field.
    const EXTRA: u8 = 4;
    /// The header has a file name.
    const NAMED: u8 = 8;
    /// The header has a comment.
    const COMMENTED: u8 = 16;
    let mut at = 0;
    if flags & EXTRA != 0 {
        let length = body.get(..2)?;
        at = 2 + usize::from(u16::from_le_bytes([*length.first()?, *length.get(1)?]));
    }
    for flag in [NAMED, COMMENTED] {
        if flags & flag != 0 {
            at += body.get(at..)?.iter().position(|byte| *byte == 0)? + 1;
        }
    }
    if flags & CHECKED != 0 {
        at += 2;
    }
    Some(at)
}

/// CRC-32 computed bit by bit. Compression takes longer than this.
fn crc32(bytes: &[u8]) -> u32 {
    /// Reversed polynomial of CRC-32.
    const POLYNOMIAL: u32 = 0xedb8_8320;
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ (POLYNOMIAL & (sum & 1).wrapping_neg()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crc32_matches_the_standard_check_value() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    }

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
