//! [`RemovedLine`]: lines that tidying dropped, and why. Recorded on request only.

use kurbo::Point;

use super::raw_line::{RawLine, VertexDegrees};
use crate::lines::LineKind;
use crate::surface::MeshSource;

/// Why a line was dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum RemovalReason {
    /// Short and isolated.
    Crumb,
    /// Short, with one dangling end.
    Spur,
    /// Overhang of a line past the point where it is stitched to another.
    Stub,
    /// A small ring.
    Loop,
    /// Runs next to a longer line.
    Double,
    /// Crease of a scan that may be noise.
    Noise,
    /// Interior line that is too short for its strength.
    Weak,
    /// Shorter than a dot of the pen.
    Point,
}

impl RemovalReason {
    /// Class name in SVG.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Crumb => "crumb",
            Self::Spur => "spur",
            Self::Stub => "stub",
            Self::Loop => "loop",
            Self::Double => "double",
            Self::Noise => "noise",
            Self::Weak => "weak",
            Self::Point => "point",
        }
    }

    /// Reason for a line that was found to be too short.
    pub(crate) fn of_short_line(raw: &RawLine, degrees: &VertexDegrees) -> Self {
        let ends = [0, 1].map(|side| raw.covered[side] || degrees.is_free(raw.ends[side]));
        match raw.class.kind {
            kind if kind.is_inside() => Self::Weak,
            LineKind::Crease if raw.class.origin == MeshSource::Scanned => Self::Noise,
            _ if raw.is_ring() => Self::Loop,
            _ if ends[0] && ends[1] => Self::Crumb,
            _ => Self::Spur,
        }
    }
}

/// A dropped line, or a dropped part of one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RemovedLine {
    /// Points in user units of the page.
    pub points: Vec<Point>,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// Kind of line.
    pub kind: LineKind,
    /// Why it was dropped.
    pub reason: RemovalReason,
}

/// Log of dropped lines. Records nothing unless created by [`RemovalLog::recording`].
#[derive(Debug, Default)]
pub(crate) struct RemovalLog(Option<Vec<RemovedLine>>);

impl RemovalLog {
    /// A log that records lines.
    pub(crate) fn recording() -> Self {
        Self(Some(Vec::new()))
    }

    /// Records a whole line.
    pub(crate) fn record(&mut self, raw: &RawLine, reason: impl FnOnce() -> RemovalReason) {
        if let Some(kept) = &mut self.0 {
            let (points, closed) = (raw.line.points.clone(), raw.line.closed);
            kept.push(RemovedLine { points, closed, kind: raw.class.kind, reason: reason() });
        }
    }

    /// Records a part of a line.
    pub(crate) fn record_part(
        &mut self,
        raw: &RawLine,
        reason: RemovalReason,
        points: impl FnOnce() -> Vec<Point>,
    ) {
        if let Some(kept) = &mut self.0 {
            kept.push(RemovedLine { points: points(), closed: false, kind: raw.class.kind, reason });
        }
    }

    /// Records a single edge that became part of no line.
    pub(crate) fn record_piece(&mut self, kind: LineKind, reason: RemovalReason, ends: [Point; 2]) {
        if let Some(kept) = &mut self.0 {
            kept.push(RemovedLine { points: ends.to_vec(), closed: false, kind, reason });
        }
    }

    /// All records, in order.
    pub(crate) fn into_removed(self) -> Vec<RemovedLine> {
        self.0.unwrap_or_default()
    }
}
