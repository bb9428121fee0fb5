//! Parts that have another name in the new drawing.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use kurbo::{Rect, Shape as _};

use crate::diff::curves::region_area::size;
use crate::diff::findings::finding::{Change, Finding, Verdict};
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};

/// The old drawing with the new names, and a finding for each name.
pub(crate) struct Renamed {
    pub before: Picture,
    pub findings: Vec<Finding>,
}

/// Finds renamed parts from the relabelled marks; `None` if there are none.
pub(crate) fn renamed(pictures: [&Picture; 2], findings: &[Finding]) -> Option<Renamed> {
    let parts: [BTreeSet<&Arc<str>>; 2] =
        pictures.map(|picture| picture.shapes.iter().filter_map(|shape| shape.label.part.as_ref()).collect());
    let mut names: BTreeMap<Arc<str>, Arc<str>> = BTreeMap::new();
    let mut refused: BTreeSet<Arc<str>> = BTreeSet::new();
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Relabelled) {
        let Some(change) = finding.changes.iter().find(|change| change.what == "part") else { continue };
        let [old, new]: [Arc<str>; 2] = [Arc::from(change.old.as_str()), Arc::from(change.new.as_str())];
        let is_one = parts[0].contains(&old)
            && parts[1].contains(&new)
            && !parts[1].contains(&old)
            && !parts[0].contains(&new);
        match names.get(&old) {
            Some(known) if *known != new => drop(refused.insert(old)),
            _ if is_one => drop(names.insert(old, new)),
            _ => {}
        }
    }
    names.retain(|old, _| !refused.contains(old));
    // Two parts that were merged are not one renamed part.
    let mut counts: BTreeMap<Arc<str>, usize> = BTreeMap::new();
    names.values().for_each(|new| *counts.entry(Arc::clone(new)).or_default() += 1);
    names.retain(|_, new| counts.get(new) == Some(&1));
    if names.is_empty() {
        return None;
    }
    let of_part = |shape: &Shape| names.get_key_value(shape.label.part.as_ref()?);
    let mut places: BTreeMap<&Arc<str>, (Rect, f64)> = BTreeMap::new();
    let mut shapes = pictures[0].shapes.to_vec();
    for shape in &mut shapes {
        let Some((old, new)) = of_part(shape) else { continue };
        let bounds = shape.path.bounding_box();
        let length = if shape.kind == ShapeKind::Line { size(shape) } else { 0.0 };
        let entry = places.entry(old).or_insert((bounds, 0.0));
        *entry = (entry.0.union(bounds), entry.1 + length);
        shape.label = Arc::new(Label { part: Some(Arc::clone(new)), ..(*shape.label).clone() });
    }
    let findings = places.into_iter().map(|(old, (place, length))| {
        let change = Change {
            what: "part".to_owned(),
            old: old.to_string(),
            new: names.get(old).map(ToString::to_string).unwrap_or_default(),
        };
        let label = Label { part: Some(Arc::clone(old)), ..Label::default() };
        Finding {
            kind: ShapeKind::Line,
            size: length,
            added_path: place.to_path(0.1),
            ..Finding::in_place(Verdict::Relabelled, label, vec![change], place)
        }
    });
    let findings = findings.collect();
    Some(Renamed { before: Picture { shapes: Arc::from(shapes), ..pictures[0].clone() }, findings })
}
