//! [`Piece`]s of faces that are being cut, and their [`Side`]s.

use super::mesh_splice::Facet;

/// The side of a piece was decided about, and stays.
pub(crate) const CLOSED: u32 = u32::MAX;
/// It stays, and so does all that is cut beside it: the surface does not bend along it.
pub(crate) const STRAIGHT: u32 = u32::MAX - 1;

/// Whether the side of a piece is not decided about yet.
#[inline]
pub(crate) fn is_open(side: &u32) -> bool {
    *side < STRAIGHT
}

/// A piece of a face, which may be cut further.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    pub facet: Facet,
    /// Which [`Side`]s the sides 0-1, 1-2, 2-0 are; [`CLOSED`] or [`STRAIGHT`] where they are not cut any more.
    pub sides: [u32; 3],
}

/// What becomes of the side of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fate {
    Open,
    Whole,
    /// It is cut by a smooth vertex; its halves are two sides, the first the one at the smaller end.
    Cut {
        middle: u32,
        halves: u32,
    },
}

/// The side of a piece, or of the two that share it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Side {
    /// The smooth vertices at its ends, the smaller first.
    pub ends: [u32; 2],
    pub fate: Fate,
}

impl Side {
    pub fn open(a: u32, b: u32) -> Self {
        Self { ends: [a.min(b), a.max(b)], fate: Fate::Open }
    }
}

/// What some pieces are cut into.
#[derive(Default)]
pub(crate) struct Parted {
    /// What may be cut further.
    pub open: Vec<Piece>,
    pub whole: Vec<Facet>,
    /// The sides that are new inside the pieces.
    pub inner: Vec<Side>,
    /// The smooth vertices at the ends of those of them that are straight.
    pub straight: Vec<[u32; 2]>,
}

impl Piece {
    #[inline]
    pub fn turned(mut self, by: usize) -> Self {
        self.facet.corners.rotate_left(by);
        self.facet.marks.rotate_left(by);
        self.sides.rotate_left(by);
        self
    }
}
