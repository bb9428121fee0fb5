//! From two pictures to a [`Diff`].

use kurbo::{BezPath, Rect, Shape as _};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::DiffOptions;
use super::area::area;
use super::chain::{self, Chain};
use super::cover::cover;
use super::distance::apart;
use super::events::{Event, events};
use super::exact;
use super::finding::{Change, Diff, Finding, Place, Stage, Verdict};
use super::grid::Grid;
use super::groups::Groups;
use super::ink::trimmed;
use super::label::Label;
use super::pair::Side;
use super::picture::{Picture, Shape, ShapeKind};
use super::pixels;
use super::regions;
use super::stacking;
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
    let grids = [Grid::new(&chains[0]), Grid::new(&chains[1])];
    let covers =
        [cover(&chains[0], &chains[1], &grids[1], groups), cover(&chains[1], &chains[0], &grids[0], groups)];
    let [a, b] = chains;
    let [cover_a, cover_b] = covers;
    let sides = [Side { chains: a, covers: cover_a }, Side { chains: b, covers: cover_b }];
    for (chain, cover) in sides[0].chains.iter().zip(&sides[0].covers).filter(|(_, cover)| cover.is_whole()) {
        let partner = cover.partners.first().and_then(|(partner, ..)| sides[1].chains.get(*partner as usize));
        stayed.extend(
            chain.shapes.first().copied().zip(partner.and_then(|other| other.shapes.first().copied())),
        );
    }
    let page = before.width.max(before.height).max(after.width.max(after.height));
    let events = events(&sides, groups, page);
    let teller = Teller { pictures: [before, after], sides: &sides };
    let (lines, borders): (Vec<Event>, Vec<Event>) = events.into_iter().partition(|event| {
        let chain = event.old.map(|old| &sides[0].chains[old]).or(event.new.map(|new| &sides[1].chains[new]));
        chain
            .and_then(|chain| groups.groups.get(chain.group))
            .is_none_or(|group| group.kind == ShapeKind::Line)
    });
    let mut findings: Vec<Finding> = lines.into_par_iter().map(|event| teller.line(event)).collect();
    findings.extend(regions::findings(&teller, borders));
    findings.extend(teller.outlines(groups));
    findings
}

/// Turns events into findings.
pub(super) struct Teller<'a> {
    pub pictures: [&'a Picture; 2],
    pub sides: &'a [Side; 2],
}

