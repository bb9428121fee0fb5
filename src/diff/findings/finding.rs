//! Result of a comparison: one [`Finding`] for each changed mark.

use std::sync::Arc;

use kurbo::{BezPath, Rect};
use serde::Serialize;

use super::ink_totals::Totals;
use super::pixel_count::PixelDiff;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};

/// How a mark changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Exists only in the first drawing.
    Removed,
    /// Exists only in the second drawing.
    Added,
    /// Has another form: another length, another bend, one hole less.
    Reshaped,
    /// Moved as a whole.
    Moved,
    /// Has the same place but another paint.
    Restyled,
    /// Is painted before or after a mark that overlaps it, in the opposite order.
    Restacked,
    /// Looks the same but has another part, class or layer.
    Relabelled,
    /// The page has another size.
    Page,
    /// Looks different although all marks were found unchanged.
    Picture,
}

impl Verdict {
    /// All verdicts, the most serious first.
    pub const ALL: [Self; 9] = [
        Self::Page,
        Self::Removed,
        Self::Added,
        Self::Reshaped,
        Self::Moved,
        Self::Restyled,
        Self::Restacked,
        Self::Picture,
        Self::Relabelled,
    ];

    /// Name of the verdict, as in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Removed => "removed",
            Self::Added => "added",
            Self::Reshaped => "reshaped",
            Self::Moved => "moved",
            Self::Restyled => "restyled",
            Self::Restacked => "restacked",
            Self::Relabelled => "relabelled",
            Self::Page => "page",
            Self::Picture => "picture",
        }
    }
}

/// The first test that two equal drawings pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// The files are equal byte for byte.
    Bytes,
    /// The marks are equal point for point; order, grouping and number formats may differ.
    Structure,
    /// The marks are in the same places within tolerance.
    Geometry,
    /// The marks differ, but the pixels are the same.
    Picture,
}

/// One changed property of a mark other than its geometry.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Change {
    /// Name of the property: `colour`, `width`, `dash`, `tone`, `part`, `class`, ….
    pub what: String,
    /// Old value.
    pub old: String,
    /// New value.
    pub new: String,
}

/// Bounding box of the old and the new mark, in px from the page's upper left corner.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FindingBox {
    /// Left edge.
    pub x: f64,
    /// Top edge.
    pub y: f64,
    /// Width in px.
    pub width: f64,
    /// Height in px.
    pub height: f64,
}

/// A [`FindingBox`] by the bits of its numbers, as a hash key.
pub(crate) type FindingBoxKey = [u64; 4];

impl FindingBox {
    /// A rectangle rounded to a hundredth of a px.
    pub(crate) fn of(rect: Rect) -> Self {
        let round = |value: f64| (value * 100.0).round() / 100.0;
        Self {
            x: round(rect.x0),
            y: round(rect.y0),
            width: round(rect.width()),
            height: round(rect.height()),
        }
    }

    /// The hash key of this box.
    pub(crate) fn key(&self) -> FindingBoxKey {
        [self.x, self.y, self.width, self.height].map(f64::to_bits)
    }

    /// The box as a rectangle.
    pub(crate) fn rect(&self) -> Rect {
        Rect::new(self.x, self.y, self.x + self.width, self.y + self.height)
    }

    /// Centre of the box.
    #[must_use]
    pub fn middle(&self) -> (f64, f64) {
        (self.x + self.width / 2.0, self.y + self.height / 2.0)
    }
}

/// Change of one mark; lengths in px, areas in square px.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// How the mark changed.
    pub verdict: Verdict,
    /// Line, region or clip.
    pub kind: ShapeKind,
    /// Label of the mark; for relabelled marks the old one.
    pub label: Label,
    /// Changed properties.
    pub changes: Vec<Change>,
    /// Bounding box of the change.
    pub place: FindingBox,
    /// Length of a line or area of a region: the old one, or the new one of an added mark.
    pub size: f64,
    /// Increase of the length or area.
    pub growth: f64,
    /// Removed and added length of a line; 0 where the line is reported as a whole.
    pub pieces: [f64; 2],
    /// Material of the old mark, where the file names it.
    pub material: Option<Arc<str>>,
    /// Hausdorff distance between old and new; 0 if there is only one of them.
    pub largest: f64,
    /// 95th percentile of the distance.
    pub p95: f64,
    /// Shift of the mark, x right and y down, if all of it moved alike.
    pub shift: Option<[f64; 2]>,
    /// Removed part of the old mark, and added part of the new one.
    pub(crate) removed_path: BezPath,
    pub(crate) added_path: BezPath,
    /// Whether the finding follows from a motion of the whole drawing.
    pub(crate) follows_motion: bool,
}

impl Finding {
    /// A finding about a shape.
    pub(crate) fn of_shape(verdict: Verdict, shape: &Shape, changes: Vec<Change>, place: Rect) -> Self {
        let finding = Self::in_place(verdict, (*shape.label).clone(), changes, place);
        Self { kind: shape.kind, material: shape.material.clone(), ..finding }
    }

    /// A finding about a place of the drawing.
    pub(crate) fn in_place(verdict: Verdict, label: Label, changes: Vec<Change>, place: Rect) -> Self {
        Self {
            verdict,
            kind: ShapeKind::Region,
            label,
            changes,
            place: FindingBox::of(place),
            size: 0.0,
            growth: 0.0,
            pieces: [0.0; 2],
            material: None,
            largest: 0.0,
            p95: 0.0,
            shift: None,
            removed_path: BezPath::new(),
            added_path: BezPath::new(),
            follows_motion: false,
        }
    }
}

/// Common cause of several findings, such as a moved part or a larger page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cause {
    /// The verdict of most findings of this cause.
    pub verdict: Verdict,
    /// The cause as a sentence.
    pub sentence: String,
    /// Indexes of its findings in [`Diff::findings`].
    pub findings: Vec<usize>,
}

/// Result of a comparison of two drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Diff {
    /// All findings, the most serious first, then by part, class and place.
    pub findings: Vec<Finding>,
    /// Causes reported in place of their findings. Each finding belongs to at most one cause.
    pub causes: Vec<Cause>,
    /// The first test that the drawings pass; `None` if they differ.
    pub same_at: Option<Stage>,
    /// Total lengths and areas.
    pub totals: Totals,
    /// Default tolerance in px.
    pub tolerance_px: f64,
    /// Names of tolerances that match no mark in either drawing.
    pub unused_tolerances: Vec<String>,
    /// Whether the pixels could not be compared, because one drawing takes too long to rasterise.
    pub pictures_unknown: bool,
    /// Whether one finding stands for all marks, because the camera changed and
    /// [`DiffOptions::brief`](crate::diff::DiffOptions::brief) allows it.
    pub is_brief: bool,
    /// Comparison of pixels, if requested.
    pub pixels: Option<PixelDiff>,
    pub(crate) before: Picture,
    pub(crate) after: Picture,
}

impl Diff {
    /// Whether the drawings are the same.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.same_at.is_some()
    }

    /// Findings of one verdict.
    pub fn of(&self, verdict: Verdict) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.verdict == verdict)
    }
}
