//! Changes that must not change a drawing: position and scale, numbering, order of parts, splits of flat
//! faces, winding, hidden parts and thread count.
//!
//! `support/properties/table` lists the drawing options and the bounds for each property.

use crate::support::properties::bound::Bound;
use crate::support::properties::change::{Change, Property};
use crate::support::properties::numbering::renumbered_obj;
use crate::support::properties::option_set::{COMIC, ENGRAVING, SUGGESTIVE, TECHNICAL};
use crate::support::properties::subject::{Subject, example};
use crate::support::properties::table::{LONG_ROWS, ROWS};
use crate::support::properties::{Job, holds};
use crate::support::scenes::random_dice::Dice;

#[test]
fn place_and_size_change_nothing() {
    holds(ROWS, Property::Place);
}

#[test]
fn numbering_changes_nothing() {
    holds(ROWS, Property::Numbering);
}

#[test]
#[ignore = "long: .ci/nightly"]
fn numbering_changes_nothing_of_shared_models() {
    holds(LONG_ROWS, Property::Numbering);
}

#[test]
fn the_order_of_parts_changes_nothing() {
    holds(ROWS, Property::OrderOfParts);
}

#[test]
fn splitting_flat_faces_changes_nothing() {
    holds(ROWS, Property::Cuts);
}

#[test]
fn winding_changes_nothing() {
    holds(ROWS, Property::Winding);
}

#[test]
fn what_is_hidden_changes_nothing() {
    holds(ROWS, Property::HiddenThings);
}

#[test]
fn threads_change_nothing() {
    holds(ROWS, Property::Threads);
}

#[test]
fn lines_of_an_obj_file_may_stand_in_any_order() {
    for (name, ways) in [("gear.obj", [TECHNICAL, ENGRAVING]), ("teapot.obj", [SUGGESTIVE, COMIC])] {
        let text = std::fs::read_to_string(example(name)).unwrap();
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
fn a_change_that_must_be_seen_is_told_by_every_bound() {
    let mut told: Vec<&[Bound]> = Vec::new();
    for row in ROWS {
        for (_, bounds) in row.unchanged_by {
            if told.contains(bounds) {
                continue;
            }
            told.push(bounds);
            let (options, subject) = (row.options[0], (row.subjects)().remove(0));
            let changes = vec![(Change::Grown, *bounds)];
            let faults = Job { options, subject, changes, least: row.least, seed: 1 }.faults();
            assert_eq!(faults.len(), bounds.len(), "{bounds:?} only tell\n{}", faults.join("\n"));
        }
    }
    assert!(told.len() > 10, "{told:?}");
}

#[test]
fn changes_change_what_is_drawn() {
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
