//! Causes of many findings, one sentence each: a moved part, a recoloured material, or a removed part with
//! the marks behind it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use kurbo::Rect;

use super::motion::Motion;
use crate::diff::findings::finding::{Cause, Change, Diff, Finding, FindingBox, Verdict};
use crate::diff::report::text_report::changed;
use crate::diff::report::unit_format::UnitFormat;
use crate::diff::shapes::ink::trimmed;
use crate::diff::shapes::picture::ShapeKind;
use crate::diff::tolerances;
use crate::drawing::LayerKind;

/// Margin around a part in px. Changes inside it count as caused by the part, because lines have widths and
/// fills are cut there.
const PART_MARGIN_PX: f64 = 4.0;
/// Margin around a part as a share of its width plus height; both are added.
const PART_MARGIN_SHARE: f64 = 0.1;
/// Least share of a finding's box inside that margin.
const MIN_OVERLAP_SHARE: f64 = 0.3;
/// Most colour changes named per material.
const MAX_NAMED_COLOURS: usize = 2;
/// Most parts named per sentence.
const MAX_NAMED_PARTS: usize = 3;
/// With more directions of motion than this, the camera moved instead of the parts.
pub(crate) const MAX_DIRECTIONS: usize = 6;
/// Up to this many findings are listed one by one.
const MAX_UNGROUPED_FINDINGS: usize = 2;

/// A part, and the motion that carries its marks.
#[derive(Debug, Clone)]
pub(crate) struct MovedPart {
    pub part: Arc<str>,
    pub motion: Motion,
    /// Bounding boxes before and after.
    pub places: [Rect; 2],
}

/// Causes of the findings that are not explained by a motion of the whole drawing or by missing labels.
pub(crate) fn causes(diff: &Diff, movers: &[MovedPart]) -> Vec<Cause> {
    let mut is_unexplained: Vec<bool> = vec![true; diff.findings.len()];
    let mut causes = Vec::new();
    match camera_cause(diff, movers, &mut is_unexplained) {
        Some(camera) => causes.push(camera),
        None => {
            causes.extend(gone(diff, &mut is_unexplained));
            causes.extend(moved(diff, movers, &mut is_unexplained));
        }
    }
    causes.extend(recoloured(diff, &mut is_unexplained));
    causes.extend(pen_causes(diff, &mut is_unexplained));
    causes
}

/// Claims the unclaimed findings that satisfy a condition.
fn take(diff: &Diff, is_unexplained: &mut [bool], is_such: impl Fn(&Finding) -> bool) -> Vec<usize> {
    let matching_findings: Vec<usize> = (0..is_unexplained.len())
        .filter(|index| is_unexplained[*index] && is_such(&diff.findings[*index]))
        .collect();
    matching_findings.iter().for_each(|index| is_unexplained[*index] = false);
    matching_findings
}

/// Whether at least `MIN_OVERLAP_SHARE` of a box is inside the margin around a part.
fn holds(outer: &Rect, inner: Rect) -> bool {
    let margin = PART_MARGIN_PX + PART_MARGIN_SHARE * (outer.width() + outer.height());
    let outer = outer.inflate(margin, margin);
    let inner = inner.inflate(0.5, 0.5);
    outer.intersect(inner).area() >= MIN_OVERLAP_SHARE * inner.area() && outer.overlaps(inner)
}

/// Whether a finding may follow from a nearby part that was added, removed or moved, by its form or its
/// light.
fn may_follow(finding: &Finding) -> bool {
    if is_of_hidden_lines(finding) {
        return true;
    }
    match finding.verdict {
        Verdict::Page | Verdict::Relabelled => false,
        Verdict::Restyled => finding.changes.iter().any(|change| change.what == "tone"),
        _ => true,
    }
}

