//! Labels lost in another program: one drawing has parts and classes, the other has none.

use kurbo::Rect;
use rustc_hash::FxHashMap;

use crate::diff::curves::region_area::size;
use crate::diff::findings::finding::{Cause, Change, Finding, Verdict};
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};

/// Index of the labelled drawing if the other one has no labels. Layers do not count, because programs create
/// their own.
pub(crate) fn labelled_side(pictures: [&Picture; 2]) -> Option<usize> {
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

/// Positions in findings are rounded by less than this.
const ROUNDING_PX: f64 = 0.02;
/// Most findings of one label searched per mark.
const MAX_PLACES_PER_LABEL: usize = 2000;

/// A finding for each mark whose label is missing in the other drawing, except marks that exist in one
/// drawing only.
pub(crate) fn findings(labelled: &Picture, others: &[Finding], side: usize) -> Vec<Finding> {
    let alone = [Verdict::Removed, Verdict::Added][side];
    // Removed lines are reported as joined chains. The box of a chain contains each of its pieces.
    let mut lonely: FxHashMap<&Label, Vec<Rect>> = FxHashMap::default();
    for finding in others.iter().filter(|finding| finding.verdict == alone) {
        let place = finding.place.rect().inflate(ROUNDING_PX, ROUNDING_PX);
        lonely.entry(&finding.label).or_default().push(place);
    }
    let marks = labelled.shapes.iter().filter(|shape| is_labelled(shape) && shape.kind != ShapeKind::Clip);
    let one = |shape: &Shape| {
        let bounds = kurbo::Shape::bounding_box(&shape.path);
        let is_alone = |places: &Vec<Rect>| {
            places.iter().take(MAX_PLACES_PER_LABEL).any(|place| place.contains_rect(bounds))
        };
        if lonely.get(&*shape.label).is_some_and(is_alone) {
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
        Some(Finding {
            size: size(shape),
            added_path: shape.path.clone(),
            ..Finding::of_shape(Verdict::Relabelled, shape, changes, bounds)
        })
    };
    marks.filter_map(one).collect()
}

/// The cause for all these findings.
pub(crate) fn cause(findings: &[Finding], side: usize) -> Option<Cause> {
    let count = findings.len();
    let which = ["new", "old"][side];
    let sentence = format!("{count} marks: the {which} drawing stores no parts and classes");
    (count > 0).then(|| Cause { verdict: Verdict::Relabelled, sentence, findings: Vec::new() })
}
