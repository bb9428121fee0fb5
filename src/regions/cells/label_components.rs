//! [`LabelComponents`]: connected triangles of equal label, with small patches merged into their neighbours.

use crate::geometry::lists::disjoint_sets::UnionFind;
use std::collections::{BTreeMap, BTreeSet};

use super::triangulation::{OUTSIDE, Triangulation};

/// Connected triangles of equal label.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct LabelComponents {
    /// Patch of each triangle.
    pub component_of_triangle: Vec<u32>,
    /// Label of each patch.
    pub labels: Vec<u32>,
    /// Twice the area of each patch, squared grid steps.
    pub area2: Vec<f64>,
}

/// Collects triangles of equal label into patches, and merges small ones into a neighbour.
///
/// A patch with less than `crumb2` (twice the area) goes to the neighbour with the longest shared border,
/// smallest patch first. The label `background` receives none, since a model must not get holes. Patches with
/// only background around them stay.
pub(crate) fn gather(
    triangulation: &Triangulation,
    labels_by_triangle: &[u32],
    background: u32,
    crumb2: f64,
) -> LabelComponents {
    let (of, count) = triangulation.flooded(|a, _, b| labels_by_triangle[a] == labels_by_triangle[b]);
    let mut patches =
        LabelComponents { component_of_triangle: of, labels: vec![0; count], area2: vec![0.0; count] };
    let mut shared: Vec<BTreeMap<u32, f64>> = vec![BTreeMap::new(); count];
    for (triangle, triangle_label) in labels_by_triangle.iter().enumerate() {
        let own_component = patches.component_of_triangle[triangle];
        patches.labels[own_component as usize] = *triangle_label;
        patches.area2[own_component as usize] += triangulation.area2(triangle);
        for side in 0..3 {
            let next = triangulation.neighbours[triangle][side];
            if next != OUTSIDE && patches.component_of_triangle[next as usize] != own_component {
                *shared[own_component as usize]
                    .entry(patches.component_of_triangle[next as usize])
                    .or_default() += triangulation.side(triangle, side);
            }
        }
    }
    let mut merging = Merging { sets: UnionFind::new(count), shared, background };
    // Areas as bits, which sort like positive numbers.
    let mut small: BTreeSet<(u64, u32)> = (0..count as u32)
        .filter(|p| patches.area2[*p as usize] < crumb2)
        .map(|p| (patches.area2[p as usize].to_bits(), p))
        .collect();
    while let Some((_, crumb)) = small.pop_first() {
        let Some(to) = merging.neighbour(crumb, &patches) else { continue };
        // Patches of one label on both sides of a small patch are joined.
        let mut joined = vec![crumb];
        joined.extend(merging.alike(crumb, to, &patches));
        for patch in joined {
            let area = std::mem::take(&mut patches.area2[patch as usize]);
            small.remove(&(area.to_bits(), patch));
            small.remove(&(patches.area2[to as usize].to_bits(), to));
            patches.area2[to as usize] += area;
            merging.join(patch, to);
        }
        if patches.area2[to as usize] < crumb2 {
            small.insert((patches.area2[to as usize].to_bits(), to));
        }
    }
    for patch in &mut patches.component_of_triangle {
        *patch = merging.sets.root(*patch);
    }
    patches
}

struct Merging {
    sets: UnionFind,
    /// For each remaining patch, the lengths of its borders with neighbours.
    shared: Vec<BTreeMap<u32, f64>>,
    background: u32,
}

impl Merging {
    /// Neighbour with the longest shared border, background excluded.
    fn neighbour(&self, crumb: u32, patches: &LabelComponents) -> Option<u32> {
        let is_background = |p: u32| patches.labels[p as usize] == self.background;
        let others = self.shared[crumb as usize].iter().filter(|(other, _)| !is_background(**other));
        let longest = others.fold(None, |most: Option<(u32, f64)>, (other, length)| match most {
            Some((_, greatest)) if greatest >= *length => most,
            _ => Some((*other, *length)),
        });
        longest.map(|(other, _)| other)
    }

    /// Neighbours of a small patch with the label of the patch it is merged into.
    fn alike(&self, crumb: u32, to: u32, patches: &LabelComponents) -> Vec<u32> {
        let look = patches.labels[to as usize];
        let others = self.shared[crumb as usize].keys().copied();
        others.filter(|other| *other != to && patches.labels[*other as usize] == look).collect()
    }

    fn join(&mut self, patch: u32, to: u32) {
        self.sets.join_into(patch, to);
        let borders = std::mem::take(&mut self.shared[patch as usize]);
        self.shared[to as usize].remove(&patch);
        for (other, length) in borders {
            if other == to {
                continue;
            }
            self.shared[other as usize].remove(&patch);
            *self.shared[to as usize].entry(other).or_default() += length;
            *self.shared[other as usize].entry(to).or_default() += length;
        }
    }
}
