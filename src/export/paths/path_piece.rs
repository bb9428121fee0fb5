//! Segments of a path with coordinates rounded to the written precision.

/// A point in steps of the written precision. Points are ordered from top to bottom, then from left to right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct PathPoint {
    /// Steps down the page.
    pub y: i64,
    /// Steps to the right.
    pub x: i64,
}

/// Kind of a path segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum PieceKind {
    Line,
    Quad,
    Cubic,
}

/// A path segment. Segments are compared by the fields in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct PathPiece {
    pub from: PathPoint,
    pub to: PathPoint,
    pub kind: PieceKind,
    /// The first control point of a curve.
    pub c1: PathPoint,
    /// The second control point of a cubic curve.
    pub c2: PathPoint,
}

impl PathPiece {
    /// The segment in the opposite direction.
    pub(crate) fn reversed(&self) -> Self {
        let (c1, c2) = if self.kind == PieceKind::Cubic { (self.c2, self.c1) } else { (self.c1, self.c2) };
        Self { from: self.to, to: self.from, kind: self.kind, c1, c2 }
    }

    /// Whether all its points are equal.
    pub(crate) fn has_no_length(&self) -> bool {
        let at = |c: PathPoint| c == self.from;
        self.from == self.to
            && match self.kind {
                PieceKind::Line => true,
                PieceKind::Quad => at(self.c1),
                PieceKind::Cubic => at(self.c1) && at(self.c2),
            }
    }
}
