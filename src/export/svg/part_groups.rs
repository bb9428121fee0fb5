//! Marks grouped by part, without changing the picture.
//!
//! A line of one part may cover the fill of its neighbour and vice versa. So a part is split into several
//! groups where one group would reverse such an order. Two marks keep their order if they may touch and have
//! different colours. All other marks of a part share a group.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::Arc;

use crate::parallel::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::page_cells::PageCells;
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, Layer, Mark, OutlinePaint, Paint};

/// Consecutive marks of one part.
#[derive(Debug, Default)]
pub(crate) struct PartGroup<'a> {
    /// Name of the part; `None` for marks without a part.
    pub name: Option<Arc<str>>,
    pub marks: Vec<&'a Mark>,
    /// Whether any mark belongs to an ordered layer.
    pub ordered: bool,
}

/// Marks of one layer and one part that stay together.
struct PartBundle<'a> {
    part: usize,
    marks: Vec<&'a Mark>,
    ordered: bool,
}

/// Marks of a drawing grouped by part, back to front.
pub(crate) fn part_groups(drawing: &Drawing) -> Vec<PartGroup<'_>> {
    let mut names: Vec<Option<Arc<str>>> = Vec::new();
    let bundles = bundles(drawing, &mut names);
    let after = precedence(&bundles, &PageCells::of(&drawing.page));
    let mut groups: Vec<PartGroup> = Vec::new();
    let mut last = None;
    for index in schedule(&bundles, &after) {
        let Some(bundle) = bundles.get(index) else { continue };
        if last != Some(bundle.part) {
            let name = names.get(bundle.part).cloned().flatten();
            groups.push(PartGroup { name, ..PartGroup::default() });
            last = Some(bundle.part);
        }
        if let Some(group) = groups.last_mut() {
            group.marks.extend(&bundle.marks);
            group.ordered |= bundle.ordered;
        }
    }
    groups
}

/// Bundles of marks in painting order; `names` receives the names of the parts by number.
fn bundles<'a>(drawing: &'a Drawing, names: &mut Vec<Option<Arc<str>>>) -> Vec<PartBundle<'a>> {
    let mut numbers: FxHashMap<Option<&str>, usize> = FxHashMap::default();
    let mut bundles: Vec<PartBundle> = Vec::new();
    for layer in &drawing.layers {
        let begin = bundles.len();
        let exchangeable = is_of_one_colour(layer);
        let mut of_part: FxHashMap<usize, usize> = FxHashMap::default();
        for mark in &layer.marks {
            let name = mark.provenance.part.as_ref();
            let part = *numbers.entry(name.map(AsRef::as_ref)).or_insert_with(|| {
                names.push(name.cloned());
                names.len() - 1
            });
            let open = match exchangeable {
                true => of_part.get(&part).copied(),
                false => {
                    bundles.len().checked_sub(1).filter(|last| *last >= begin && bundles[*last].part == part)
                }
            };
            let index = open.unwrap_or_else(|| {
                bundles.push(PartBundle { part, marks: Vec::new(), ordered: layer.ordered });
                bundles.len() - 1
            });
            of_part.insert(part, index);
            if let Some(bundle) = bundles.get_mut(index) {
                bundle.marks.push(mark);
            }
        }
    }
    bundles
}

/// Whether the marks of a layer may be painted in any order.
fn is_of_one_colour(layer: &Layer) -> bool {
    let mut colours = layer.marks.iter().map(colour);
    let first = colours.next().flatten();
    first.is_some() && colours.all(|other| other == first)
}

/// Colour of a mark of a single colour.
fn colour(mark: &Mark) -> Option<Colour> {
    match &mark.paint {
        Paint::Stroke(stroke) => Some(stroke.colour),
        Paint::Fill(colour) | Paint::Outline(OutlinePaint { colour, .. }) => Some(*colour),
        Paint::Gradient(_) | Paint::Image(_) => None,
    }
}

/// For each bundle, the bundles that must be painted after it.
fn precedence(bundles: &[PartBundle], cells: &PageCells) -> Vec<Vec<usize>> {
    // Bundles painted in each cell, back to front.
    let mut painted: Vec<(u32, usize, Option<Colour>)> = bundles
        .par_iter()
        .enumerate()
        .flat_map_iter(|(index, bundle)| {
            let mut own: Vec<_> = bundle
                .marks
                .iter()
                .flat_map(|mark| cells.cells_of(mark).into_iter().map(|cell| (cell, index, colour(mark))))
                .collect();
            own.dedup();
            own
        })
        .collect();
    // A stable sort keeps the order of marks within a bundle.
    painted.par_sort_by_key(|(cell, index, _)| (*cell, *index));
    painted.dedup();
    let mut known: FxHashSet<(usize, usize)> = FxHashSet::default();
    let mut after = vec![Vec::new(); bundles.len()];
    for cell in painted.chunk_by(|a, b| a.0 == b.0) {
        let runs: Vec<_> = cell.chunk_by(|a, b| a.2.is_some() && a.2 == b.2).collect();
        for pair in runs.windows(2) {
            for (_, below, _) in pair[0] {
                for (_, above, _) in pair[1] {
                    if below != above && known.insert((*below, *above)) {
                        after[*below].push(*above);
                    }
                }
            }
        }
    }
    after
}

/// Topological order of the bundles that continues each part as long as possible.
fn schedule(bundles: &[PartBundle], after: &[Vec<usize>]) -> Vec<usize> {
    let mut waits = vec![0_usize; bundles.len()];
    after.iter().flatten().for_each(|above| waits[*above] += 1);
    let parts = bundles.iter().map(|bundle| bundle.part + 1).max().unwrap_or(0);
    // Bundles ready to be painted, by part, in original order.
    let mut ready: Vec<BinaryHeap<Reverse<usize>>> = vec![BinaryHeap::new(); parts];
    let mut firsts: BinaryHeap<Reverse<(usize, usize)>> = BinaryHeap::new();
    let mut order = Vec::with_capacity(bundles.len());
    for (index, bundle) in bundles.iter().enumerate().filter(|(index, _)| waits[*index] == 0) {
        ready[bundle.part].push(Reverse(index));
        firsts.push(Reverse((index, bundle.part)));
    }
    while let Some(Reverse((_, part))) = firsts.pop() {
        while let Some(Reverse(index)) = ready[part].pop() {
            order.push(index);
            for above in &after[index] {
                waits[*above] -= 1;
                if waits[*above] == 0 {
                    ready[bundles[*above].part].push(Reverse(*above));
                    firsts.push(Reverse((*above, bundles[*above].part)));
                }
            }
        }
    }
    order
}
