//! [`NodeBoxes`]: the boxes of the eight children of a node, by coordinate, so that all are tested at once.

use glam::{Vec3, Vec4};

/// Children of a node.
pub(crate) const NODE_CHILDREN: usize = 8;

/// Bounding box in single precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Box3 {
    pub(crate) low: [f32; 3],
    pub(crate) high: [f32; 3],
}

impl Box3 {
    /// Box that overlaps nothing and adds nothing to a union.
    #[cfg(test)]
    const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Box around the corners of a triangle.
    pub(crate) fn around([a, b, c]: [Vec3; 3]) -> Self {
        Self { low: a.min(b).min(c).to_array(), high: a.max(b).max(c).to_array() }
    }

    /// The box around both.
    pub(crate) fn union(mut self, other: Self) -> Self {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
}

/// Boxes of eight children: lowest and highest x, y and z.
#[derive(Debug, Clone, Copy)]
#[repr(align(16))]
pub(crate) struct NodeBoxes {
    low: [[f32; NODE_CHILDREN]; 3],
    high: [[f32; NODE_CHILDREN]; 3],
}

impl NodeBoxes {
    /// Node with the boxes of at most eight children.
    pub(crate) fn new(boxes: impl Iterator<Item = Box3>) -> Self {
        let (low, high) = ([[f32::INFINITY; NODE_CHILDREN]; 3], [[f32::NEG_INFINITY; NODE_CHILDREN]; 3]);
        let mut node = Self { low, high };
        boxes.enumerate().for_each(|(child, own)| node.put(child, own));
        node
    }

    /// Sets the box of a child.
    pub(crate) fn put(&mut self, child: usize, own: Box3) {
        for axis in 0..3 {
            self.low[axis][child] = own.low[axis];
            self.high[axis][child] = own.high[axis];
        }
    }

    /// Box of a child; empty if there is none.
    #[inline]
    pub(crate) fn child(&self, child: usize) -> Box3 {
        let of = |rows: &[[f32; NODE_CHILDREN]; 3]| [rows[0][child], rows[1][child], rows[2][child]];
        Box3 { low: of(&self.low), high: of(&self.high) }
    }

    /// The box around all children.
    pub(crate) fn around(&self) -> Box3 {
        let low = self.low.map(|row| half(&row, 0).min(half(&row, 1)).min_element());
        Box3 { low, high: self.high.map(|row| half(&row, 0).max(half(&row, 1)).max_element()) }
    }

    /// The children whose boxes overlap a box, one bit each.
    #[inline]
    pub(crate) fn overlapping(&self, other: &Box3) -> u32 {
        let of_axis = |axis: usize, which: usize| {
            let (low, high) = (Vec4::splat(other.low[axis]), Vec4::splat(other.high[axis]));
            half(&self.low[axis], which).cmple(high) & half(&self.high[axis], which).cmpge(low)
        };
        let of_half = |which| (of_axis(0, which) & of_axis(1, which) & of_axis(2, which)).bitmask();
        of_half(0) | of_half(1) << 4
    }
}

/// The first or second four numbers of a row, as a vector.
#[inline]
fn half(row: &[f32; NODE_CHILDREN], which: usize) -> Vec4 {
    Vec4::from_slice(&row[4 * which..4 * which + 4])
}

/// Node of the level above up to eight nodes.
pub(crate) fn union_of(nodes: &[NodeBoxes]) -> NodeBoxes {
    NodeBoxes::new(nodes.iter().map(NodeBoxes::around))
}

/// Numbers of the set bits, ascending.
#[inline]
pub(crate) fn set_bits(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(bit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn node_boxes_overlap_exactly_where_axis_spans_do() {
        let ends = [0.0, 1.0, 2.0, 7.0, 8.0_f32];
        let spans: Vec<[f32; 2]> =
            ends.iter().flat_map(|&a| ends.iter().filter(move |&&b| a <= b).map(move |&b| [a, b])).collect();
        for axis in 0..3 {
            let of_span = |&[low, high]: &[f32; 2]| {
                let mut one = Box3 { low: [5.0; 3], high: [5.0; 3] };
                (one.low[axis], one.high[axis]) = (low, high);
                one
            };
            let boxes: Vec<Box3> = spans.iter().map(of_span).collect();
            for (some, own) in boxes.chunks(5).zip(spans.chunks(5)) {
                let node = NodeBoxes::new(some.iter().copied());
                assert_eq!((0..some.len()).map(|child| node.child(child)).collect::<Vec<_>>(), some);
                assert_eq!((node.child(7), node.around()), (Box3::EMPTY, box_around(some)));
                for (other, &[low, high]) in boxes.iter().zip(&spans) {
                    let met: Vec<usize> = set_bits(node.overlapping(other)).collect();
                    let expected = own.iter().enumerate().filter(|(_, s)| s[0] <= high && low <= s[1]);
                    assert_eq!(met, expected.map(|(child, _)| child).collect::<Vec<_>>());
                    assert!((0..some.len()).all(|child| met.contains(&child) == some[child].overlaps(other)));
                }
            }
        }
    }

    fn box_around(boxes: &[Box3]) -> Box3 {
        boxes.iter().fold(Box3::EMPTY, |sum, one| sum.union(*one))
    }
}
