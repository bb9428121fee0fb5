//! Chains without smoothing, simplification, tidying or fitting cover exactly the visible lines of the view
//! map.

use crate::library::support::measures::segment_sets::{doubled_length, total_length, uncovered_length};
use crate::library::support::pipeline::{exact_options_with_hidden, run_stages};
use crate::library::support::properties::subject;
use crate::library::support::properties::table::{CAMERA_KINDS, SCENE_KINDS};
use ligne::chains::{self, ChainOptions};
use ligne::drawing::{Length, Unit};
use ligne::lines::HiddenLines;

#[test]
fn untidied_chains_cover_each_visible_line_once() {
    let off = Length::px(0.0);
    let options =
        ChainOptions { smooth: off, simplify: off, tidy: off, fit: false, ..ChainOptions::default() };
    for subject in subject::random_subjects(&SCENE_KINDS, &CAMERA_KINDS, 15) {
        let drawn = run_stages(&subject.scene, &subject.camera, &exact_options_with_hidden());
        let chains = chains::link(&drawn.map, &options, Unit::Px, HiddenLines::None);
        let mut inked = Vec::new();
        for chain in chains.iter().filter(|c| c.invisibility == 0) {
            inked.extend(chain.points.windows(2).map(|w| [w[0], w[1]]));
            if let (true, [first, .., last]) = (chain.closed, chain.points.as_slice()) {
                inked.push([*last, *first]);
            }
        }
        let visible = drawn.visible_segments();
        let lost = uncovered_length(&visible, &inked, 1e-6);
        let added = uncovered_length(&inked, &visible, 1e-6);
        let name = &subject.name;
        assert!(
            lost <= 0.05 && added <= 0.05,
            "{name}: {lost} lost, {added} added of {}",
            total_length(&visible)
        );
        let (twice, before) = (doubled_length(&inked, 1e-4), doubled_length(&visible, 1e-4));
        assert!(twice <= before + 0.05, "{name}: {twice} drawn twice, {before} before chaining");
        assert!((total_length(&inked) - total_length(&visible)).abs() <= 0.1, "{name}");
    }
}
