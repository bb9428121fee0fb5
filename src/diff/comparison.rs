//! Comparison of two pictures, from shapes to a [`Diff`].

use std::panic::{AssertUnwindSafe, catch_unwind};

use kurbo::{Point, Rect};

use super::DiffOptions;
use super::causes::camera_change;
use super::causes::cause_sentences;
use super::causes::moved_parts;
use super::causes::whole_motion;
use super::changes::line_findings;
use super::changes::missing_labels;
use super::changes::outline_findings;
use super::changes::region_findings;
use super::changes::stacking_order;
use super::changes::{self, Renamed};
use super::curves::chain::{self, OutlineChain};
use super::findings::pixel_count;
use super::matching::equal_shapes;
use super::raster_check::{self, RasterVerdict};
use super::report::text_report;
use crate::diff::causes::cause_sentences::MovedPart;
use crate::diff::causes::motion::Motion;
use crate::diff::changes::finding_writer::FindingWriter;
use crate::diff::findings::finding::{Cause, Change, Diff, Finding, Stage, Verdict};
use crate::diff::findings::ink_totals::Totals;
use crate::diff::matching::chain_events::{ChainEvent, events};
use crate::diff::matching::interval_cover::cover;
use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::ink::trimmed;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::mark_groups::MarkGroups;
use crate::diff::shapes::picture::{Picture, ShapeKind};
use crate::diff::shapes::tolerance_table::{Tolerances, default_px};
use crate::drawing::{Length, Unit};

/// Stack size for the recursion over nested elements, independent of the calling thread.
const STACK_BYTES: usize = 64 << 20;

/// Compares two pictures; see [`super::compare`].
pub(crate) fn compare(before: &Picture, after: &Picture, options: &DiffOptions) -> Diff {
    let mut diff = Diff {
        findings: Vec::new(),
        causes: Vec::new(),
        same_at: None,
        totals: Totals::default(),
        tolerance_px: options
            .tolerances
            .all
            .map_or_else(|| default_px(before, after), |length| length.in_unit(crate::drawing::Unit::Px)),
        unused_tolerances: options.tolerances.unused([before, after]),
        pictures_unknown: false,
        is_brief: false,
        pixels: None,
        before: before.clone(),
        after: after.clone(),
    };
    diff.totals = Totals::of(before, after);
    if before.svg == after.svg {
        diff.same_at = Some(Stage::Bytes);
        return diff;
    }
    let (kept_before, kept_after) =
        (without_ignored(before, options.ignore), without_ignored(after, options.ignore));
    find_changes(&mut diff, [&kept_before, &kept_after], options);
    if options.pixels {
        diff.pixels = pixel_count::compare(before, after);
        if diff.pixels.as_ref().is_some_and(|pixels| !pixels.is_same()) {
            diff.same_at = None;
        }
    }
    diff
}

/// A picture without ignored shapes.
fn without_ignored(picture: &Picture, ignore: Ignore) -> Picture {
    let mut picture = picture.clone();
    if picture.shapes.iter().any(|shape| ignore.leaves_out(shape)) {
        picture.shapes = picture.shapes.iter().filter(|shape| !ignore.leaves_out(shape)).cloned().collect();
    }
    picture
}

