//! Labels that another program left out: the one drawing has parts and classes, the other has none.

use std::sync::Arc;

use rustc_hash::FxHashSet;

use super::finding::{Cause, Change, Finding, Place, PlaceKey, Verdict};
use super::label::Label;
use super::picture::{Picture, Shape, ShapeKind};

/// The drawing that has labels, where the other one has none; layers alone are none, programs make their own.
pub(super) fn lost(pictures: [&Picture; 2]) -> Option<usize> {
    let has = pictures.map(|picture| picture.shapes.iter().any(is_labelled));
    let drawn = pictures.iter().all(|picture| !picture.shapes.is_empty());
    match has {
        [true, false] if drawn => Some(0),
        [false, true] if drawn => Some(1),
        _ => None,
    }
}

fn is_labelled(shape: &Shape) -> bool {
    shape.label.part.is_some() || !shape.label.classes.is_empty()
}

/// A finding for each mark whose label is not in the other drawing, but for those that are only in the one.
pub(super) fn findings(labelled: &Picture, others: &[Finding], side: usize) -> Vec<Finding> {
    let alone = [Verdict::Removed, Verdict::Added][side];
    let lonely: FxHashSet<(PlaceKey, &Label)> =
        others.iter().filter(|f| f.verdict == alone).map(|f| (f.place.key(), &f.label)).collect();
    let marks = labelled.shapes.iter().filter(|shape| is_labelled(shape) && shape.kind != ShapeKind::Clip);
    let one = |shape: &Shape| {
        let place = Place::of(kurbo::Shape::bounding_box(&shape.path));
        if lonely.contains(&(place.key(), &*shape.label)) {
            return None;
        }
        let mut changes = Vec::new();
        let mut note = |what: &str, was: String| {
            let words = [was, "none".to_owned()];
            let [old, new] = if side == 0 { words } else { [words[1].clone(), words[0].clone()] };
            changes.push(Change { what: what.to_owned(), old, new });
        };
        if let Some(part) = &shape.label.part {
            note("part", part.to_string());
        }
        if !shape.label.classes.is_empty() {
            note("class", shape.label.classes.join(" "));
        }
        let size = match shape.kind {
            ShapeKind::Line => kurbo::Shape::perimeter(&shape.path, 1e-3),
            _ => super::area::area(shape),
        };
        let label: Label = (*shape.label).clone();
        Some(Finding {
            size,
            new: shape.path.clone(),
            material: shape.material.as_ref().map(Arc::clone),
            ..Finding::in_place(Verdict::Relabelled, shape.kind, label, changes, place)
        })
    };
    marks.filter_map(one).collect()
}

/// All of it in one sentence.
pub(super) fn cause(findings: &[Finding], side: usize) -> Option<Cause> {
    let count = findings.len();
    let which = ["new", "old"][side];
    let sentence = format!("{count} marks: the {which} drawing says of none which part and class it is of");
    (count > 0).then(|| Cause { verdict: Verdict::Relabelled, sentence, findings: Vec::new() })
}