/// Whether a finding concerns a hidden line, whose dashes are fitted again, or a line that became visible or
/// hidden.
fn is_of_hidden_lines(finding: &Finding) -> bool {
    let hidden = LayerKind::HiddenLines.id();
    let is_hiding = |change: &Change| match change.what.as_str() {
        "hidden by" => true,
        "layer" => change.old == hidden || change.new == hidden,
        _ => false,
    };
    finding.label.layer.as_ref() == hidden || finding.changes.iter().any(is_hiding)
}

/// Distinct items with the number of times each occurs, the most frequent first.
fn by_count<T: Ord>(items: impl Iterator<Item = T>) -> Vec<(T, usize)> {
    let mut counts: BTreeMap<T, usize> = BTreeMap::new();
    items.for_each(|item| *counts.entry(item).or_default() += 1);
    let mut counts: Vec<(T, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    counts
}

/// Unclaimed findings by a key, if more than [`MAX_UNGROUPED_FINDINGS`] share it.
fn grouped<'a, K: Ord>(
    diff: &'a Diff,
    is_unexplained: &[bool],
    key: impl Fn(&'a Finding) -> Option<K>,
) -> BTreeMap<K, Vec<usize>> {
    let mut groups: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    for (index, finding) in diff.findings.iter().enumerate().filter(|(index, _)| is_unexplained[*index]) {
        if let Some(key) = key(finding) {
            groups.entry(key).or_default().push(index);
        }
    }
    groups.retain(|_, findings| findings.len() > MAX_UNGROUPED_FINDINGS);
    groups
}

/// Parts by common motion.
fn by_motion<'a>(movers: impl Iterator<Item = &'a MovedPart>) -> Vec<Vec<&'a MovedPart>> {
    let mut groups: Vec<Vec<&MovedPart>> = Vec::new();
    for mover in movers {
        match groups.iter_mut().find(|group| group.iter().all(|other| same_way(other, mover))) {
            Some(group) => group.push(mover),
            None => groups.push(vec![mover]),
        }
    }
    groups
}

/// The parts that findings belong to, such as ``3 marks of `base` ``.
fn whose(diff: &Diff, finding_indices: &[usize]) -> String {
    let findings = finding_indices.iter().filter_map(|index| diff.findings.get(*index));
    let parts = by_count(findings.map(|finding| finding.label.part.as_deref().unwrap_or("")));
    let marks = |count: usize| if count == 1 { "1 mark".to_owned() } else { format!("{count} marks") };
    match parts.as_slice() {
        [("", count)] => marks(*count),
        [(part, count)] => format!("{} of `{part}`", marks(*count)),
        several_parts => format!("{} of {} parts", marks(finding_indices.len()), several_parts.len()),
    }
}

/// Parts that were completely removed or added, with the changes around them.
fn gone(diff: &Diff, is_unexplained: &mut [bool]) -> Vec<Cause> {
    let mut causes = Vec::new();
    for (verdict, side) in [(Verdict::Removed, 1), (Verdict::Added, 0)] {
        for (part, measure) in &diff.totals.parts {
            if part.is_empty() || measure.marks[side] > 0 || measure.marks[1 - side] == 0 {
                continue;
            }
            let part_findings =
                take(diff, is_unexplained, |f| f.verdict == verdict && f.label.part.as_deref() == Some(part));
            let places = part_findings.iter().map(|index| diff.findings[*index].place.rect());
            let Some(part_rect) = places.reduce(|a, b| a.union(b)) else { continue };
            let following_findings =
                take(diff, is_unexplained, |f| may_follow(f) && holds(&part_rect, f.place.rect()));
            let unit = diff.unit();
            let place_text = unit.place(&FindingBox::of(part_rect));
            let marks_text = match part_findings.len() {
                1 => "its only mark".to_owned(),
                count => format!("all its {count} marks"),
            };
            let effect =
                if verdict == Verdict::Removed { "now visible behind it" } else { "now hidden or cut by it" };
            let following_text = following(diff, effect, &following_findings);
            let ink = unit.ink(part_findings.iter().map(|index| &diff.findings[*index]));
            let sentence = format!("part `{part}`: {marks_text} {place_text}: {ink}{following_text}");
            causes.push(Cause { verdict, sentence, findings: [part_findings, following_findings].concat() });
        }
    }
    causes
}

