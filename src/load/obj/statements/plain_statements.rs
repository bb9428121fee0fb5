//! Recognises plain statements: decimal numbers or indices without special notation, the bulk of large files.

use glam::DVec3;

use crate::load::text_cursor::{plain_index, plain_number};

/// Index for "none".
pub(crate) const NO_INDEX: u32 = u32::MAX;

/// Indices of position, texture coordinate and normal of a corner.
pub(crate) type CornerIndices = [u32; 3];

/// Three plain numbers and the end of the line.
#[inline(always)]
pub(crate) fn plain_position(bytes: &[u8], mut at: usize) -> Option<(DVec3, usize)> {
    let mut axes = [0.0; 3];
    for axis in &mut axes {
        while *bytes.get(at)? == b' ' {
            at += 1;
        }
        (*axis, at) = plain_number(bytes, at)?;
        if !matches!(bytes.get(at)?, b' ' | b'\n' | b'\r') {
            return None;
        }
    }
    matches!(bytes.get(at)?, b'\n' | b'\r').then_some((DVec3::from_array(axes), at))
}

/// Three plain indices and the end of the line.
#[inline(always)]
pub(crate) fn plain_triangle(bytes: &[u8], at: usize) -> Option<([u64; 3], usize)> {
    let (a, at) = plain_index(bytes, at)?;
    let (b, at) = plain_index(bytes, at)?;
    let (c, at) = plain_index(bytes, at)?;
    matches!(bytes.get(at)?, b'\n' | b'\r').then_some(([a, b, c], at))
}
