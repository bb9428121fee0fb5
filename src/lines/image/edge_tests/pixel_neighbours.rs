//! Pixel neighbourhood: the 3 × 3 pixels around a position of a map.

use crate::view::raster::{NO_FRONT, NormalDepthMaps};

/// Indices row by row; the pixel itself is the fifth. Outside the image the nearest pixel is used.
pub(crate) type PixelNeighbours = [usize; 9];

/// The 3 × 3 pixels around one.
#[inline]
pub(crate) fn around(columns: usize, rows: usize, column: usize, row: usize) -> PixelNeighbours {
    let lines = [row.saturating_sub(1), row, (row + 1).min(rows - 1)].map(|row| row * columns);
    let across = [column.saturating_sub(1), column, (column + 1).min(columns - 1)];
    let mut at = [0; 9];
    for (i, line) in lines.into_iter().enumerate() {
        for (j, column) in across.into_iter().enumerate() {
            at[3 * i + j] = line + column;
        }
    }
    at
}

impl NormalDepthMaps {
    /// Whether none of the pixels shows a face.
    #[inline]
    pub(crate) fn is_bare(&self, at: &PixelNeighbours) -> bool {
        at.iter().all(|pixel| self.faces[*pixel] == NO_FRONT)
    }
}