/// Finds the changes of two pictures and their causes.
fn find_changes(diff: &mut Diff, pictures: [&Picture; 2], options: &DiffOptions) {
    let [before, after] = pictures;
    // If one drawing lost all labels, labels cannot identify marks.
    let unlabelled_side = missing_labels::labelled_side(pictures).filter(|_| !options.ignore.labels);
    let mut ignore = options.ignore;
    ignore.labels |= unlabelled_side.is_some();
    if options.brief && unlabelled_side.is_none() && report_camera_change(diff, pictures, options) {
        return;
    }
    let page_finding = page(before, after);
    let mut compared = compare_marks(pictures, &options.tolerances, ignore);
    let renamed = (!ignore.labels).then(|| changes::renamed(pictures, &compared.findings)).flatten();
    let (pictures, names) = match &renamed {
        Some(Renamed { before, findings }) => ([before, pictures[1]], findings.clone()),
        None => (pictures, Vec::new()),
    };
    let [before, after] = pictures;
    if renamed.is_some() {
        compared = compare_marks(pictures, &options.tolerances, ignore);
        diff.totals = Totals::of(before, after);
    }
    let raster_verdict = compare_rasters(pictures, &compared.findings, options, ignore);
    diff.pictures_unknown = matches!(raster_verdict, RasterVerdict::Unknown);
    let mut additional_findings: Vec<Finding> = page_finding.into_iter().chain(names).collect();
    match raster_verdict {
        RasterVerdict::Same => {
            let mark_findings = std::mem::take(&mut compared.findings);
            let count_before = mark_findings.len();
            compared.findings = raster_check::without_picture(mark_findings, pictures, ignore);
            compared.is_one_picture = compared.findings.len() < count_before;
            if compared.is_one_picture {
                compared.moved_parts.clear();
            }
        }
        RasterVerdict::Differs(raster_findings) => additional_findings.extend(raster_findings),
        RasterVerdict::Unknown => {}
    }
    // All marks moved alike: report one motion of the whole drawing.
    let mut causes = Vec::new();
    let unequal_shapes = &compared.unequal_shapes;
    if let Some(motion) =
        whole_motion::common_shift(&mut compared.findings, before, &unequal_shapes[0], diff.tolerance_px)
    {
        causes.push(sentence(diff, &motion, pictures, compared.findings.len(), diff.tolerance_px));
    } else if compared.findings.len() > 2
        && let Some(motion) = whole_motion::whole(pictures, unequal_shapes, default_px(before, after))
        && let Some((remaining_findings, cause)) =
            whole_motion_findings(diff, &motion, pictures, &compared, &options.tolerances, ignore)
    {
        compared.findings = remaining_findings;
        compared.moved_parts.clear();
        causes.push(cause);
    }
    assemble_result(diff, pictures, additional_findings, compared, causes, unlabelled_side);
}

/// Reports a change of camera in one finding; returns `false` for all other changes.
fn report_camera_change(diff: &mut Diff, pictures: [&Picture; 2], options: &DiffOptions) -> bool {
    let groups = MarkGroups::new(pictures, &options.tolerances, options.ignore);
    let shape_matching = equal_shapes::part(pictures[0], pictures[1], &groups);
    let Some((finding, cause)) = camera_change::find(pictures, &shape_matching, diff.tolerance_px) else {
        return false;
    };
    if page(pictures[0], pictures[1]).is_some()
        || !matches!(compare_rasters(pictures, &[], options, options.ignore), RasterVerdict::Differs(_))
    {
        return false;
    }
    (diff.findings, diff.causes, diff.is_brief) = (vec![finding], vec![cause], true);
    true
}

/// Compares the pixels of two pictures. The renderer needs a large stack for nested references, and it may
/// panic.
fn compare_rasters(
    pictures: [&Picture; 2],
    findings: &[Finding],
    options: &DiffOptions,
    ignore: Ignore,
) -> RasterVerdict {
    let groups = MarkGroups::new(pictures, &options.tolerances, ignore);
    let decide = || raster_check::decide(pictures, findings, &groups, ignore);
    on_large_stack(2, decide).unwrap_or(RasterVerdict::Unknown)
}

/// Runs a function on threads with a large stack; `None` if it panics.
pub(crate) fn on_large_stack<T: Send>(threads: usize, function: impl FnOnce() -> T + Send) -> Option<T> {
    let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_BYTES).build();
    pool.ok()?.install(|| catch_unwind(AssertUnwindSafe(function))).ok()
}

