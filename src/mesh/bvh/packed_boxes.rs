//! [`EightBoxes`]: eight boxes on a coarse grid, packed so that a few subtractions compare all of them with
//! another box.
//!
//! Source: L. Lamport, "Multiple byte processing with full-word instructions", CACM 18(8), 1975.

/// Bits of a cell along one axis; the next bit is the guard bit.
pub(crate) const CELL_BITS: u32 = 15;
/// The lowest bit of each field in a word.
const LOWEST_BITS: u64 = 0x0001_0001_0001_0001;
/// The guard bit of each field.
const GUARD_BITS: u64 = LOWEST_BITS << CELL_BITS;
/// Unused outermost cell, so that the empty box overlaps nothing.
pub(crate) const CELL_OUTSIDE: u16 = (1 << CELL_BITS) - 1;
/// Children of a node, and triangles of a leaf.
pub(crate) const BOXES_PER_NODE: usize = 8;

/// Box on the grid: lowest and highest cell along each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct GridBox {
    pub(crate) low: [u16; 3],
    pub(crate) high: [u16; 3],
}

impl GridBox {
    /// Box that overlaps nothing and adds nothing to a union.
    pub(crate) const EMPTY: Self = Self { low: [CELL_OUTSIDE; 3], high: [0; 3] };

    #[inline]
    fn union(mut self, other: Self) -> Self {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self
    }
}

/// Box replicated into every field of a word, for comparison with several boxes at once.
#[derive(Clone, Copy)]
pub(crate) struct ReplicatedBox {
    pub(crate) low: [u64; 3],
    /// Highest cells, with all guard bits set.
    pub(crate) high: [u64; 3],
}

impl From<GridBox> for ReplicatedBox {
    #[inline]
    fn from(one: GridBox) -> Self {
        let mut made = Self { low: [0; 3], high: [0; 3] };
        for axis in 0..3 {
            made.low[axis] = u64::from(one.low[axis]) * LOWEST_BITS;
            made.high[axis] = (u64::from(one.high[axis]) * LOWEST_BITS) | GUARD_BITS;
        }
        made
    }
}

/// Eight boxes: even ones in the first of two words, odd ones in the second.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EightBoxes {
    low: [[u64; 2]; 3],
    /// Highest cells, with all guard bits set.
    high: [[u64; 2]; 3],
}

impl EightBoxes {
    pub(crate) fn new(boxes: &[GridBox]) -> Self {
        let mut eight = Self { low: [[0; 2]; 3], high: [[GUARD_BITS; 2]; 3] };
        for place in 0..BOXES_PER_NODE {
            let one = boxes.get(place).copied().unwrap_or(GridBox::EMPTY);
            let (word, shift) = (place & 1, 16 * (place >> 1));
            for axis in 0..3 {
                eight.low[axis][word] |= u64::from(one.low[axis]) << shift;
                eight.high[axis][word] |= u64::from(one.high[axis]) << shift;
            }
        }
        eight
    }

    #[inline]
    pub(crate) fn get(&self, place: usize) -> GridBox {
        let (word, shift) = (place & 1, 16 * (place >> 1));
        let mut one = GridBox::EMPTY;
        for axis in 0..3 {
            one.low[axis] = (self.low[axis][word] >> shift) as u16 & CELL_OUTSIDE;
            one.high[axis] = (self.high[axis][word] >> shift) as u16 & CELL_OUTSIDE;
        }
        one
    }

    pub(crate) fn union(&self) -> GridBox {
        (0..BOXES_PER_NODE).fold(GridBox::EMPTY, |sum, place| sum.union(self.get(place)))
    }

    /// The boxes that overlap another box.
    #[inline]
    pub(crate) fn overlapping(&self, other: &ReplicatedBox) -> ChildMask {
        let mut both = [GUARD_BITS; 2];
        for axis in 0..3 {
            for (word, both) in both.iter_mut().enumerate() {
                // A guard bit survives where the cell of `high` is at least that of `low`.
                *both &=
                    (other.high[axis] - self.low[axis][word]) & (self.high[axis][word] - other.low[axis]);
            }
        }
        ChildMask(both[0] >> CELL_BITS | both[1] >> (CELL_BITS - 1))
    }
}

/// Subset of eight positions, iterated in ascending order: two bits at the bottom of each field.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct ChildMask(pub(crate) u64);

impl ChildMask {
    /// The positions from `place` on.
    #[inline]
    pub(crate) fn from(self, place: usize) -> Self {
        if place >= BOXES_PER_NODE { Self(0) } else { Self(self.0 & (u64::MAX << Self::bit(place))) }
    }

    #[inline]
    fn bit(place: usize) -> usize {
        16 * (place >> 1) + (place & 1)
    }
}

impl Iterator for ChildMask {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let bit = self.0.trailing_zeros() as usize;
        self.0 &= self.0 - 1;
        Some(2 * (bit / 16) + bit % 16)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_boxes_overlap_exactly_where_axis_spans_do() {
        let cells = [0, 1, 2, CELL_OUTSIDE - 2, CELL_OUTSIDE - 1];
        let spans: Vec<[u16; 2]> = cells
            .iter()
            .flat_map(|&a| cells.iter().filter(move |&&b| a <= b).map(move |&b| [a, b]))
            .collect();
        for axis in 0..3 {
            let of_span = |&[low, high]: &[u16; 2]| {
                let mut one = GridBox { low: [5; 3], high: [5; 3] };
                (one.low[axis], one.high[axis]) = (low, high);
                one
            };
            let boxes: Vec<GridBox> = spans.iter().map(of_span).collect();
            for (some, own) in boxes.chunks(5).zip(spans.chunks(5)) {
                let eight = EightBoxes::new(some);
                assert_eq!((0..some.len()).map(|place| eight.get(place)).collect::<Vec<_>>(), some);
                assert_eq!(eight.get(7), GridBox::EMPTY);
                for (other, &[low, high]) in boxes.iter().zip(&spans) {
                    let met: Vec<usize> = eight.overlapping(&ReplicatedBox::from(*other)).collect();
                    let expected = own.iter().enumerate().filter(|(_, s)| s[0] <= high && low <= s[1]);
                    assert_eq!(met, expected.map(|(place, _)| place).collect::<Vec<_>>());
                    let from = eight.overlapping(&ReplicatedBox::from(*other)).from(2);
                    assert_eq!(
                        from.collect::<Vec<_>>(),
                        met.iter().copied().filter(|p| *p >= 2).collect::<Vec<_>>()
                    );
                }
            }
        }
    }
}
