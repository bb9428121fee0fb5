//! Findings about lines: what became of each, and of its width along it.

use kurbo::{BezPath, Rect, Shape as _};
use rayon::prelude::*;

use super::chain::{self, Chain};
use super::distance::apart;
use super::events::Event;
use super::finding::{Change, Finding, Place, Verdict};
use super::groups::Groups;
use super::ink::trimmed;
use super::pair::bounds;
use super::picture::{Shape, ShapeKind};
use super::teller::{Teller, changes, label};

/// One finding a line that something happened to.
pub(super) fn findings(teller: &Teller, events: Vec<Event>) -> Vec<Finding> {
    events.into_par_iter().map(|event| one(teller, event)).collect()
}

/// What became of one line.
fn one(teller: &Teller, event: Event) -> Finding {
    let chain = |side: usize, index: Option<usize>| index.map(|index| &teller.sides[side].chains[index]);
    let (old, new) = (chain(0, event.old), chain(1, event.new));
    let shapes = [old.and_then(|c| teller.shape(0, c)), new.and_then(|c| teller.shape(1, c))];
    let length = |chain: Option<&Chain>| chain.map_or(0.0, Chain::length);
    let boxes = [(0, old), (1, new)].into_iter().filter_map(|(_, c)| Some(bounds(&c?.points)));
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
        growth: if old.is_some() && new.is_some() { growth(&event, length(old), length(new)) } else { 0.0 },
        largest: event.largest,
        p95: event.p95,
        shift: event.shift,
        gone: event.gone,
        new: event.added,
    }
}

/// Lines whose middle is the same and whose width varies differently.
pub(super) fn outlines(teller: &Teller, groups: &Groups) -> Vec<Finding> {
    let mut found = Vec::new();
    for (chain, cover) in teller.sides[0].chains.iter().zip(&teller.sides[0].covers) {
        let Some(shape) = teller.shape(0, chain).filter(|s| s.outline.is_some() && chain.shapes.len() == 1)
        else {
            continue;
        };
        let partner = cover.partners.first().map(|(partner, ..)| &teller.sides[1].chains[*partner as usize]);
        let Some(partner) = partner.filter(|partner| cover.is_same() && partner.shapes.len() == 1) else {
            continue;
        };
        let Some(other) = teller.shape(1, partner) else { continue };
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
            let place = Place::of(bounds(&chain.points));
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
