//! [`PathPiece`]: a piece of a path, rounded to steps of the written precision.

/// A point in steps of the written precision; of two the upper one is less, and of those as high the left one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Step {
    /// Down the page.
    pub y: i64,
    /// To the right.
    pub x: i64,
}

/// What a piece of a path is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    Line,
    Quad,
    Cubic,
}

/// A piece of a path. The order of its fields is that in which pieces are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct PathPiece {
    pub from: Step,
    pub to: Step,
    pub kind: Kind,
    /// The first control point of a curve.
    pub c1: Step,
    /// The second control point of a cubic curve.
    pub c2: Step,
}

impl PathPiece {
    /// The piece run through from its end.
    pub fn reversed(&self) -> Self {
        let (c1, c2) = if self.kind == Kind::Cubic { (self.c2, self.c1) } else { (self.c1, self.c2) };
        Self { from: self.to, to: self.from, kind: self.kind, c1, c2 }
    }

    /// Whether it begins and ends in one point and has no control point elsewhere.
    pub fn has_no_length(&self) -> bool {
        let at = |c: Step| c == self.from;
        self.from == self.to
            && match self.kind {
                Kind::Line => true,
                Kind::Quad => at(self.c1),
                Kind::Cubic => at(self.c1) && at(self.c2),
            }
    }
}
