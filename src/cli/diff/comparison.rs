//! [`Told`]: what became of one drawing.

use crate::diff::Diff;

/// What became of one drawing.
pub(crate) enum Told {
    /// It is in both.
    Both(Box<Diff>),
    /// It is in one folder only, the first or the second.
    Only(usize),
}

impl Told {
    /// Whether it is in both, and the same.
    pub(crate) fn is_same(&self) -> bool {
        matches!(self, Self::Both(diff) if diff.is_same())
    }
}
