//! [`Diff`] and its [`Finding`]s: what differs, one finding a mark.

use std::sync::Arc;

use kurbo::{BezPath, Rect};
use serde::Serialize;

use super::ink_totals::Totals;
use super::pixel_count::PixelDiff;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, ShapeKind};

/// What became of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It is only in the first drawing.
    Removed,
    /// It is only in the second drawing.
    Added,
    /// It has another form: another length, another bend, a hole less.
    Reshaped,
    /// It lies elsewhere, whole.
    Moved,
    /// It lies where it lay, and is painted differently.
    Restyled,
    /// It lies over a mark that lay over it, or under one that lay under it.
    Restacked,
    /// It looks as it did, and belongs to another part, class or layer.
    Relabelled,
    /// The page itself has another size.
    Page,
    /// It looks different, though all marks were found as they were.
    Picture,
}

impl Verdict {
    /// All verdicts, the gravest first.
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

    /// The word for it.
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

/// The first look at which two drawings are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// The files are equal.
    Bytes,
    /// Each mark has its equal, point for point; order, grouping and the look of numbers may differ.
    Structure,
    /// Ink lies on the same places in both, within tolerance.
    Geometry,
    /// The marks differ but look the same: one picture, drawn in two ways.
    Picture,
}

/// One thing that is different about a mark beside its geometry.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Change {
    /// `colour`, `width`, `dash`, `tone`, `part`, `class`, ….
    pub what: String,
    /// What it was.
    pub old: String,
    /// What it is.
    pub new: String,
}

/// Where a finding is: the box round both the old and the new mark, in px from the page's corner.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Place {
    /// Left.
    pub x: f64,
    /// Top.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

/// A place by the bits of its numbers.
pub(crate) type PlaceKey = [u64; 4];

impl Place {
    pub(crate) fn of(rect: Rect) -> Self {
        let round = |value: f64| (value * 100.0).round() / 100.0;
        Self {
            x: round(rect.x0),
            y: round(rect.y0),
            width: round(rect.width()),
            height: round(rect.height()),
        }
    }

    /// It as a key.
    pub(crate) fn key(&self) -> PlaceKey {
        [self.x, self.y, self.width, self.height].map(f64::to_bits)
    }

    /// The middle.
    #[must_use]
    pub fn middle(&self) -> (f64, f64) {
        (self.x + self.width / 2.0, self.y + self.height / 2.0)
    }
}

/// What became of one mark; lengths in px, areas in square px.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What became of it.
    pub verdict: Verdict,
    /// Line or region.
    pub kind: ShapeKind,
    /// What it is, or was before it was relabelled.
    pub label: Label,
    /// What else is different.
    pub changes: Vec<Change>,
    /// Where.
    pub place: Place,
    /// Length of the line or area of the region: the old one, of what is added the new one.
    pub size: f64,
    /// How much longer or larger it is now.
    pub growth: f64,
    /// Length of what is gone of a line, and of what is new of it; 0 where it is told as a whole.
    pub pieces: [f64; 2],
    /// The material of the old mark, where the file names it.
    pub material: Option<Arc<str>>,
    /// The largest distance between old and new: the Hausdorff distance. 0 where there is only one.
    pub largest: f64,
    /// 95 % of it is nearer than this to what it was.
    pub p95: f64,
    /// How far all of it went, x right and y down, where all of it went the same way.
    pub shift: Option<[f64; 2]>,
    /// What is gone of the old one, and what is new of the new one.
    pub(crate) gone: BezPath,
    pub(crate) new: BezPath,
    /// Whether it follows from a motion of the whole drawing.
    pub(crate) carried: bool,
}

impl Finding {
    /// A finding about something that lies where it lay.
    pub(crate) fn in_place(
        verdict: Verdict,
        kind: ShapeKind,
        label: Label,
        changes: Vec<Change>,
        place: Place,
    ) -> Self {
        Self {
            verdict,
            kind,
            label,
            changes,
            place,
            size: 0.0,
            growth: 0.0,
            pieces: [0.0; 2],
            material: None,
            largest: 0.0,
            p95: 0.0,
            shift: None,
            gone: BezPath::new(),
            new: BezPath::new(),
            carried: false,
        }
    }
}

/// What several findings follow from: a part that moved, a page that grew.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cause {
    /// What happened: the verdict of most that follows from it.
    pub verdict: Verdict,
    /// What happened, in words.
    pub sentence: String,
    /// What follows from it: places in the list of findings.
    pub findings: Vec<usize>,
}

/// What differs between two drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Diff {
    /// What differs, the gravest first, then by part, class and place.
    pub findings: Vec<Finding>,
    /// What many findings follow from, told in their place; each finding follows from one cause at most.
    pub causes: Vec<Cause>,
    /// The first look at which the drawings are the same; `None` if they are not.
    pub same_at: Option<Stage>,
    /// Lengths and areas.
    pub totals: Totals,
    /// The tolerance of what has none of its own, in px.
    pub tolerance_px: f64,
    /// Tolerances that were given for what neither drawing has.
    pub unused_tolerances: Vec<String>,
    /// Whether the pictures could not be compared, because one takes too long to rasterise: geometry alone was.
    pub pictures_unknown: bool,
    /// Whether one finding stands for all marks, because the drawing is seen from another side and
    /// [`DiffOptions::brief`](crate::diff::DiffOptions::brief) allows it.
    pub is_brief: bool,
    /// The comparison of pixels, where it was asked for.
    pub pixels: Option<PixelDiff>,
    pub(crate) before: Picture,
    pub(crate) after: Picture,
}

impl Diff {
    /// Whether nothing differs.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.same_at.is_some()
    }

    /// The findings of one verdict.
    pub fn of(&self, verdict: Verdict) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.verdict == verdict)
    }
}
