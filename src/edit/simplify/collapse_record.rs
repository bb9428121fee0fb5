//! [`CollapseRecord`]: collapses in their order, with everything needed to apply and undo them.

use std::ops::Range;

/// Index for "none": no vertex, normal, texture coordinates or point.
pub(crate) const NO_INDEX: u32 = u32::MAX;

/// Attributes of a face corner. Several wedges may share a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Wedge {
    /// Vertex in its geometry.
    pub vertex: u32,
    /// Normal in its geometry.
    pub normal: u32,
    /// Texture coordinates in their geometry.
    pub uv: u32,
}

/// One collapse. The first step may instead remove degenerate faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Collapse {
    /// Point that is removed.
    pub from: u32,
    /// Neighbour onto which it collapses.
    pub to: u32,
    /// Ends of the step's changes and removed faces in the common lists.
    pub changes_end: u32,
    pub removed_end: u32,
}

/// A face corner that gets another wedge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct WedgeChange {
    /// Three times the face, plus the corner (0 to 2).
    pub corner: u32,
    pub before: u32,
    pub after: u32,
}

/// Collapses in their order, with everything needed to apply and undo them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct CollapseRecord {
    pub steps: Vec<Collapse>,
    pub changes: Vec<WedgeChange>,
    pub removed: Vec<u32>,
    /// Attributes of the corners.
    pub wedges: Vec<Wedge>,
    /// Wedges of each face before the first step.
    pub faces: Vec<[u32; 3]>,
    /// Faces of each geometry.
    pub ranges: Vec<Range<usize>>,
}

impl CollapseRecord {
    /// Changes and removed faces of a step.
    pub(crate) fn of_step(&self, step: usize) -> (&[WedgeChange], &[u32]) {
        let before = step.checked_sub(1).map(|before| self.steps[before]);
        let (changes, removed) = before.map_or((0, 0), |step| (step.changes_end, step.removed_end));
        let Collapse { changes_end, removed_end, .. } = self.steps[step];
        (
            &self.changes[changes as usize..changes_end as usize],
            &self.removed[removed as usize..removed_end as usize],
        )
    }
}
