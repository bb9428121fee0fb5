//! From two pictures to a [`Diff`].

use kurbo::Rect;

use super::DiffOptions;
use super::chain;
use super::cover::cover;
use super::events::{Event, events};
use super::exact;
use super::finding::{Change, Diff, Finding, Place, Stage, Verdict};
use super::grid::SegmentCells;
use super::groups::Groups;
use super::ink::trimmed;
use super::label::Label;
use super::lines;
use super::pair::Side;
use super::picture::{Picture, ShapeKind};
use super::pixels;
use super::regions;
use super::stacking;
use super::teller::Teller;
use super::tolerance::default_px;
use super::totals::Totals;

/// Compares two pictures, see [`super::compare`].
pub(super) fn compare(before: &Picture, after: &Picture, options: &DiffOptions) -> Diff {
    let mut diff = Diff {
        findings: Vec::new(),
        same_at: None,
        totals: Totals::default(),
        tolerance_px: options
            .tolerances
            .all
            .map_or_else(|| default_px(before, after), |length| length.in_unit(crate::drawing::Unit::Px)),
        unused_tolerances: options.tolerances.unused([before, after]),
        pixels: None,
        before: before.clone(),
        after: after.clone(),
    };
    diff.totals = Totals::of(before, after);
    if before.svg == after.svg {
        diff.same_at = Some(Stage::Bytes);
        return diff;
    }
    diff.findings.extend(page(before, after));
    let groups = Groups::new([before, after], &options.tolerances);
    let exact::Parted { equal: mut stayed, rest } = exact::part(before, after, &groups);
    let structure = rest.iter().all(Vec::is_empty);
    if !structure {
        diff.findings.extend(findings(before, after, &rest, &groups, &mut stayed));
    }
    diff.findings.extend(stacking::findings(before, after, stayed));
    diff.findings.sort_by(|a, b| {
        (a.verdict, &a.label)
            .cmp(&(b.verdict, &b.label))
            .then(a.place.y.total_cmp(&b.place.y))
            .then(a.place.x.total_cmp(&b.place.x))
            .then(b.size.total_cmp(&a.size))
    });
    if diff.findings.is_empty() {
        diff.same_at = Some(if structure { Stage::Structure } else { Stage::Geometry });
    }
    if options.pixels {
        diff.pixels = pixels::compare(before, after);
        if diff.pixels.as_ref().is_some_and(|pixels| !pixels.is_same()) {
            diff.same_at = None;
        }
    }
    diff
}

/// What became of the shapes that have no equal; those that lie where they lay are added to what stayed.
fn findings(
    before: &Picture,
    after: &Picture,
    rest: &[Vec<usize>; 2],
    groups: &Groups,
    stayed: &mut Vec<(usize, usize)>,
) -> Vec<Finding> {
    let chains = [
        chain::of(before, &rest[0], &groups.of_shape[0], groups),
        chain::of(after, &rest[1], &groups.of_shape[1], groups),
    ];
    let firsts = [chain::firsts(&chains[0]), chain::firsts(&chains[1])];
    let grid = |side: usize| {
        let chains = chains[side].iter().enumerate();
        SegmentCells::of(chains.filter(|(index, _)| firsts[side].get(*index) == Some(index)))
    };
    let all = |side: usize| (chains[side].as_slice(), firsts[side].as_slice());
    let covers = [cover(all(0), all(1), &grid(1), groups), cover(all(1), all(0), &grid(0), groups)];
    let ([a, b], [cover_a, cover_b], [firsts_a, firsts_b]) = (chains, covers, firsts);
    let sides = [
        Side { chains: a, firsts: firsts_a, covers: cover_a },
        Side { chains: b, firsts: firsts_b, covers: cover_b },
    ];
    for (chain, cover) in sides[0].chains.iter().zip(&sides[0].covers).filter(|(_, cover)| cover.is_whole()) {
        let partner = cover.partners.first().and_then(|(partner, ..)| sides[1].chains.get(*partner as usize));
        stayed.extend(
            chain.shapes.first().copied().zip(partner.and_then(|other| other.shapes.first().copied())),
        );
    }
    let page = before.width.max(before.height).max(after.width.max(after.height));
    let events = events(&sides, groups, page);
    let teller = Teller { pictures: [before, after], sides: &sides };
    let (events_of_lines, borders): (Vec<Event>, Vec<Event>) = events.into_iter().partition(|event| {
        let chain = event.old.map(|old| &sides[0].chains[old]).or(event.new.map(|new| &sides[1].chains[new]));
        chain
            .and_then(|chain| groups.groups.get(chain.group))
            .is_none_or(|group| group.kind == ShapeKind::Line)
    });
    let mut findings = lines::findings(&teller, events_of_lines);
    findings.extend(regions::findings(&teller, borders));
    findings.extend(lines::outlines(&teller, groups));
    findings
}

/// The page, if it has another size.
fn page(before: &Picture, after: &Picture) -> Option<Finding> {
    let size = |picture: &Picture| format!("{} x {} px", trimmed(picture.width), trimmed(picture.height));
    let tolerance = default_px(before, after);
    let differs = (before.width - after.width).abs().max((before.height - after.height).abs()) > tolerance;
    differs.then(|| {
        let change = Change { what: "size".to_owned(), old: size(before), new: size(after) };
        let (width, height) = (before.width.max(after.width), before.height.max(after.height));
        let place = Place::of(Rect::new(0.0, 0.0, width, height));
        Finding {
            size: before.width * before.height,
            growth: after.width * after.height - before.width * before.height,
            ..Finding::in_place(Verdict::Page, ShapeKind::Region, Label::default(), vec![change], place)
        }
    })
}
