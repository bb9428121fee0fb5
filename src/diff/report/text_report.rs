//! Comparison results as text: one line for each finding, or one line for many similar findings.

use std::collections::{BTreeMap, BTreeSet};

use kurbo::Vec2;
use rustc_hash::FxHashSet;

use super::unit_format::UnitFormat;
use crate::diff::findings::finding::{Cause, Change, Diff, Finding, FindingBox, Stage, Verdict};
use crate::diff::shapes::picture::ShapeKind;

/// Above this number, similar findings of one part share a line.
const MAX_UNGROUPED_FINDINGS: usize = 3;

impl Diff {
    /// Summary in one line, such as `1 removed, 12 moved (up to 0.5 px)`.
    #[must_use]
    pub fn summary(&self) -> String {
        let pixels = self.pixels.as_ref().map(|pixels| format!(", {}", pixels.words())).unwrap_or_default();
        let unit = self.unit();
        let within = unit.length(self.tolerance_px);
        match self.same_at {
            Some(Stage::Bytes) => return format!("the same bytes{pixels}"),
            Some(Stage::Structure) => return format!("the same marks{pixels}"),
            Some(Stage::Picture) => return format!("the same picture within {within}{pixels}"),
            Some(Stage::Geometry) => return format!("the same within {within}{pixels}"),
            None if self.findings.is_empty() => return format!("the same marks within {within}{pixels}"),
            None if self.is_brief => return format!("the marks were not compared individually{pixels}"),
            None => {}
        }
        let mut words = Vec::new();
        for verdict in Verdict::ALL {
            let count = self.of(verdict).count();
            if count == 0 {
                continue;
            }
            let largest = self.of(verdict).map(|finding| finding.largest).fold(0.0, f64::max);
            words.push(match verdict {
                Verdict::Page => "another page size".to_owned(),
                Verdict::Picture if count == 1 => "1 place looks different".to_owned(),
                Verdict::Picture => format!("{count} places look different"),
                Verdict::Moved => format!("{count} moved (up to {})", unit.length(largest)),
                _ => format!("{count} {}", verdict.name()),
            });
        }
        words.join(", ") + &pixels
    }

