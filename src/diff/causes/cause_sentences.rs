//! Causes of many findings, one sentence each: a moved part, a recoloured material, or a removed part with
//! the marks behind it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use kurbo::{Rect, Vec2};

use super::motion::Motion;
use crate::diff::findings::finding::{Cause, Change, Diff, Finding, FindingBox, Verdict};
use crate::diff::report::text_report::changed;
use crate::diff::report::unit_format::UnitFormat;
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
    let mut free: Vec<bool> = vec![true; diff.findings.len()];
    let mut causes = Vec::new();
    match camera_cause(diff, movers, &mut free) {
        Some(eye) => causes.push(eye),
        None => {
            causes.extend(gone(diff, &mut free));
            causes.extend(moved(diff, movers, &mut free));
        }
    }
    causes.extend(recoloured(diff, &mut free));
    causes.extend(pen_causes(diff, &mut free));
    causes
}

/// Claims the unclaimed findings that satisfy a condition.
fn take(diff: &Diff, free: &mut [bool], is_such: impl Fn(&Finding) -> bool) -> Vec<usize> {
    let found: Vec<usize> =
        (0..free.len()).filter(|index| free[*index] && is_such(&diff.findings[*index])).collect();
    found.iter().for_each(|index| free[*index] = false);
    found
}

/// The box of a finding as a rectangle.
fn rect(finding: &Finding) -> Rect {
    let place = &finding.place;
    Rect::new(place.x, place.y, place.x + place.width, place.y + place.height)
}

