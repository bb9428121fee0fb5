//! [`SubdividedPiece`]s of faces during subdivision, and their [`SubdividedSide`]s.

use super::mesh_splice::PieceTriangle;

/// Index of a side that is decided and stays whole.
pub(crate) const CLOSED_SIDE: u32 = u32::MAX;
/// Index of a straight side: it stays whole, and so do new sides next to it, because the surface does not
/// bend along it.
pub(crate) const STRAIGHT_SIDE: u32 = u32::MAX - 1;

/// Whether the side of a piece is still undecided.
#[inline]
pub(crate) fn is_open(side: &u32) -> bool {
    *side < STRAIGHT_SIDE
}

/// Piece of a face that may be cut further.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubdividedPiece {
    pub facet: PieceTriangle,
    /// Indices of the [`SubdividedSide`]s 0-1, 1-2, 2-0; [`CLOSED_SIDE`] or [`STRAIGHT_SIDE`] for sides that stay whole.
    pub sides: [u32; 3],
}

/// State of a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SideState {
    Open,
    Whole,
    /// Split at a smooth vertex. Its halves are two sides; the first is at the smaller end.
    Cut {
        middle: u32,
        halves: u32,
    },
}

/// Side of one piece, or shared by two pieces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubdividedSide {
    /// Smooth vertices at its ends, smaller first.
    pub ends: [u32; 2],
    pub fate: SideState,
}

impl SubdividedSide {
    pub fn open(a: u32, b: u32) -> Self {
        Self { ends: [a.min(b), a.max(b)], fate: SideState::Open }
    }
}

/// Result of cutting some pieces.
#[derive(Default)]
pub(crate) struct SplitPieces {
    /// Pieces that may be cut further.
    pub open: Vec<SubdividedPiece>,
    pub whole: Vec<PieceTriangle>,
    /// New sides inside the pieces.
    pub inner: Vec<SubdividedSide>,
    /// Smooth vertices at the ends of new straight sides.
    pub straight: Vec<[u32; 2]>,
}

impl SubdividedPiece {
    #[inline]
    pub fn turned(mut self, by: usize) -> Self {
        self.facet.corners.rotate_left(by);
        self.facet.marks.rotate_left(by);
        self.sides.rotate_left(by);
        self
    }
}
