//! Data of the subdivision of curved faces while it runs: triangular pieces of faces, and the sides they
//! share.
//!
//! Pieces are cut in rounds. In each round, every undecided side is split at its middle or kept whole, and
//! each piece is cut by the pattern of its split sides. Neighbours share a side, so they agree and no cracks
//! open.

use super::mesh_splice::PieceTriangle;

/// Index in [`SubdividedPiece::sides`] for a side that is decided and stays whole.
pub(crate) const CLOSED_SIDE: u32 = u32::MAX;
/// Index for a straight side: the surface does not bend along it, so it stays whole, and so do the new sides
/// inside its piece.
pub(crate) const STRAIGHT_SIDE: u32 = u32::MAX - 1;

/// Whether an entry of [`SubdividedPiece::sides`] refers to a side that may be split.
#[inline]
pub(crate) fn is_open(side: &u32) -> bool {
    *side < STRAIGHT_SIDE
}

/// Triangular piece of a face that may be cut further.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubdividedPiece {
    pub facet: PieceTriangle,
    /// Indices of the [`SubdividedSide`]s 0-1, 1-2, 2-0; [`CLOSED_SIDE`] or [`STRAIGHT_SIDE`] for sides that
    /// stay whole.
    pub sides: [u32; 3],
}

/// Decision on a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SideState {
    /// Not decided yet.
    Open,
    /// Not split.
    Whole,
    /// Split into two halves.
    Cut {
        /// The smooth vertex at the middle.
        middle: u32,
        /// Index of the half at the smaller end; the other half follows it.
        halves: u32,
    },
}

/// Side of a piece, shared with the neighbouring piece if there is one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubdividedSide {
    /// Indices of the smooth vertices (position and normal) at its ends, smaller first.
    pub ends: [u32; 2],
    pub state: SideState,
}

impl SubdividedSide {
    /// An undecided side between two smooth vertices.
    pub(crate) fn open(a: u32, b: u32) -> Self {
        Self { ends: [a.min(b), a.max(b)], state: SideState::Open }
    }
}

/// Result of cutting a batch of pieces.
#[derive(Default)]
pub(crate) struct SplitPieces {
    /// Pieces that may be cut further.
    pub open: Vec<SubdividedPiece>,
    /// Finished pieces.
    pub finished: Vec<PieceTriangle>,
    /// New sides inside the pieces.
    pub inner: Vec<SubdividedSide>,
    /// Smooth vertices at the ends of new straight sides.
    pub straight: Vec<[u32; 2]>,
}

impl SubdividedPiece {
    /// The same piece with its corners rotated, so that corner `by` comes first.
    #[inline]
    pub(crate) fn rotated(mut self, by: usize) -> Self {
        self.facet.corners.rotate_left(by);
        self.facet.marks.rotate_left(by);
        self.sides.rotate_left(by);
        self
    }
}
