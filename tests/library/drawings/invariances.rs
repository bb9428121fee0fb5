//! Changes that must not change a drawing: position and scale, numbering, order of parts, splits of flat
//! faces, winding, hidden parts and thread count.
//!
//! `support/properties/table` lists the drawing options and the bounds for each property.

use crate::library::support::properties::bound::Bound;
use crate::library::support::properties::change::{Change, Property};
use crate::library::support::properties::numbering::renumbered_obj;
use crate::library::support::properties::option_set::{COMIC, ENGRAVING, SUGGESTIVE, TECHNICAL};
use crate::library::support::properties::subject::{Subject, example_path};
use crate::library::support::properties::table::{LONG_ROWS, ROWS};
use crate::library::support::properties::{InvarianceJob, assert_property};
use crate::library::support::scenes::random_dice::Dice;

#[test]
fn place_and_size_change_nothing() {
    assert_property(ROWS, Property::SimilarityTransform);
}

#[test]
fn numbering_changes_nothing() {
    assert_property(ROWS, Property::Numbering);
}

#[test]
#[ignore = "long: .ci/nightly"]
fn numbering_changes_nothing_of_shared_models() {
    assert_property(LONG_ROWS, Property::Numbering);
}

#[test]
fn the_order_of_parts_changes_nothing() {
    assert_property(ROWS, Property::PartOrder);
}

#[test]
fn splitting_flat_faces_changes_nothing() {
    assert_property(ROWS, Property::FaceSubdivision);
}

#[test]
fn winding_changes_nothing() {
    assert_property(ROWS, Property::Winding);
}

#[test]
fn hidden_objects_change_nothing() {
    assert_property(ROWS, Property::HiddenObjects);
}

#[test]
fn threads_change_nothing() {
    assert_property(ROWS, Property::Threads);
}

#[test]
fn line_order_of_obj_files_changes_nothing() {
    for (name, ways) in [("gear.obj", [TECHNICAL, ENGRAVING]), ("teapot.obj", [SUGGESTIVE, COMIC])] {
        let text = std::fs::read_to_string(example_path(name)).unwrap();
        let other = renumbered_obj(&text, &mut Dice::new(32));
        assert_ne!(text, other);
        let subjects = [text, other].map(|text| {
            let scene = ligne::load::obj::read_bytes(text.as_bytes(), "model", |_| None).unwrap();
            Subject::framed(name, scene, 300.0)
        });
        for way in ways {
            let [one, two] = subjects.each_ref().map(|subject| way.draw(subject));
            let same = Bound::Bytes.check(&one, &two);
            same.unwrap_or_else(|words| panic!("{name}, {}: {words}", way.name));
        }
    }
}

#[test]
fn every_bound_detects_a_visible_change() {
    let mut told: Vec<&[Bound]> = Vec::new();
    for row in ROWS {
        for (_, bounds) in row.unchanged_by {
            if told.contains(bounds) {
                continue;
            }
            told.push(bounds);
            let (options, subject) = (row.options[0], (row.subjects)().remove(0));
            let changes = vec![(Change::Grown, *bounds)];
            let faults = InvarianceJob { options, subject, changes, min_segments: row.min_segments, seed: 1 }
                .violations();
            assert_eq!(faults.len(), bounds.len(), "{bounds:?} only tell\n{}", faults.join("\n"));
        }
    }
    assert!(told.len() > 10, "{told:?}");
}

#[test]
fn every_change_modifies_its_subject() {
    let mut made: Vec<Change> = Vec::new();
    for row in ROWS {
        for (change, _) in row.unchanged_by.iter().filter(|(change, _)| change.threads().is_none()) {
            if made.contains(change) {
                continue;
            }
            made.push(*change);
            let one = (row.subjects)().remove(0);
            let other = change.apply(&one, &mut Dice::new(1));
            assert_ne!(format!("{one:?}"), format!("{other:?}"), "{change:?}");
        }
    }
    assert!(made.len() > 10, "{made:?}");
}