/// Combines findings, causes and totals into the result.
fn assemble_result(
    diff: &mut Diff,
    pictures: [&Picture; 2],
    mut additional_findings: Vec<Finding>,
    mut compared: MarkComparison,
    mut causes: Vec<Cause>,
    unlabelled_side: Option<usize>,
) {
    let is_same_structure = compared.unequal_shapes.iter().all(Vec::is_empty) && unlabelled_side.is_none();
    diff.findings.append(&mut additional_findings);
    diff.findings.append(&mut compared.findings);
    if let Some(side) = unlabelled_side {
        let findings = missing_labels::findings(pictures[side], &diff.findings, side);
        causes.extend(missing_labels::cause(&findings, side));
        diff.findings.extend(findings);
    }
    sort(&mut diff.findings);
    // Findings have their final indexes now, so causes can refer to them.
    for cause in &mut causes {
        let follows = |finding: &Finding| match cause.verdict {
            Verdict::Relabelled => finding.verdict == Verdict::Relabelled,
            _ => finding.verdict == Verdict::Page || finding.follows_motion,
        };
        let matching_findings = diff.findings.iter().enumerate().filter(|(_, finding)| follows(finding));
        cause.findings = matching_findings.map(|(index, _)| index).collect();
    }
    diff.causes = causes;
    let further_causes = cause_sentences::causes(diff, &compared.moved_parts);
    diff.causes.extend(further_causes);
    if diff.findings.is_empty() {
        diff.same_at = Some(match (compared.is_one_picture, is_same_structure) {
            (true, _) => Stage::Picture,
            (_, true) => Stage::Structure,
            _ => Stage::Geometry,
        });
    }
}

/// Sorts findings: the most serious first, then by part, class and place.
fn sort(findings: &mut [Finding]) {
    findings.sort_by(|a, b| {
        (a.verdict, &a.label)
            .cmp(&(b.verdict, &b.label))
            .then(a.place.y.total_cmp(&b.place.y))
            .then(a.place.x.total_cmp(&b.place.x))
            .then(b.size.total_cmp(&a.size))
    });
}

/// Findings that remain after a motion of the whole drawing, and its cause; `None` if the motion explains
/// less than three quarters.
fn whole_motion_findings(
    diff: &Diff,
    whole: &whole_motion::WholeMotion,
    pictures: [&Picture; 2],
    compared: &MarkComparison,
    tolerances: &Tolerances,
    ignore: Ignore,
) -> Option<(Vec<Finding>, Cause)> {
    let mut tolerances = tolerances.clone();
    let motion_tolerance = Length::px(whole.reach);
    let requested_px = tolerances.all.map_or(0.0, |all| all.in_unit(Unit::Px));
    if requested_px < whole.reach {
        tolerances.all = Some(motion_tolerance);
    }
    let candidate_findings = whole
        .carried
        .iter()
        .map(|carried| compare_marks([carried, pictures[1]], &tolerances, ignore).findings);
    let fewest_findings = candidate_findings.min_by_key(Vec::len)?;
    if fewest_findings.len() * 4 > compared.findings.len() {
        return None;
    }
    let carried_findings =
        whole_motion::findings(pictures[0], &compared.unequal_shapes[0], &whole.motion, &fewest_findings);
    if carried_findings.is_empty() {
        return None;
    }
    let cause = sentence(diff, &whole.motion, pictures, carried_findings.len(), whole.reach);
    Some((fewest_findings.into_iter().chain(carried_findings).collect(), cause))
}

/// The motion of the whole drawing as a cause, without its findings.
fn sentence(diff: &Diff, motion: &Motion, pictures: [&Picture; 2], count: usize, tolerance: f64) -> Cause {
    let unit = diff.unit();
    let page_rect = Rect::new(0.0, 0.0, pictures[0].width, pictures[0].height);
    let mut description = cause_sentences::motion(motion, page_rect, unit);
    // A drawing scaled from the page's corner does not move.
    if motion.displacement(Point::ORIGIN).hypot() <= tolerance
        && let Some((growth_text, _)) = description.split_once(", its middle")
    {
        description.truncate(growth_text.len());
    }
    let page = match page(pictures[0], pictures[1]) {
        Some(page) => format!(" ({})", text_report::changed(&page.changes)),
        None => String::new(),
    };
    let tolerance_text = unit.length(tolerance);
    let sentence =
        format!("the whole drawing {description}{page}: {count} marks, as they were within {tolerance_text}");
    Cause { verdict: Verdict::Moved, sentence, findings: Vec::new() }
}

