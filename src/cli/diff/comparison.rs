//! [`FileComparison`]: result of comparing one pair of files.

use crate::diff::Diff;

/// Result of comparing one pair of files.
pub(crate) enum FileComparison {
    /// The file exists on both sides.
    Both(Box<Diff>),
    /// The file exists on one side only: 0 before, 1 after.
    Only(usize),
}

impl FileComparison {
    /// Whether the file exists on both sides without differences.
    pub(crate) fn is_same(&self) -> bool {
        matches!(self, Self::Both(diff) if diff.is_same())
    }
}
