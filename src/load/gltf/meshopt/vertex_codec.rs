//! Vertex codec: blocks of up to 256 elements, stored by byte columns, as differences.

use super::ByteCursor;

/// Elements of a group with a common bit width.
const GROUP_ELEMENTS: usize = 16;
/// Maximum elements of a block.
const BLOCK_ELEMENTS: usize = 256;

/// Decodes `count` elements of `stride` bytes, a multiple of 4 up to 256.
///
/// Memory grows with the decoded data, not with the announced count.
pub(crate) fn decode(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let mut data = ByteCursor(bytes);
    let version = match data.byte()? {
        0xa0 => 0,
        0xa1 => 1,
        _ => return None,
    };
    let tail = if version == 0 { stride } else { stride + stride / 4 };
    let padded = tail.max(if version == 0 { 32 } else { 24 });
    let tail = data.tail(padded)?.get(padded - tail..)?;
    let (first, channels) = tail.split_at_checked(stride)?;
    let mut last = first.to_vec();

    let per_block = ((8192 / stride) & !(GROUP_ELEMENTS - 1)).min(BLOCK_ELEMENTS);
    let mut decoded = Vec::new();
    let mut left = count;
    while left > 0 {
        let size = left.min(per_block);
        let start = decoded.len();
        decoded.resize(start + size * stride, 0);
        let block = decoded.get_mut(start..)?;
        let controls = if version == 0 { &[][..] } else { data.take(stride / 4)? };
        for word in 0..stride / 4 {
            let mut columns = [[0; BLOCK_ELEMENTS]; 4];
            for (byte, column) in columns.iter_mut().enumerate() {
                let control = controls.get(word).map(|control| control >> (2 * byte) & 3);
                read_column(&mut data, control, column.get_mut(..size)?)?;
            }
            let channel = channels.get(word).copied().unwrap_or(0);
            let before: &mut [u8; 4] = last.get_mut(4 * word..)?.first_chunk_mut()?;
            let elements =
                block.chunks_exact_mut(stride).filter_map(|e| e.get_mut(4 * word..)?.first_chunk_mut());
            add_differences(&columns, channel, before, elements)?;
        }
        left -= size;
    }
    data.0.is_empty().then_some(decoded)
}

/// Reads one byte of each element of a block, still as differences. `control` is the mode of the column in
/// version 1.
fn read_column(data: &mut ByteCursor, control: Option<u8>, column: &mut [u8]) -> Option<()> {
    let widths = match control {
        None => [0, 2, 4, 8],
        Some(0) => [0, 1, 2, 4],
        Some(1) => [1, 2, 4, 8],
        Some(2) => return Some(()),
        Some(_) => {
            column.copy_from_slice(data.take(column.len())?);
            return Some(());
        }
    };
    let header = data.take(column.len().div_ceil(GROUP_ELEMENTS).div_ceil(4))?;
    for (number, group) in column.chunks_mut(GROUP_ELEMENTS).enumerate() {
        let choice = header.get(number / 4)? >> (number % 4 * 2) & 3;
        let width = *widths.get(usize::from(choice))?;
        read_group(data, width, group)?;
    }
    Some(())
}

/// Reads sixteen differences of `width` bits; the maximum value is an escape for a full byte that follows.
fn read_group(data: &mut ByteCursor, width: usize, group: &mut [u8]) -> Option<()> {
    let packed = data.take(GROUP_ELEMENTS * width / 8)?;
    match width {
        0 => group.fill(0),
        8 => group.copy_from_slice(packed.get(..group.len())?),
        _ => {
            let escape = (1_u8 << width) - 1;
            for i in 0..GROUP_ELEMENTS {
                let bit = i * width;
                // Single bits are stored from the low end of a byte, wider values from the high end.
                let shift = if width == 1 { bit % 8 } else { 8 - width - bit % 8 };
                let mut value = packed.get(bit / 8)? >> shift & escape;
                if value == escape {
                    value = data.byte()?;
                }
                // The last group of a block may be longer than the rest of the block.
                if let Some(slot) = group.get_mut(i) {
                    *slot = value;
                }
            }
        }
    }
    Some(())
}

/// Sums the differences of four byte columns, as bytes, as 16-bit numbers or by exclusive or.
fn add_differences<'a>(
    columns: &[[u8; BLOCK_ELEMENTS]; 4],
    channel: u8,
    before: &mut [u8; 4],
    elements: impl Iterator<Item = &'a mut [u8; 4]>,
) -> Option<()> {
    let [c0, c1, c2, c3] = columns;
    let differences = c0.iter().zip(c1).zip(c2).zip(c3).map(|(((a, b), c), d)| [*a, *b, *c, *d]);
    let mut last = *before;
    for (element, difference) in elements.zip(differences) {
        last = match channel & 3 {
            0 => {
                let sum =
                    |i: usize| last[i].wrapping_add(difference[i] >> 1 ^ (difference[i] & 1).wrapping_neg());
                [sum(0), sum(1), sum(2), sum(3)]
            }
            1 => {
                let sum = |low: usize| {
                    let moved = u16::from_le_bytes([difference[low], difference[low + 1]]);
                    let old = u16::from_le_bytes([last[low], last[low + 1]]);
                    old.wrapping_add(moved >> 1 ^ (moved & 1).wrapping_neg()).to_le_bytes()
                };
                let ([a, b], [c, d]) = (sum(0), sum(2));
                [a, b, c, d]
            }
            2 => {
                let turned = u32::from_le_bytes(difference).rotate_right(u32::from(channel >> 4));
                (turned ^ u32::from_le_bytes(last)).to_le_bytes()
            }
            _ => return None,
        };
        *element = last;
    }
    *before = last;
    Some(())
}