/// Result of comparing all marks.
struct MarkComparison {
    findings: Vec<Finding>,
    /// Shapes of each picture without an equal.
    unequal_shapes: [Vec<usize>; 2],
    /// Parts that moved as a whole.
    moved_parts: Vec<MovedPart>,
    /// Whether findings were dropped because the drawings look the same.
    is_one_picture: bool,
}

/// Compares all marks of two pictures.
fn compare_marks(pictures: [&Picture; 2], tolerances: &Tolerances, ignore: Ignore) -> MarkComparison {
    let [before, after] = pictures;
    let groups = MarkGroups::new(pictures, tolerances, ignore);
    let equal_shapes::ShapeMatching { equal: mut equal_pairs, unequal_shapes: unmatched } =
        equal_shapes::part(before, after, &groups);
    let mut findings = Vec::new();
    let mut movers = Vec::new();
    if !unmatched.iter().all(Vec::is_empty) {
        (findings, movers) = compare_unequal(pictures, &unmatched, &groups, ignore, &mut equal_pairs);
    }
    findings.extend(stacking_order::findings(before, after, equal_pairs));
    MarkComparison { findings, unequal_shapes: unmatched, moved_parts: movers, is_one_picture: false }
}

/// Changes of the shapes without an equal. Shapes that did not move are added to `stayed`.
fn compare_unequal(
    [before, after]: [&Picture; 2],
    unequal_shapes: &[Vec<usize>; 2],
    groups: &MarkGroups,
    ignore: Ignore,
    stayed: &mut Vec<(usize, usize)>,
) -> (Vec<Finding>, Vec<MovedPart>) {
    let chains = |side: usize| {
        let picture = [before, after][side];
        chain::chains_of_shapes(picture, &unequal_shapes[side], &groups.of_shape[side], groups)
    };
    let sides = cover([chains(0), chains(1)], groups);
    for (chain, cover) in sides[0].chains.iter().zip(&sides[0].covers).filter(|(_, cover)| cover.is_whole()) {
        let partner = cover.partners.first().and_then(|(partner, ..)| sides[1].chains.get(*partner as usize));
        let first_shape = |chain: &OutlineChain| chain.shapes.first().copied();
        stayed.extend(first_shape(chain).zip(partner.and_then(first_shape)));
    }
    let page = before.width.max(before.height).max(after.width.max(after.height));
    let events = events(&sides, groups, page);
    let finding_writer = FindingWriter { pictures: [before, after], sides: &sides, ignore };
    let is_of_line = |event: &ChainEvent| {
        let chain = event.old.map(|old| &sides[0].chains[old]).or(event.new.map(|new| &sides[1].chains[new]));
        let group = chain.and_then(|chain| groups.groups.get(chain.group));
        group.is_none_or(|group| group.kind == ShapeKind::Line)
    };
    let (events_of_lines, region_events): (Vec<_>, Vec<_>) = events.into_iter().partition(is_of_line);
    let mut findings = line_findings::findings(&finding_writer, events_of_lines);
    findings.extend(region_findings::findings(&finding_writer, region_events));
    if !ignore.widths {
        findings.extend(outline_findings::findings(&finding_writer, groups));
    }
    let movers = moved_parts::find_moved_parts([before, after], unequal_shapes, &findings);
    (findings, movers)
}

/// A finding if the page has another size.
fn page(before: &Picture, after: &Picture) -> Option<Finding> {
    let size = |picture: &Picture| format!("{} x {} px", trimmed(picture.width), trimmed(picture.height));
    let tolerance = default_px(before, after);
    let differs = (before.width - after.width).abs().max((before.height - after.height).abs()) > tolerance;
    differs.then(|| {
        let change = Change { what: "size".to_owned(), old: size(before), new: size(after) };
        let (width, height) = (before.width.max(after.width), before.height.max(after.height));
        let place = Rect::new(0.0, 0.0, width, height);
        Finding {
            size: before.width * before.height,
            growth: after.width * after.height - before.width * before.height,
            ..Finding::in_place(Verdict::Page, Label::default(), vec![change], place)
        }
    })
}
