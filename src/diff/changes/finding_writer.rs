//! [`Teller`]: what findings are told from, and what those of lines and of regions have in common.

use crate::diff::curves::chain::Chain;
use crate::diff::findings::finding::Change;
use crate::diff::matching::chain_pairs::Side;
use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape};

/// Both pictures, and their chains with what covers them.
pub(crate) struct Teller<'a> {
    pub pictures: [&'a Picture; 2],
    pub sides: &'a [Side; 2],
    /// What does not count.
    pub ignore: Ignore,
}

impl<'a> Teller<'a> {
    /// A shape that a chain is made of.
    pub(crate) fn shape(&self, side: usize, chain: &Chain) -> Option<&'a Shape> {
        self.pictures[side].shapes.get(*chain.shapes.first()?)
    }

    /// What else differs between two shapes, of what counts.
    pub(crate) fn changes(&self, shapes: [Option<&Shape>; 2]) -> Vec<Change> {
        let mut changes = changes(shapes);
        changes.retain(|change| self.ignore.counts(&change.what));
        changes
    }
}

/// The label of a finding: the old one, if there is an old one.
pub(crate) fn label(shapes: [Option<&Shape>; 2]) -> Label {
    shapes.into_iter().flatten().next().map_or_else(Label::default, |shape| (*shape.label).clone())
}

/// What else differs between two shapes.
fn changes(shapes: [Option<&Shape>; 2]) -> Vec<Change> {
    let [Some(old), Some(new)] = shapes else { return Vec::new() };
    let mut changes: Vec<Change> = Vec::new();
    for (what, was, is) in old.ink.changes(&new.ink) {
        changes.push(Change { what, old: was, new: is });
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