/// The cause "another camera": parts move in more directions than an edit of the model explains. It claims
/// all other changes of geometry.
fn camera_cause(diff: &Diff, movers: &[MovedPart], is_unexplained: &mut [bool]) -> Option<Cause> {
    if by_motion(movers.iter()).len() <= MAX_DIRECTIONS {
        return None;
    }
    let findings = take(diff, is_unexplained, |f| !matches!(f.verdict, Verdict::Page | Verdict::Relabelled));
    let sentence = format!("the drawing is seen from another side: {}", whose(diff, &findings));
    Some(Cause { verdict: Verdict::Moved, sentence, findings })
}

/// Moved parts, grouped by common motion, with the changes around their old and new places.
fn moved(diff: &Diff, movers: &[MovedPart], is_unexplained: &mut [bool]) -> Vec<Cause> {
    let unit = diff.unit();
    let mut findings_of_movers: Vec<(&MovedPart, Vec<usize>)> = Vec::new();
    for mover in movers {
        let is_own = |f: &Finding| f.label.part.as_ref() == Some(&mover.part) && may_follow(f);
        findings_of_movers.push((mover, take(diff, is_unexplained, is_own)));
    }
    findings_of_movers.retain(|(_, findings)| !findings.is_empty());
    let cause_of_group = |movers: Vec<&MovedPart>| {
        let is_of_group = |mover: &MovedPart| movers.iter().any(|other| std::ptr::eq(*other, mover));
        let own = findings_of_movers.iter().filter(|(mover, _)| is_of_group(mover));
        let mut findings: Vec<usize> = own.flat_map(|(_, findings)| findings).copied().collect();
        let swept_rects: Vec<Rect> =
            movers.iter().map(|mover| mover.places[0].union(mover.places[1])).collect();
        let is_round = |f: &Finding| swept_rects.iter().any(|place| holds(place, f.place.rect()));
        let nearby_findings = take(diff, is_unexplained, |f| may_follow(f) && is_round(f));
        let names: Vec<String> =
            movers.iter().take(MAX_NAMED_PARTS).map(|mover| format!("`{}`", mover.part)).collect();
        let more = movers.len().saturating_sub(MAX_NAMED_PARTS);
        let names = match (more, names.split_last()) {
            (0, Some((last, rest))) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
            (0, _) => names.join(""),
            _ => format!("{} and {more} more parts", names.join(", ")),
        };
        let rect_before =
            movers.iter().map(|mover| mover.places[0]).reduce(|a, b| a.union(b)).unwrap_or_default();
        let motion_text =
            movers.first().map(|mover| motion(&mover.motion, rect_before, unit)).unwrap_or_default();
        let following_text = following(diff, "also changed around it", &nearby_findings);
        findings.extend(nearby_findings);
        let sentence = format!("{names} {motion_text}{following_text}");
        Cause { verdict: Verdict::Moved, sentence, findings }
    };
    by_motion(findings_of_movers.iter().map(|(mover, _)| *mover)).into_iter().map(cause_of_group).collect()
}

/// End of a sentence about findings that follow from a cause; empty if there are none.
fn following(diff: &Diff, effect: &str, findings: &[usize]) -> String {
    if findings.is_empty() { String::new() } else { format!("; {effect}: {}", whose(diff, findings)) }
}

/// Whether two parts moved alike: at the corners of both boxes, within a fiftieth of the shift plus 0.05 px.
fn same_way(a: &MovedPart, b: &MovedPart) -> bool {
    let shifts_by_own_motion =
        [a, b].into_iter().flat_map(|mover| mover.motion.corner_displacements(mover.places[0]));
    let shifts_by_other_motion = [(a, b), (b, a)]
        .into_iter()
        .flat_map(|(from, other)| other.motion.corner_displacements(from.places[0]));
    shifts_by_own_motion
        .zip(shifts_by_other_motion)
        .all(|(one, other)| (one - other).hypot() <= 0.05 + 0.02 * one.hypot())
}