/// Whether at least `MIN_OVERLAP_SHARE` of a box is inside the margin around a part.
fn holds(outer: &Rect, inner: Rect) -> bool {
    let round = PART_MARGIN_PX + PART_MARGIN_SHARE * (outer.width() + outer.height());
    let outer = outer.inflate(round, round);
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

/// The parts that findings belong to, such as ``3 marks of `base` ``.
fn whose(diff: &Diff, list: &[usize]) -> String {
    let mut parts: BTreeMap<&str, usize> = BTreeMap::new();
    for finding in list.iter().filter_map(|index| diff.findings.get(*index)) {
        *parts.entry(finding.label.part.as_deref().unwrap_or("")).or_default() += 1;
    }
    let mut parts: Vec<(&str, usize)> = parts.into_iter().collect();
    parts.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
    let marks = |count: usize| if count == 1 { "1 mark".to_owned() } else { format!("{count} marks") };
    match parts.as_slice() {
        [("", count)] => marks(*count),
        [(part, count)] => format!("{} of `{part}`", marks(*count)),
        many => format!("{} of {} parts", marks(list.len()), many.len()),
    }
}

/// Parts that were completely removed or added, with the changes around them.
fn gone(diff: &Diff, free: &mut [bool]) -> Vec<Cause> {
    let mut causes = Vec::new();
    for (verdict, side) in [(Verdict::Removed, 1), (Verdict::Added, 0)] {
        for (part, measure) in &diff.totals.parts {
            if part.is_empty() || measure.marks[side] > 0 || measure.marks[1 - side] == 0 {
                continue;
            }
            let own = take(diff, free, |f| f.verdict == verdict && f.label.part.as_deref() == Some(part));
            let Some(place) = own.iter().map(|index| rect(&diff.findings[*index])).reduce(|a, b| a.union(b))
            else {
                continue;
            };
            let behind = take(diff, free, |f| may_follow(f) && holds(&place, rect(f)));
            let unit = diff.unit();
            let at = unit.place(&FindingBox::of(place));
            let all = if own.len() == 1 {
                "its only mark".to_owned()
            } else {
                format!("all its {} marks", own.len())
            };
            let follows = match (behind.is_empty(), verdict) {
                (true, _) => String::new(),
                (_, Verdict::Removed) => format!("; now visible behind it: {}", whose(diff, &behind)),
                _ => format!("; now hidden or cut by it: {}", whose(diff, &behind)),
            };
            let ink = ink(diff, &own, unit);
            let sentence = format!("part `{part}`: {all} {at}: {ink}{follows}");
            causes.push(Cause { verdict, sentence, findings: [own, behind].concat() });
        }
    }
    causes
}

/// Length of lines and area of fills of some findings, in words.
fn ink(diff: &Diff, list: &[usize], unit: UnitFormat) -> String {
    let sum = |kind: ShapeKind| -> f64 {
        list.iter().map(|index| &diff.findings[*index]).filter(|f| f.kind == kind).map(|f| f.size).sum()
    };
    let (length, area) = (sum(ShapeKind::Line), sum(ShapeKind::Region));
    let lines = (length > 0.0).then(|| format!("{} of lines", unit.length(length)));
    let fills = (area > 0.0).then(|| format!("{} of fills", unit.area(area)));
    lines.into_iter().chain(fills).collect::<Vec<_>>().join(", ")
}

/// The cause "another camera": parts move in more directions than an edit of the model explains. It claims
/// all other changes of geometry.
fn camera_cause(diff: &Diff, movers: &[MovedPart], free: &mut [bool]) -> Option<Cause> {
    let mut ways: Vec<Vec<&MovedPart>> = Vec::new();
    for mover in movers {
        match ways.iter_mut().find(|others| others.iter().all(|other| same_way(other, mover))) {
            Some(others) => others.push(mover),
            None => ways.push(vec![mover]),
        }
    }
    if ways.len() <= MAX_DIRECTIONS {
        return None;
    }
    let findings = take(diff, free, |f| !matches!(f.verdict, Verdict::Page | Verdict::Relabelled));
    let sentence = format!("the drawing is seen from another side: {}", whose(diff, &findings));
    Some(Cause { verdict: Verdict::Moved, sentence, findings })
}

/// Moved parts, grouped by common motion, with the changes around their old and new places.
fn moved(diff: &Diff, movers: &[MovedPart], free: &mut [bool]) -> Vec<Cause> {
    let unit = diff.unit();
    let mut own: Vec<(&MovedPart, Vec<usize>)> = Vec::new();
    for mover in movers {
        let findings = take(diff, free, |f| f.label.part.as_ref() == Some(&mover.part) && may_follow(f));
        if !findings.is_empty() {
            own.push((mover, findings));
        }
    }
    let mut causes: Vec<(Vec<&MovedPart>, Vec<usize>)> = Vec::new();
    for (mover, findings) in &own {
        let alike = |others: &Vec<&MovedPart>| others.iter().all(|other| same_way(other, mover));
        match causes.iter_mut().find(|(others, _)| alike(others)) {
            Some((others, all)) => {
                others.push(mover);
                all.extend(findings);
            }
            None => causes.push((vec![mover], findings.clone())),
        }
    }
    let tell = |(movers, mut findings): (Vec<&MovedPart>, Vec<usize>)| {
        let places: Vec<Rect> = movers.iter().map(|mover| mover.places[0].union(mover.places[1])).collect();
        let is_round = |f: &Finding| places.iter().any(|place| holds(place, rect(f)));
        let behind = take(diff, free, |f| may_follow(f) && is_round(f));
        let names: Vec<String> =
            movers.iter().take(MAX_NAMED_PARTS).map(|mover| format!("`{}`", mover.part)).collect();
        let more = movers.len().saturating_sub(MAX_NAMED_PARTS);
        let names = match (more, names.split_last()) {
            (0, Some((last, rest))) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
            (0, _) => names.join(""),
            _ => format!("{} and {more} more parts", names.join(", ")),
        };
        let place = movers.iter().map(|mover| mover.places[0]).reduce(|a, b| a.union(b)).unwrap_or_default();
        let way = movers.first().map(|mover| motion(&mover.motion, place, unit)).unwrap_or_default();
        let follows = match behind.is_empty() {
            true => String::new(),
            false => format!("; also changed around it: {}", whose(diff, &behind)),
        };
        findings.extend(behind);
        let sentence = format!("{names} {way}{follows}");
        Cause { verdict: Verdict::Moved, sentence, findings }
    };
    causes.into_iter().map(tell).collect()
}

/// Whether two parts moved alike: at the corners of both boxes, within a fiftieth of the shift plus 0.05 px.
fn same_way(a: &MovedPart, b: &MovedPart) -> bool {
    let corners = [a, b].into_iter().flat_map(|mover| mover.motion.corner_displacements(mover.places[0]));
    let others = [(a, b), (b, a)]
        .into_iter()
        .flat_map(|(from, other)| other.motion.corner_displacements(from.places[0]));
    corners.zip(others).all(|(one, other)| (one - other).hypot() <= 0.05 + 0.02 * one.hypot())
}

/// A motion in words: `1.4 px right`, `turned by 3°`.
pub(crate) fn motion(motion: &Motion, place: Rect, unit: UnitFormat) -> String {
    let (scale, turn) = (motion.scale(), motion.turn());
    let reach = place.width().max(place.height()) / 2.0;
    let grown =
        (scale - 1.0).abs() * reach > 0.05 && (scale - 1.0).abs() > tolerances::MIN_STATED_GROWTH_SHARE;
    let turned = turn.abs().to_radians() * reach > 0.05 && turn.abs() > 0.05;
    let way = unit.sides(motion.displacement(place.center()));
    let mut words = Vec::new();
    if grown {
        words.push(format!("{} times as large", crate::diff::shapes::ink::trimmed(scale)));
    }
    if turned {
        let side = if turn > 0.0 { "clockwise" } else { "counter-clockwise" };
        words.push(format!(
            "turned by {}° {side}",
            crate::diff::shapes::ink::trimmed((turn.abs() * 100.0).round() / 100.0)
        ));
    }
    if !way.is_empty() {
        words.push(if words.is_empty() { way } else { format!("its middle {way}") });
    }
    words.join(", ")
}

/// Materials that changed their colour; marks without a material form one group.
fn recoloured(diff: &Diff, free: &mut [bool]) -> Vec<Cause> {
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, finding) in diff.findings.iter().enumerate().filter(|(index, _)| free[*index]) {
        let [change] = finding.changes.as_slice() else { continue };
        if finding.verdict != Verdict::Restyled || change.what != "colour" {
            continue;
        }
        let name = match &finding.material {
            Some(material) => format!("material `{material}`"),
            None => "marks of no material".to_owned(),
        };
        groups.entry(name).or_default().push(index);
    }
    let mut causes = Vec::new();
    for (name, findings) in groups {
        if findings.len() <= MAX_UNGROUPED_FINDINGS {
            continue;
        }
        let mut changes: BTreeMap<(&str, &str), usize> = BTreeMap::new();
        for finding in findings.iter().map(|index| &diff.findings[*index]) {
            for change in &finding.changes {
                *changes.entry((&change.old, &change.new)).or_default() += 1;
            }
        }
        let mut changes: Vec<((&str, &str), usize)> = changes.into_iter().collect();
        changes.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let told: Vec<String> =
            changes.iter().take(MAX_NAMED_COLOURS).map(|((old, new), _)| format!("{old} → {new}")).collect();
        let more = match changes.len().saturating_sub(MAX_NAMED_COLOURS) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        findings.iter().for_each(|index| free[*index] = false);
        let whose = whose(diff, &findings);
        let sentence = format!("{name}: colour {}{more} ({whose})", told.join(", "));
        causes.push(Cause { verdict: Verdict::Restyled, sentence, findings });
    }
    causes
}

