//! Chains without smoothing, simplification, tidying or fitting cover exactly the visible lines of the view
//! map.

use crate::support::measures::segment_sets::{doubled, length, uncovered};
use crate::support::pipeline::{counting, stages};
use crate::support::properties::subject;
use crate::support::properties::table::{CAMERAS, KINDS};
use ligne::chains::{self, ChainOptions};
use ligne::drawing::{Length, Unit};
use ligne::lines::HiddenLines;

#[test]
fn plain_chains_are_the_visible_lines_each_once() {
    let off = Length::px(0.0);
    let options =
        ChainOptions { smooth: off, simplify: off, tidy: off, fit: false, ..ChainOptions::default() };
    for subject in subject::random(&KINDS, &CAMERAS, 15) {
        let drawn = stages(&subject.scene, &subject.camera, &counting());
        let chains = chains::link(&drawn.map, &options, Unit::Px, HiddenLines::None);
        let mut inked = Vec::new();
        for chain in chains.iter().filter(|c| c.invisibility == 0) {
            inked.extend(chain.points.windows(2).map(|w| [w[0], w[1]]));
            if let (true, [first, .., last]) = (chain.closed, chain.points.as_slice()) {
                inked.push([*last, *first]);
            }
        }
        let visible = drawn.visible();
        let lost = uncovered(&visible, &inked, 1e-6);
        let added = uncovered(&inked, &visible, 1e-6);
        let name = &subject.name;
        assert!(lost <= 0.05 && added <= 0.05, "{name}: {lost} lost, {added} added of {}", length(&visible));
        let (twice, before) = (doubled(&inked, 1e-4), doubled(&visible, 1e-4));
        assert!(twice <= before + 0.05, "{name}: {twice} drawn twice, {before} before chaining");
        assert!((length(&inked) - length(&visible)).abs() <= 0.1, "{name}");
    }
}
