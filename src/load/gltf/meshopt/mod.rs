//! Decompresses buffer views of EXT_meshopt_compression and KHR_meshopt_compression.
//!
//! Source: the bit streams as specified by the two extensions: vertex codec 0 and 1, index codec 0 and 1, all
//! filters. A bounds-checked cursor reads the streams.
//!
//! Files: [`vertex_codec`] byte columns as differences; [`index_codec`] triangles that share edges with
//! recent ones, and plain sequences; [`vertex_filters`] unit vectors, quaternions, floats and colours.

mod index_codec;
mod vertex_codec;
mod vertex_filters;

use super::json::Meshopt;
use super::uri::shortened;
use crate::error::Error;

/// Decompresses a view.
pub(crate) fn decode(packed: &Meshopt, bytes: &[u8]) -> Result<Vec<u8>, Error> {
    let Meshopt { count, byte_stride: stride, .. } = *packed;
    let filter = packed.filter.as_deref().unwrap_or("NONE");
    let decoded = match (packed.mode.as_str(), stride) {
        ("ATTRIBUTES", 4..=256) if stride % 4 == 0 => vertex_codec::decode(bytes, count, stride),
        ("TRIANGLES", 2 | 4) if count % 3 == 0 => index_codec::triangles(bytes, count, stride),
        ("INDICES", 2 | 4) => index_codec::sequence(bytes, count, stride),
        (mode, _) => {
            let message =
                format!("meshopt mode `{}` with {count} elements of {stride} bytes", shortened(mode));
            return Err(Error::new(message));
        }
    };
    let mut decoded = decoded.ok_or_else(|| {
        Error::new(format!("the meshopt stream of {} bytes is damaged", bytes.len()))
            .remedy("export the model again, or without meshopt compression")
    })?;
    match (filter, stride) {
        ("NONE", _) => {}
        ("OCTAHEDRAL", 4) => vertex_filters::octahedral_8(&mut decoded),
        ("OCTAHEDRAL", 8) => vertex_filters::octahedral_16(&mut decoded),
        ("QUATERNION", 8) => vertex_filters::quaternion(&mut decoded),
        ("EXPONENTIAL", _) if stride % 4 == 0 => vertex_filters::exponential(&mut decoded),
        ("COLOR", 4) => vertex_filters::colour_8(&mut decoded),
        ("COLOR", 8) => vertex_filters::colour_16(&mut decoded),
        (other, _) => {
            let message = format!("meshopt filter `{}` on elements of {stride} bytes", shortened(other));
            return Err(Error::new(message));
        }
    }
    Ok(decoded)
}

/// Unread bytes of a stream.
#[derive(Debug, Clone, Copy)]
struct ByteCursor<'a>(&'a [u8]);

impl<'a> ByteCursor<'a> {
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

    /// Takes bytes from the end.
    fn tail(&mut self, count: usize) -> Option<&'a [u8]> {
        let (rest, taken) = self.0.split_at_checked(self.0.len().checked_sub(count)?)?;
        self.0 = rest;
        Some(taken)
    }

    /// Reads a LEB128 number: groups of seven bits, lowest first.
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

    /// `last` plus a signed difference that is read from the stream.
    fn moved(&mut self, last: u32) -> Option<u32> {
        self.varint().map(|value| last.wrapping_add(unzigzag(value)))
    }
}

