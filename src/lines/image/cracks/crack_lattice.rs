//! [`CrackLattice`]: lines along the cracks between pixels, from corner to corner.

use crate::parallel::prelude::*;

use super::crest_test::is_crest;
use super::jump_tiles::JumpTiles;

/// Directions from a corner: right, down, left, up.
pub(crate) const CRACK_DIRECTIONS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// Corners that are skipped at once where no line runs.
const CORNERS_PER_BLOCK: usize = 64;

/// Corners of pixels, and the cracks between pixels that carry lines.
pub(crate) struct CrackLattice {
    /// Corners per row: one more than pixels.
    pub stride: usize,
    /// Number of rows of corners.
    pub height: usize,
    /// Flags per corner: a line runs right (1), down (2).
    flags: Vec<u8>,
}

/// One side of a pixel, as a corner and a direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Crack {
    pub corner: usize,
    pub direction: usize,
}

impl CrackLattice {
    /// Cracks whose jump is a local maximum and no echo.
    pub(crate) fn local_maxima(jumps: &JumpTiles) -> Self {
        let (columns, rows) = (jumps.columns, jumps.rows);
        let stride = columns + 1;
        let mut lattice = Self { stride, height: rows + 1, flags: vec![0; stride * (rows + 1)] };
        let of_row = lattice.flags.par_chunks_mut(stride).zip(&jumps.with_jumps).enumerate();
        of_row.for_each(|(row, (flags, with_jumps))| {
            for column in with_jumps.iter().map(|column| *column as usize) {
                let down = is_crest(|column| jumps.across(column, row), column, columns);
                let right = is_crest(|row| jumps.down(column, row), row, rows);
                flags[column] = 2 * u8::from(down) + u8::from(right);
            }
        });
        lattice
    }

    /// Number of corners.
    pub(crate) fn len(&self) -> usize {
        self.flags.len()
    }

    /// Corners on lines, ascending.
    pub(crate) fn corners(&self) -> Vec<usize> {
        let stride = self.stride;
        let none = vec![0; stride];
        let any = |flags: &[u8]| flags.iter().fold(0, |any, flag| any | flag);
        let in_row = |row: usize| {
            let own = &self.flags[row * stride..(row + 1) * stride];
            let above = row.checked_sub(1).map_or(&*none, |above| &self.flags[above * stride..row * stride]);
            let mut found = Vec::new();
            for first in (0..stride).step_by(CORNERS_PER_BLOCK) {
                let run = first..(first + CORNERS_PER_BLOCK).min(stride);
                // The corner before the run holds the flag of the crack to its first corner.
                let any = any(&own[first.saturating_sub(1)..run.end]) | any(&above[run.clone()]);
                if any != 0 {
                    let is_on = |column: &usize| {
                        let from_left = *column > 0 && own[*column - 1] & 1 != 0;
                        own[*column] != 0 || from_left || above[*column] & 2 != 0
                    };
                    found.extend(run.filter(is_on).map(|column| row * stride + column));
                }
            }
            found
        };
        (0..self.height).into_par_iter().with_min_len(64).flat_map_iter(in_row).collect()
    }

    /// Column and row of a corner.
    #[inline]
    pub(crate) fn place(&self, corner: usize) -> [usize; 2] {
        [corner % self.stride, corner / self.stride]
    }

    /// Corner at the other end of a crack; none outside the image.
    #[inline]
    pub(crate) fn end(&self, crack: Crack) -> Option<usize> {
        let [column, row] = self.place(crack.corner);
        let [dx, dy] = CRACK_DIRECTIONS[crack.direction];
        let (column, row) = (column as i32 + dx, row as i32 + dy);
        let inside = column >= 0 && row >= 0 && column < self.stride as i32 && row < self.height as i32;
        inside.then(|| row as usize * self.stride + column as usize)
    }

    /// Index and bit of a crack's flag.
    #[inline]
    fn flag(&self, crack: Crack) -> Option<(usize, u8)> {
        let end = self.end(crack)?;
        Some((crack.corner.min(end), if crack.direction.is_multiple_of(2) { 1 } else { 2 }))
    }

    /// Whether a line runs along a crack.
    #[inline]
    pub(crate) fn has(&self, crack: Crack) -> bool {
        self.flag(crack).is_some_and(|(corner, flag)| self.flags[corner] & flag != 0)
    }

    pub(crate) fn put(&mut self, crack: Crack, on: bool) {
        if let Some((corner, flag)) = self.flag(crack) {
            if on {
                self.flags[corner] |= flag;
            } else {
                self.flags[corner] &= !flag;
            }
        }
    }

    /// Cracks with a line at a corner.
    pub(crate) fn leaving(&self, corner: usize) -> impl Iterator<Item = Crack> + '_ {
        (0..4).map(move |way| Crack { corner, direction: way }).filter(|crack| self.has(*crack))
    }

    /// Number of cracks with a line at a corner.
    pub(crate) fn degree(&self, corner: usize) -> usize {
        self.leaving(corner).count()
    }

    /// Columns and rows of the pixels on the left and right of a crack, seen along its direction, with rows
    /// running down.
    pub(crate) fn pixels(&self, crack: Crack) -> [[i32; 2]; 2] {
        let [column, row] = self.place(crack.corner).map(|i| i as i32);
        match crack.direction {
            0 => [[column, row - 1], [column, row]],
            1 => [[column, row], [column - 1, row]],
            2 => [[column - 1, row], [column - 1, row - 1]],
            _ => [[column - 1, row - 1], [column, row - 1]],
        }
    }

    /// Jump across a crack.
    pub(crate) fn jump(&self, jumps: &JumpTiles, crack: Crack) -> f32 {
        let Some((corner, flag)) = self.flag(crack) else { return 0.0 };
        let [column, row] = self.place(corner);
        if column >= jumps.columns || row >= jumps.rows {
            return 0.0;
        }
        if flag == 1 { jumps.down(column, row) } else { jumps.across(column, row) }
    }
}