/// Pen changes shared by lines of several parts: width, dash, ends, corners or colour. One sentence for each
/// change.
fn pen_causes(diff: &Diff, free: &mut [bool]) -> Vec<Cause> {
    let mut groups: BTreeMap<&[Change], Vec<usize>> = BTreeMap::new();
    for (index, finding) in diff.findings.iter().enumerate().filter(|(index, _)| free[*index]) {
        let is_pen = |change: &Change| {
            matches!(change.what.as_str(), "width" | "dash" | "ends" | "corners" | "colour")
        };
        if finding.verdict == Verdict::Restyled
            && finding.kind == ShapeKind::Line
            && !finding.changes.is_empty()
            && finding.changes.iter().all(is_pen)
        {
            groups.entry(&finding.changes).or_default().push(index);
        }
    }
    let mut causes = Vec::new();
    for (changes, findings) in groups {
        let parts: BTreeSet<_> = findings.iter().map(|index| &diff.findings[*index].label.part).collect();
        if findings.len() <= MAX_UNGROUPED_FINDINGS || parts.len() < 2 {
            continue;
        }
        findings.iter().for_each(|index| free[*index] = false);
        let sentence = format!("the pen: {} ({})", changed(changes), whose(diff, &findings));
        causes.push(Cause { verdict: Verdict::Restyled, sentence, findings });
    }
    causes
}

impl UnitFormat {
    /// A shift in words: `3 px right, 4 px down`.
    fn sides(self, way: Vec2) -> String {
        let side = |value: f64, plus: &str, minus: &str| {
            let told = self.length(value.abs());
            // A length that rounds to 0 is left out.
            let nothing = told.starts_with("0 ");
            (!nothing).then(|| format!("{told} {}", if value > 0.0 { plus } else { minus }))
        };
        let parts: Vec<String> =
            side(way.x, "right", "left").into_iter().chain(side(way.y, "down", "up")).collect();
        parts.join(", ")
    }
}
