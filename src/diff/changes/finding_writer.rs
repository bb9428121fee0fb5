//! Data and helpers shared by the findings about lines and regions.

use kurbo::Rect;

use crate::diff::curves::chain::OutlineChain;
use crate::diff::findings::finding::{Change, Finding, Verdict};
use crate::diff::matching::interval_cover::CoveredChains;
use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape};

/// Both pictures with their chains and covers.
pub(crate) struct FindingWriter<'a> {
    pub pictures: [&'a Picture; 2],
    pub sides: &'a [CoveredChains; 2],
    /// Aspects to ignore.
    pub ignore: Ignore,
}

impl<'a> FindingWriter<'a> {
    /// The first shape of a chain.
    pub(crate) fn shape(&self, side: usize, chain: &OutlineChain) -> Option<&'a Shape> {
        self.pictures[side].shapes.get(*chain.shapes.first()?)
    }

    /// Index of the first shape of a chain, given by its index.
    pub(crate) fn shape_index(&self, side: usize, chain: Option<usize>) -> Option<usize> {
        self.sides[side].chains.get(chain?)?.shapes.first().copied()
    }

    /// A finding about an old and a new shape, without measures. It has the label of the old shape if there is
    /// one.
    pub(crate) fn finding(&self, verdict: Verdict, shapes: [Option<&Shape>; 2], place: Rect) -> Finding {
        let mut changes = changes(shapes);
        changes.retain(|change| self.ignore.counts(&change.what));
        match shapes.into_iter().flatten().next() {
            Some(shape) => Finding::of_shape(verdict, shape, changes, place),
            None => Finding::in_place(verdict, Label::default(), changes, place),
        }
    }
}

/// Changed properties of a shape.
fn changes(shapes: [Option<&Shape>; 2]) -> Vec<Change> {
    let [Some(old), Some(new)] = shapes else { return Vec::new() };
    let mut changes: Vec<Change> = Vec::new();
    for (what, was, is) in old.ink.changes(&new.ink) {
        changes.push(Change { what, old: was, new: is });
    }
    // Drawings grouped by part have no layers.
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