fn unzigzag(value: u32) -> u32 {
    (value >> 1) ^ (value & 1).wrapping_neg()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use base64::Engine as _;
    use meshopt_rs::index::IndexEncodingVersion;
    use meshopt_rs::vertex::VertexEncodingVersion;

    use super::*;

    fn meshopt_extension(mode: &str, count: usize, byte_stride: usize) -> Meshopt {
        let json = format!(
            r#"{{"buffer":0,"byteLength":0,"byteStride":{byte_stride},"count":{count},"mode":"{mode}"}}"#
        );
        serde_json::from_str(&json).unwrap()
    }

    /// Elements of four words that vary like positions, noise, flags and floats.
    fn sample_elements(count: u32) -> Vec<[u32; 4]> {
        let element = |i: u32| {
            let noise = i.wrapping_mul(2_654_435_761) >> (i % 3 * 8);
            [((i * 300) & 0xffff) | ((i * 700) << 16), noise, i % 2, 0x3f80_0000 + i * i * 0x1000]
        };
        (0..count).map(element).collect()
    }

    fn little_endian_bytes(words: &[u32]) -> Vec<u8> {
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    #[test]
    fn vertex_codec_0_round_trips() {
        for count in [1, 15, 16, 17, 40, 90] {
            let elements = sample_elements(count);
            let mut stream = vec![0; 20_000];
            let length = meshopt_rs::vertex::buffer::encode_vertex_buffer(
                &mut stream,
                &elements,
                VertexEncodingVersion::V0,
            );
            let decoded =
                decode(&meshopt_extension("ATTRIBUTES", count as usize, 16), &stream[..length.unwrap()])
                    .unwrap();
            assert_eq!(decoded, little_endian_bytes(elements.as_flattened()), "{count}");
        }
    }

    #[test]
    fn vertex_codec_1_is_decoded() {
        for stream in [STREAM_OF_LEVEL_2, STREAM_OF_LEVEL_3] {
            let stream = base64::engine::general_purpose::STANDARD.decode(stream).unwrap();
            let decoded = decode(&meshopt_extension("ATTRIBUTES", 40, 16), &stream).unwrap();
            assert_eq!(decoded, little_endian_bytes(sample_elements(40).as_flattened()));
        }
    }

    #[test]
    fn triangle_index_codec_round_trips() {
        let grid = |i: u32| [i, i + 1, i + 9, i + 1, i + 10, i + 9];
        let mut indices: Vec<u32> = (0..60).flat_map(grid).collect();
        indices.extend([500, 3, 77, 12, 500, 4]);
        let mut stream = vec![0; 10_000];
        let version = IndexEncodingVersion::V0;
        let length = meshopt_rs::index::buffer::encode_index_buffer(&mut stream, &indices, version).unwrap();
        let stream = &stream[..length];
        let decoded = decode(&meshopt_extension("TRIANGLES", indices.len(), 4), stream).unwrap();
        let read: Vec<u32> = decoded.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect();
        // The codec may rotate the corners of a triangle, but not reverse them.
        for (was, is) in indices.as_chunks::<3>().0.iter().zip(read.as_chunks::<3>().0) {
            assert!((0..3).any(|turn| (0..3).all(|i| was[i] == is[(i + turn) % 3])), "{was:?} {is:?}");
        }
        let short = decode(&meshopt_extension("TRIANGLES", indices.len(), 2), stream).unwrap();
        assert_eq!(short.len() * 2, decoded.len());
        assert!(decode(&meshopt_extension("TRIANGLES", indices.len() + 3, 4), stream).is_err());
    }

    #[test]
    fn index_sequences_are_decoded_from_two_running_values() {
        // 1000, 1001 and 999 from the first running value, 4 from the second, in LEB128.
        let stream = [0xd1, 0xa0, 0x1f, 4, 17, 6, 0, 0, 0, 0];
        let decoded = decode(&meshopt_extension("INDICES", 4, 4), &stream).unwrap();
        assert_eq!(decoded, little_endian_bytes(&[1000, 1001, 4, 999]));
    }

    #[test]
    fn damaged_meshopt_streams_do_not_panic_and_truncated_ones_fail() {
        let stream = base64::engine::general_purpose::STANDARD.decode(STREAM_OF_LEVEL_3).unwrap();
        for mode in ["ATTRIBUTES", "TRIANGLES", "INDICES"] {
            let stride = if mode == "ATTRIBUTES" { 16 } else { 4 };
            for end in 0..stream.len() {
                assert!(decode(&meshopt_extension(mode, 39, stride), &stream[..end]).is_err());
            }
            for (at, head) in
                (0..stream.len() * 8).flat_map(|at| [0xa0, 0xa1, 0xe0, 0xe1, 0xd1].map(|h| (at, h)))
            {
                let mut damaged = stream.clone();
                damaged[0] = head;
                damaged[at / 8] ^= 1 << (at % 8);
                let _ = decode(&meshopt_extension(mode, 39, stride), &damaged);
                let _ = decode(&meshopt_extension(mode, usize::MAX / 16 / 3 * 3, stride), &damaged);
            }
        }
    }

    #[test]
    fn invalid_meshopt_modes_counts_and_strides_are_refused() {
        for (mode, count, stride) in
            [("ATTRIBUTES", 1, 3), ("ATTRIBUTES", 1, 260), ("TRIANGLES", 4, 4), ("X", 3, 4)]
        {
            assert!(decode(&meshopt_extension(mode, count, stride), &[]).is_err());
        }
    }

    const STREAM_OF_LEVEL_2: &str = "oXd/qZ4AWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYFSqqqqqqqqqqqqoAAAB4eHh4eHh4eH\
         h4eHh4eHh4eHh4eHh4eHh4eHh4eHh4eHh4eHh4eHgqBVVVVVVVVVVVVVVVVVVVVVVVVVUAAAAAAPIVtVleIlrQ/PG7\
         Kz1JrngoedOaYB/zxZR/ErcN7ANmO7DYnpuziQBuCmLgdHmr2qw5uy86U/SsFBrffMFt5GQEsXd4SazqHi2hhvYv8B\
         oAw8SzW++YDqUZdlvN3g+AuTozT4TnGNBmgOVN6pv/r09MRQVlIkTmANi2S0yVluHi1NOKbduJPj0LDFVWoaLr7LYA\
         ysl+fTQVJmZmZmZmZmZmZgAAACBgoODfn18fIGCg4N+fXx8gYKDg359fHyBgoODfn18fIGCg4N+fXykAiqrvBAQERE\
         RkZmZmhoiIiKiqAAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AQAAAA==";
    const STREAM_OF_LEVEL_3: &str = "oXd/qToAWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYFSqqqqqqqqqqqqoAAAB4eHh4eHh4eH\
         h4eHh4eHh4eHh4eHh4eHh4eHh4eHh4eHh4eHh4eHgqBVVVVVVVVVVVVVVVVVVVVVVVVVUAAAAAAPIVtVleIlrQ/PG7\
         Kz1JrngoedOaYB/zxZR/ErcN7ANmO7DYnpuziQBuCmLgdHmr2qw5uy86U/SsFBrffMFt5GQEsXd4SazqHi2hhvYv8B\
         oAw8SzW++YDqUZdlvN3g+AuTozT4TnGNBmgOVN6pv/r09MRQVlIkTmANi2S0yVluHi1NOKbduJPj0LDFVWoaLr7LYA\
         ysl+fTQVJmZmZmZmZmZmZgAAAAEFDRkJPRVxETUd6TltJeEhZS35KV31UTHVfclZzUXBQcVN2Un9VRSBEAEDAREABw\
         EAAAAAAAAAAAAAAAAAAAAAAACAPwEAAEI=";
}
