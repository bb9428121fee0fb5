//! [`FineBox`]: bounding box of a triangle on a fine grid, packed so that a few subtractions compare two
//! boxes.

use super::packed_boxes::{CELL_BITS, CELL_OUTSIDE, GridBox};
use crate::mesh::order::morton_curve::spread;

/// Bits of a fine cell along one axis; the next bit is a guard bit.
const BITS_PER_FINE_CELL: u32 = 20;
/// Distance between the three fields of a word, in bits.
pub(crate) const BITS_PER_FIELD: u32 = BITS_PER_FINE_CELL + 1;
/// The guard bit of each field.
const FIELD_GUARD_BITS: u64 = (1 | 1 << BITS_PER_FIELD | 1 << (2 * BITS_PER_FIELD)) << BITS_PER_FINE_CELL;
/// The last fine cell.
pub(crate) const LAST_FINE_CELL: u32 = (1 << BITS_PER_FINE_CELL) - 2;

/// Bounding box on the fine grid: packed lowest and highest cell along each axis. All guard bits of `high`
/// are set.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FineBox {
    low: u64,
    high: u64,
}

impl FineBox {
    #[inline]
    pub(crate) fn of_cells([a, b, c]: [u64; 3]) -> Self {
        Self { low: lesser(lesser(a, b), c), high: greater(greater(a, b), c) | FIELD_GUARD_BITS }
    }

    /// The box around both.
    #[inline]
    pub(crate) fn union(self, other: Self) -> Self {
        let high = greater(self.high & !FIELD_GUARD_BITS, other.high & !FIELD_GUARD_BITS);
        Self { low: lesser(self.low, other.low), high: high | FIELD_GUARD_BITS }
    }

    #[inline]
    pub(crate) fn overlaps(self, other: Self) -> bool {
        // A guard bit survives where the cell of `high` is at least that of `low`.
        (self.high - other.low) & (other.high - self.low) & FIELD_GUARD_BITS == FIELD_GUARD_BITS
    }

    /// The enclosing box on the coarse grid.
    #[inline]
    pub(crate) fn coarse(self) -> GridBox {
        let mut made = GridBox::EMPTY;
        for axis in 0..3 {
            let cell = |cells: u64| {
                let fine = (cells >> (axis as u32 * BITS_PER_FIELD)) as u32 & ((1 << BITS_PER_FINE_CELL) - 1);
                ((fine >> (BITS_PER_FINE_CELL - CELL_BITS)) as u16).min(CELL_OUTSIDE - 1)
            };
            made.low[axis] = cell(self.low);
            made.high[axis] = cell(self.high);
        }
        made
    }

    /// Position of the centre along the Morton curve, 30 bits.
    #[inline]
    pub(crate) fn curve_key(self) -> u32 {
        // The sum of two cells may reach the guard bit, but never the next field.
        let twice_centre = self.low + (self.high & !FIELD_GUARD_BITS);
        let axis = |n: u32| {
            let top = (twice_centre >> (n * BITS_PER_FIELD + BITS_PER_FIELD - 10)) as u32 & 0x3ff;
            (spread(u64::from(top)) as u32) << n
        };
        axis(0) | axis(1) | axis(2)
    }
}

/// All value bits of the fields where the cell of `a` is at least that of `b`.
#[inline]
fn not_less_mask(a: u64, b: u64) -> u64 {
    let spare = ((a | FIELD_GUARD_BITS) - b) & FIELD_GUARD_BITS;
    spare - (spare >> BITS_PER_FINE_CELL)
}

#[inline]
fn greater(a: u64, b: u64) -> u64 {
    let mask = not_less_mask(a, b);
    (a & mask) | (b & !mask)
}

#[inline]
fn lesser(a: u64, b: u64) -> u64 {
    let mask = not_less_mask(a, b);
    (b & mask) | (a & !mask)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pack([x, y, z]: [u64; 3]) -> u64 {
        x | y << BITS_PER_FIELD | z << (2 * BITS_PER_FIELD)
    }

    #[test]
    fn fine_boxes_overlap_exactly_where_axis_spans_do() {
        let cells = [0, 1, 2, u64::from(LAST_FINE_CELL) - 1, u64::from(LAST_FINE_CELL)];
        let spans: Vec<[u64; 2]> = cells
            .iter()
            .flat_map(|&a| cells.iter().filter(move |&&b| a <= b).map(move |&b| [a, b]))
            .collect();
        for &[a0, a1] in &spans {
            for &[b0, b1] in &spans {
                for axis in 0..3 {
                    let place = |cell| {
                        let mut triple = [5; 3];
                        triple[axis] = cell;
                        pack(triple)
                    };
                    let a = FineBox::of_cells([place(a0), place(a1), place(a0)]);
                    let b = FineBox::of_cells([place(b1), place(b0), place(b0)]);
                    assert_eq!(a.overlaps(b), a0 <= b1 && b0 <= a1);
                    assert_eq!((a.low, a.high), (place(a0), place(a1) | FIELD_GUARD_BITS));
                    let cell = |cell: u64| ((cell >> 5) as u16).min(CELL_OUTSIDE - 1);
                    assert_eq!((a.coarse().low[axis], a.coarse().high[axis]), (cell(a0), cell(a1)));
                }
            }
        }
    }
}