/// A motion in words: `1.4 px right`, `turned by 3°`.
pub(crate) fn motion(motion: &Motion, rect: Rect, unit: UnitFormat) -> String {
    let (scale, turn) = (motion.scale(), motion.turn());
    let half_size = rect.width().max(rect.height()) / 2.0;
    let is_scaled =
        (scale - 1.0).abs() * half_size > 0.05 && (scale - 1.0).abs() > tolerances::MIN_STATED_GROWTH_SHARE;
    let is_turned = turn.abs().to_radians() * half_size > 0.05 && turn.abs() > 0.05;
    let shift_text = unit.sides(motion.displacement(rect.center()), &format!(" {}", unit.name()));
    let mut clauses = Vec::new();
    if is_scaled {
        clauses.push(format!("{} times as large", trimmed(scale)));
    }
    if is_turned {
        let side = if turn > 0.0 { "clockwise" } else { "counter-clockwise" };
        clauses.push(format!("turned by {}° {side}", trimmed((turn.abs() * 100.0).round() / 100.0)));
    }
    if !shift_text.is_empty() {
        clauses.push(if clauses.is_empty() { shift_text } else { format!("its middle {shift_text}") });
    }
    clauses.join(", ")
}

/// Materials that changed their colour; marks without a material form one group.
fn recoloured(diff: &Diff, is_unexplained: &mut [bool]) -> Vec<Cause> {
    let material = |finding: &Finding| {
        let is_recoloured = finding.verdict == Verdict::Restyled
            && matches!(finding.changes.as_slice(), [change] if change.what == "colour");
        is_recoloured.then(|| match &finding.material {
            Some(material) => format!("material `{material}`"),
            None => "marks of no material".to_owned(),
        })
    };
    let mut causes = Vec::new();
    for (name, findings) in grouped(diff, is_unexplained, material) {
        let changes = findings.iter().flat_map(|index| &diff.findings[*index].changes);
        let changes = by_count(changes.map(|change| (&change.old, &change.new)));
        let colour_changes: Vec<String> =
            changes.iter().take(MAX_NAMED_COLOURS).map(|((old, new), _)| format!("{old} → {new}")).collect();
        let more = match changes.len().saturating_sub(MAX_NAMED_COLOURS) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        findings.iter().for_each(|index| is_unexplained[*index] = false);
        let whose = whose(diff, &findings);
        let sentence = format!("{name}: colour {}{more} ({whose})", colour_changes.join(", "));
        causes.push(Cause { verdict: Verdict::Restyled, sentence, findings });
    }
    causes
}

/// Pen changes shared by lines of several parts: width, dash, ends, corners or colour. One sentence for each
/// change.
fn pen_causes(diff: &Diff, is_unexplained: &mut [bool]) -> Vec<Cause> {
    let is_pen =
        |change: &Change| matches!(change.what.as_str(), "width" | "dash" | "ends" | "corners" | "colour");
    let mut causes = Vec::new();
    for (changes, findings) in grouped(diff, is_unexplained, |finding| {
        let is_line = finding.verdict == Verdict::Restyled && finding.kind == ShapeKind::Line;
        let changes = finding.changes.as_slice();
        (is_line && !changes.is_empty() && changes.iter().all(is_pen)).then_some(changes)
    }) {
        let parts: BTreeSet<_> = findings.iter().map(|index| &diff.findings[*index].label.part).collect();
        if parts.len() < 2 {
            continue;
        }
        findings.iter().for_each(|index| is_unexplained[*index] = false);
        let sentence = format!("the pen: {} ({})", changed(changes), whose(diff, &findings));
        causes.push(Cause { verdict: Verdict::Restyled, sentence, findings });
    }
    causes
}