impl<'a> Teller<'a> {
    /// A shape that a chain is made of.
    pub(super) fn shape(&self, side: usize, chain: &Chain) -> Option<&'a Shape> {
        self.pictures[side].shapes.get(*chain.shapes.first()?)
    }

    fn line(&self, event: Event) -> Finding {
        let chain = |side: usize, index: Option<usize>| index.map(|index| &self.sides[side].chains[index]);
        let (old, new) = (chain(0, event.old), chain(1, event.new));
        let shapes = [old.and_then(|c| self.shape(0, c)), new.and_then(|c| self.shape(1, c))];
        let length = |chain: Option<&Chain>| chain.map_or(0.0, Chain::length);
        let boxes =
            [(0, old), (1, new)].into_iter().filter_map(|(_, c)| Some(super::pair::bounds(&c?.points)));
        // Where only a piece differs, the piece is the place.
        let pieces = [&event.gone, &event.added].into_iter().filter(|path| !path.elements().is_empty());
        let pieces: Vec<Rect> = pieces.map(BezPath::bounding_box).collect();
        let place = match event.verdict {
            Verdict::Moved => union(boxes),
            _ => union(pieces.into_iter()).or(union(boxes)),
        };
        let size = match event.verdict {
            Verdict::Reshaped | Verdict::Moved => length(old).max(0.0),
            _ => event.size,
        };
        Finding {
            verdict: event.verdict,
            kind: shapes.iter().flatten().next().map_or(ShapeKind::Line, |shape| shape.kind),
            label: label(shapes),
            changes: changes(shapes),
            place: Place::of(place.unwrap_or_default()),
            size,
            growth: if old.is_some() && new.is_some() {
                growth(&event, length(old), length(new))
            } else {
                0.0
            },
            largest: event.largest,
            p95: event.p95,
            shift: event.shift,
            gone: event.gone,
            new: event.added,
        }
    }

    /// Lines whose middle is the same and whose width varies differently.
    fn outlines(&self, groups: &Groups) -> Vec<Finding> {
        let mut found = Vec::new();
        for (chain, cover) in self.sides[0].chains.iter().zip(&self.sides[0].covers) {
            let Some(shape) = self.shape(0, chain).filter(|s| s.outline.is_some() && chain.shapes.len() == 1)
            else {
                continue;
            };
            let partner =
                cover.partners.first().map(|(partner, ..)| &self.sides[1].chains[*partner as usize]);
            let Some(partner) = partner.filter(|partner| cover.is_same() && partner.shapes.len() == 1) else {
                continue;
            };
            let Some(other) = self.shape(1, partner) else { continue };
            let tolerance = groups.groups.get(chain.group).map_or(0.01, |group| group.tolerance);
            let rings = |shape: &Shape| chain::rings(shape.outline.as_ref(), tolerance);
            let (old, new) = (rings(shape), rings(other));
            if old.is_empty() || new.is_empty() {
                continue;
            }
            // Rings stand in an order of their own, so that each has its like in the same place.
            let widest = old.iter().zip(&new).map(|(old, new)| apart(old, new).largest).fold(0.0, f64::max);
            if old.len() != new.len() || widest > tolerance {
                let change = Change {
                    what: "width along the line".to_owned(),
                    old: format!("{} px on average", trimmed(shape.ink.width)),
                    new: format!("up to {} px wider or thinner", trimmed(2.0 * widest)),
                };
                let place = Place::of(super::pair::bounds(&chain.points));
                let (kind, label) = (ShapeKind::Line, (*shape.label).clone());
                found.push(Finding {
                    size: cover.length,
                    new: shape.path.clone(),
                    ..Finding::in_place(Verdict::Restyled, kind, label, vec![change], place)
                });
            }
        }
        found
    }
}

/// How much longer a line became: where it is made of several pieces now, what was gained less what was lost.
fn growth(event: &Event, old: f64, new: f64) -> f64 {
    if event.gone.elements().is_empty() != event.added.elements().is_empty() {
        return event.added.perimeter(1e-3) - event.gone.perimeter(1e-3);
    }
    new - old
}

fn union(boxes: impl Iterator<Item = Rect>) -> Option<Rect> {
    boxes.reduce(|a, b| a.union(b))
}

/// The label of a finding: the old one, if there is an old one.
pub(super) fn label(shapes: [Option<&Shape>; 2]) -> Label {
    shapes.into_iter().flatten().next().map_or_else(Label::default, |shape| (*shape.label).clone())
}

/// What else differs between two shapes.
pub(super) fn changes(shapes: [Option<&Shape>; 2]) -> Vec<Change> {
    let [Some(old), Some(new)] = shapes else { return Vec::new() };
    let mut changes: Vec<Change> = Vec::new();
    for (what, was, is) in old.ink.changes(&new.ink) {
        changes.push(Change { what: what.to_owned(), old: was, new: is });
    }
    // One of the two may be grouped by part, and have no layers at all.
    let layered = !old.label.layer.is_empty() && !new.label.layer.is_empty();
    let mut note = |what: &str, differs: bool, word: &dyn Fn(&Label) -> String| {
        if differs {
            changes.push(Change { what: what.to_owned(), old: word(&old.label), new: word(&new.label) });
        }
    };
    note("part", old.label.part != new.label.part, &|label| label.part_name().to_owned());
    note("class", old.label.classes != new.label.classes, &|label| label.classes.join(" "));
    note("layer", layered && old.label.layer != new.label.layer, &|label| label.layer.to_string());
    changes
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

/// The area of each shape that is asked for, measured once.
#[derive(Default)]
pub(super) struct Areas(FxHashMap<(usize, usize), f64>);

impl Areas {
    pub(super) fn of(&mut self, pictures: [&Picture; 2], side: usize, shape: usize) -> f64 {
        *self.0.entry((side, shape)).or_insert_with(|| pictures[side].shapes.get(shape).map_or(0.0, area))
    }
}
