//! [`Record`]: collapses in their order, each with all that is needed to do it and to undo it.

use std::ops::Range;

/// No vertex, no normal, no texture coordinates, no point.
pub(crate) const NONE: u32 = u32::MAX;

/// What a corner of a face is made of: one of the values that meet at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Wedge {
    /// The vertex, in its geometry.
    pub vertex: u32,
    /// The normal, in its geometry.
    pub normal: u32,
    /// The texture coordinates, in their geometry.
    pub uv: u32,
}

/// One collapse: a point falls onto a neighbour. The first may be none, but the faces without area going.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Step {
    /// The point that falls.
    pub from: u32,
    /// The neighbour that it falls onto.
    pub to: u32,
    /// Where its changes and its removed faces end in the lists of all.
    pub changes_end: u32,
    pub removed_end: u32,
}

/// A corner of a face that gets another wedge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Change {
    /// Three times the face, and which of its corners.
    pub corner: u32,
    pub before: u32,
    pub after: u32,
}

/// Collapses in their order, each with all that is needed to do it and to undo it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Record {
    pub steps: Vec<Step>,
    pub changes: Vec<Change>,
    pub removed: Vec<u32>,
    /// What the corners are made of.
    pub wedges: Vec<Wedge>,
    /// The wedges of each face before any step.
    pub faces: Vec<[u32; 3]>,
    /// The faces of each geometry.
    pub ranges: Vec<Range<usize>>,
}

impl Record {
    /// The changes and the removed faces of a step.
    pub fn of_step(&self, step: usize) -> (&[Change], &[u32]) {
        let before = step.checked_sub(1).map(|before| self.steps[before]);
        let (changes, removed) = before.map_or((0, 0), |step| (step.changes_end, step.removed_end));
        let Step { changes_end, removed_end, .. } = self.steps[step];
        (
            &self.changes[changes as usize..changes_end as usize],
            &self.removed[removed as usize..removed_end as usize],
        )
    }
}