    /// The findings as lines, the most serious first. Similar findings share a line.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let lines = self.report_lines().into_iter().map(|told| told.line);
        let unused =
            self.unused_tolerances.iter().map(|name| format!("note       no mark is called `{name}`"));
        let linked = self.linked().map(|target| {
            format!("note       the picture `{target}` is linked: compared by its target and its box, not by what is in it")
        });
        let unread = if self.same_at == Some(Stage::Bytes) { Vec::new() } else { self.unread() };
        let unread = (!unread.is_empty())
            .then(|| format!("note       not read, and not compared: {}", unread.join(", ")));
        let unknown = self.pictures_unknown.then(|| {
            "note       the pictures were not compared: they would take too long to rasterise".to_owned()
        });
        lines.chain(unused).chain(linked).chain(unread).chain(unknown).collect()
    }

    /// Targets of linked pictures.
    fn linked(&self) -> impl Iterator<Item = &str> {
        let shapes = self.before.shapes.iter().chain(self.after.shapes.iter());
        let targets: BTreeSet<&str> = shapes.filter_map(|shape| shape.ink.paint.link()).collect();
        targets.into_iter()
    }

    /// Contents of either file that are not compared.
    pub(crate) fn unread(&self) -> Vec<&'static str> {
        let all = self.before.unread.iter().chain(self.after.unread.iter());
        let all: BTreeSet<&'static str> = all.copied().collect();
        all.into_iter().collect()
    }

    /// One line for each finding.
    #[must_use]
    pub fn all_lines(&self) -> Vec<String> {
        self.findings.iter().map(|finding| line(finding, self.unit())).collect()
    }

    /// Lines of the report with the number of findings that each stands for.
    pub(crate) fn report_lines(&self) -> Vec<ReportLine> {
        let unit = self.unit();
        let explained: FxHashSet<usize> =
            self.causes.iter().flat_map(|cause| cause.findings.iter().copied()).collect();
        let of_cause = |cause: &Cause| ReportLine {
            verdict: cause.verdict,
            count: cause.findings.len(),
            line: format!("{:<10} {}", cause.verdict.name(), cause.sentence),
        };
        let mut told: Vec<ReportLine> = self.causes.iter().map(of_cause).collect();
        let mut groups: BTreeMap<FindingGroupKey, Vec<&Finding>> = BTreeMap::new();
        for (_, finding) in self.findings.iter().enumerate().filter(|(index, _)| !explained.contains(index)) {
            // A part that came or went is one line for all kinds of marks.
            let alone = matches!(finding.verdict, Verdict::Removed | Verdict::Added);
            let kind = !alone && finding.kind == ShapeKind::Line;
            let changes: &[Change] = match finding.verdict {
                Verdict::Moved | Verdict::Picture => &[],
                _ => &finding.changes,
            };
            let key = (finding.verdict, finding.label.part.as_deref(), changes, kind);
            groups.entry(key).or_default().push(finding);
        }
        for ((verdict, part, changes, _), findings) in groups {
            let whole =
                part.and_then(|part| self.totals.parts.get(part)).is_some_and(|measure| match verdict {
                    Verdict::Removed => measure.marks[1] == 0,
                    Verdict::Added => measure.marks[0] == 0,
                    _ => false,
                });
            if findings.len() <= MAX_UNGROUPED_FINDINGS && !whole {
                told.extend(findings.iter().map(|f| ReportLine { verdict, count: 1, line: line(f, unit) }));
                continue;
            }
            let count = findings.len();
            let noun = match part {
                _ if verdict == Verdict::Picture => format!("{count} places look different"),
                Some(part) if whole => format!("part `{part}`: all its {count} marks"),
                Some(part) => format!("{count} marks of `{part}`"),
                None => format!("{count} marks"),
            };
            let boxes = findings.iter().map(|finding| finding.place.rect());
            let place = FindingBox::of(boxes.reduce(|a, b| a.union(b)).unwrap_or_default());
            let detail = shared_detail(&findings, changes, unit);
            let line = format!("{:<10} {noun} {}: {detail}", verdict.name(), unit.place(&place));
            told.push(ReportLine { verdict, count, line });
        }
        // The sort is stable: lines of one verdict keep their order.
        told.sort_by_key(|told| told.verdict != Verdict::Page);
        told
    }
}

/// Key of findings that share a line: verdict, part, changes, and whether they are lines.
type FindingGroupKey<'a> = (Verdict, Option<&'a str>, &'a [Change], bool);

/// A line of the report and the number of its findings.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ReportLine {
    pub verdict: Verdict,
    pub count: usize,
    pub line: String,
}

/// Common detail of several findings of one verdict.
fn shared_detail(findings: &[&Finding], changes: &[Change], unit: UnitFormat) -> String {
    let largest = findings.iter().map(|f| f.largest).fold(0.0, f64::max);
    let p95 = findings.iter().map(|f| f.p95).fold(0.0, f64::max);
    let ink = || unit.ink(findings.iter().copied());
    match findings.first().map(|f| f.verdict) {
        Some(Verdict::Moved) => {
            let first = findings.first().and_then(|f| f.shift);
            let together = first.filter(|first| {
                let way = |[x, y]: [f64; 2]| Vec2::new(x, y);
                let near = |s: [f64; 2]| (way(s) - way(*first)).hypot() <= 0.02 * way(*first).hypot();
                findings.iter().all(|f| f.shift.is_some_and(near))
            });
            let all = if together.is_some() { "all " } else { "" };
            all.to_owned() + &motion(together, largest, p95, unit)
        }
        Some(Verdict::Restacked) => changed(changes),
        Some(Verdict::Restyled | Verdict::Relabelled) if changes.is_empty() => ink(),
        Some(Verdict::Restyled | Verdict::Relabelled) => format!("{} ({})", changed(changes), ink()),
        Some(Verdict::Reshaped) => {
            let growth = findings.iter().map(|f| f.growth).sum::<f64>();
            let lines = findings.iter().all(|f| f.kind == ShapeKind::Line);
            let in_all =
                grown(growth, lines, unit).map(|grown| format!(", {grown} in all")).unwrap_or_default();
            format!("up to {} off{in_all}", unit.length(largest))
        }
        _ => ink(),
    }
}

