//! Unpacks buffer views compressed by EXT_meshopt_compression and KHR_meshopt_compression.
//!
//! Source: the bit streams as the two extensions specify them, vertex codec 0 and 1, index codec 0
//! and 1, all filters. The streams are read through a cursor that cannot leave them.

mod filter;
mod index;
mod vertex;

use super::json::Meshopt;
use super::uri::shown;
use crate::error::Error;

/// The uncompressed bytes of a view.
pub fn decode(packed: &Meshopt, bytes: &[u8]) -> Result<Vec<u8>, Error> {
    let Meshopt { count, byte_stride: stride, .. } = *packed;
    let filter = packed.filter.as_deref().unwrap_or("NONE");
    let decoded = match (packed.mode.as_str(), stride) {
        ("ATTRIBUTES", 4..=256) if stride % 4 == 0 => vertex::decode(bytes, count, stride),
        ("TRIANGLES", 2 | 4) if count % 3 == 0 => index::triangles(bytes, count, stride),
        ("INDICES", 2 | 4) => index::sequence(bytes, count, stride),
        (mode, _) => {
            let message = format!("meshopt mode `{}` with {count} elements of {stride} bytes", shown(mode));
            return Err(Error::new(message));
        }
    };
    let mut decoded = decoded.ok_or_else(|| {
        Error::new(format!("the meshopt stream of {} bytes is damaged", bytes.len()))
            .remedy("export the model again, or without meshopt compression")
    })?;
    match (filter, stride) {
        ("NONE", _) => {}
        ("OCTAHEDRAL", 4) => filter::octahedral_8(&mut decoded),
        ("OCTAHEDRAL", 8) => filter::octahedral_16(&mut decoded),
        ("QUATERNION", 8) => filter::quaternion(&mut decoded),
        ("EXPONENTIAL", _) if stride % 4 == 0 => filter::exponential(&mut decoded),
        ("COLOR", 4) => filter::colour_8(&mut decoded),
        ("COLOR", 8) => filter::colour_16(&mut decoded),
        (other, _) => {
            let message = format!("meshopt filter `{}` on elements of {stride} bytes", shown(other));
            return Err(Error::new(message));
        }
    }
    Ok(decoded)
}

/// What is left of a stream.
#[derive(Debug, Clone, Copy)]
struct Cursor<'a>(&'a [u8]);

impl<'a> Cursor<'a> {
    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    /// Takes bytes off the end.
    fn tail(&mut self, count: usize) -> Option<&'a [u8]> {
        let (rest, taken) = self.0.split_at_checked(self.0.len().checked_sub(count)?)?;
        self.0 = rest;
        Some(taken)
    }

    /// A number in groups of seven bits, the lowest first.
    fn varint(&mut self) -> Option<u32> {
        let mut value = 0;
        for group in 0..5 {
            let byte = self.byte()?;
            value |= u32::from(byte & 127) << (7 * group);
            if byte < 128 {
                break;
            }
        }
        Some(value)
    }

    /// `last` moved by a signed difference.
    fn moved(&mut self, last: u32) -> Option<u32> {
        self.varint().map(|value| last.wrapping_add(unzigzag(value)))
    }
}

fn unzigzag(value: u32) -> u32 {
    (value >> 1) ^ (value & 1).wrapping_neg()
}
