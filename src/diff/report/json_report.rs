//! Comparison results as JSON.

use serde::Serialize;

use crate::diff::findings::finding::{Cause, Change, Diff, Finding, FindingBox, Stage, Verdict};
use crate::diff::findings::ink_totals::Totals;
use crate::diff::findings::pixel_count::PixelDiff;
use crate::diff::shapes::picture::ShapeKind;
use crate::diff::tolerances::MAX_DISTANCE_ERROR_SHARE;

/// The JSON document. Lengths in px, areas in square px.
#[derive(Serialize)]
struct Document<'a> {
    same: bool,
    same_at: Option<Stage>,
    summary: String,
    tolerance_px: f64,
    /// Relative error of distances: they are at most this share too small.
    distance_error_share: f64,
    /// Causes, each with the indexes of its findings.
    #[serde(skip_serializing_if = "<[Cause]>::is_empty")]
    causes: &'a [Cause],
    findings: Vec<Entry<'a>>,
    totals: &'a Totals,
    #[serde(skip_serializing_if = "Option::is_none")]
    pixels: &'a Option<PixelDiff>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    unused_tolerances: &'a [String],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    not_read: Vec<&'static str>,
}

/// A finding in the JSON document.
#[derive(Serialize)]
struct Entry<'a> {
    verdict: Verdict,
    kind: &'static str,
    layer: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    drawing: Option<&'a str>,
    classes: Vec<&'a str>,
    part: Option<&'a str>,
    place: FindingBox,
    size: f64,
    growth: f64,
    largest: f64,
    p95: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    shift: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "<[Change]>::is_empty")]
    changes: &'a [Change],
}

impl Diff {
    /// The comparison as JSON with the keys `same`, `findings` and `totals`. Lengths in px, areas in square
    /// px.
    #[must_use]
    pub fn to_json(&self) -> String {
        let document = Document {
            same: self.is_same(),
            same_at: self.same_at,
            summary: self.summary(),
            tolerance_px: self.tolerance_px,
            distance_error_share: MAX_DISTANCE_ERROR_SHARE,
            causes: &self.causes,
            findings: self.findings.iter().map(entry).collect(),
            totals: &self.totals,
            pixels: &self.pixels,
            unused_tolerances: &self.unused_tolerances,
            not_read: if self.same_at == Some(Stage::Bytes) { Vec::new() } else { self.unread() },
        };
        // Plain numbers, texts and lists cannot fail to serialise.
        serde_json::to_string_pretty(&document).unwrap_or_default() + "\n"
    }
}

fn entry(finding: &Finding) -> Entry<'_> {
    let round = |value: f64| (value * 1e4).round() / 1e4;
    Entry {
        verdict: finding.verdict,
        kind: match finding.kind {
            ShapeKind::Line => "line",
            ShapeKind::Region => "fill",
            ShapeKind::Clip => "clip",
        },
        layer: &finding.label.layer,
        drawing: finding.label.drawing.as_deref(),
        classes: finding.label.classes.iter().map(AsRef::as_ref).collect(),
        part: finding.label.part.as_deref(),
        place: finding.place,
        size: round(finding.size),
        growth: round(finding.growth),
        largest: round(finding.largest),
        p95: round(finding.p95),
        shift: finding.shift.map(|shift| shift.map(round)),
        changes: &finding.changes,
    }
}