/// One finding in words.
pub(crate) fn line(finding: &Finding, unit: UnitFormat) -> String {
    let lines = finding.kind == ShapeKind::Line;
    let size = || if lines { format!("{} long", unit.length(finding.size)) } else { unit.area(finding.size) };
    let detail = match finding.verdict {
        Verdict::Page | Verdict::Restacked => changed(&finding.changes),
        Verdict::Removed | Verdict::Added => size(),
        Verdict::Restyled | Verdict::Relabelled if finding.changes.is_empty() => size(),
        Verdict::Restyled | Verdict::Relabelled | Verdict::Picture => {
            format!("{}, {}", changed(&finding.changes), size())
        }
        Verdict::Moved => motion(finding.shift, finding.largest, finding.p95, unit),
        Verdict::Reshaped => {
            // If a whole border came or went, no distance is reported.
            let off = (unit.number(finding.largest) != "0")
                .then(|| format!("up to {} off", unit.length(finding.largest)));
            let told: Vec<String> = pieces(finding, lines, unit).into_iter().chain(off).collect();
            if told.is_empty() { "a border more or less".to_owned() } else { told.join(", ") }
        }
    };
    let also = match finding.verdict {
        Verdict::Moved | Verdict::Reshaped if !finding.changes.is_empty() => {
            format!("; {}", changed(&finding.changes))
        }
        _ => String::new(),
    };
    let noun = match (finding.verdict, finding.kind) {
        (Verdict::Page, _) => "of the drawing".to_owned(),
        (Verdict::Picture, _) => "looks different".to_owned(),
        (_, ShapeKind::Region) => format!("fill {}", finding.label).replace("fill fills", "fill"),
        (_, ShapeKind::Clip) => format!("clip {}", finding.label),
        (_, ShapeKind::Line) => finding.label.to_string(),
    };
    format!("{:<10} {noun} {}: {detail}{also}", finding.verdict.name(), unit.place(&finding.place))
}

/// Removed and added length of a reshaped line, or the growth of a region.
fn pieces(finding: &Finding, lines: bool, unit: UnitFormat) -> Option<String> {
    let [gone, new] = finding.pieces;
    match lines {
        true if gone > 0.0 && new > 0.0 => {
            Some(format!("{} gone and {} new", unit.length(gone), unit.length(new)))
        }
        _ => grown(finding.growth, lines, unit),
    }
}

/// Growth in words; `None` if it rounds to zero.
fn grown(growth: f64, lines: bool, unit: UnitFormat) -> Option<String> {
    let (amount, more, less) = match lines {
        true => (unit.length(growth.abs()), "longer", "shorter"),
        false => (unit.area(growth.abs()), "larger", "smaller"),
    };
    (!amount.starts_with("0 ")).then(|| format!("{amount} {}", if growth > 0.0 { more } else { less }))
}

/// A shift in words with its length and both directions, or the distances of another motion.
fn motion(shift: Option<[f64; 2]>, largest: f64, p95: f64, unit: UnitFormat) -> String {
    match shift.map(|[x, y]| Vec2::new(x, y)) {
        Some(shift) => format!("by {} ({})", unit.length(shift.hypot()), unit.sides(shift, "")),
        None => format!("by up to {}, 95 % within {}", unit.length(largest), unit.length(p95)),
    }
}

/// Changed properties in words: `width 1 px → 2 px`.
pub(crate) fn changed(changes: &[Change]) -> String {
    let of = |change: &Change| format!("{} {} → {}", change.what, change.old, change.new);
    changes.iter().map(of).collect::<Vec<_>>().join(", ")
}
