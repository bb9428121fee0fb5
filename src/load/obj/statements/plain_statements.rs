//! Recognises plain statements: decimal numbers or indices without special notation, the bulk of large files.

use glam::DVec3;

use crate::load::text_cursor::{plain_digits, plain_index, plain_number};

/// Index for "none".
pub(crate) const NO_INDEX: u32 = u32::MAX;

/// Indices of position, texture coordinate and normal of a corner.
pub(crate) type CornerIndices = [u32; 3];

/// Fourth corner of a face with three corners.
pub(crate) const NO_CORNER: CornerIndices = [NO_INDEX; 3];

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

/// Three or four corners with short indices, and the end of the line. Gives the same result as the parser.
pub(crate) fn plain_face(bytes: &[u8], mut at: usize) -> Option<([CornerIndices; 4], usize)> {
    let mut corners = [NO_CORNER; 4];
    let mut count = 0;
    loop {
        while *bytes.get(at)? == b' ' {
            at += 1;
        }
        if matches!(bytes.get(at)?, b'\n' | b'\r') {
            return (count > 2).then_some((corners, at));
        }
        let corner = corners.get_mut(count)?;
        for (k, index) in corner.iter_mut().enumerate() {
            let (value, end) = plain_digits(bytes, at);
            // Indices of texture coordinates and normals may be missing or 0.
            let digits = end - at;
            if digits > 9 || (k == 0 && value == 0) {
                return None;
            }
            *index = (value as u32).wrapping_sub(1);
            at = end;
            if k == 2 || bytes.get(at) != Some(&b'/') {
                break;
            }
            at += 1;
        }
        if !matches!(bytes.get(at)?, b' ' | b'\n' | b'\r') {
            return None;
        }
        count += 1;
    }
}
