//! [`EdgeSet`]: set of edges of a mesh, as a bit set.

use crate::parallel::prelude::*;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Set of edges of one mesh.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct EdgeSet {
    /// 64 edges per word; empty if the set is.
    words: Vec<u64>,
}

impl EdgeSet {
    /// The edges below `count` that satisfy `holds`.
    #[must_use]
    pub(crate) fn collect(count: usize, holds: impl Fn(usize) -> bool + Sync) -> Self {
        let word = |k: usize| {
            let edges = 64 * k..(64 * (k + 1)).min(count);
            edges.fold(0u64, |word, edge| word | u64::from(holds(edge)) << (edge % 64))
        };
        let words: Vec<u64> =
            (0..count.div_ceil(64)).into_par_iter().with_min_len(MIN_TASK_ITEMS / 64).map(word).collect();
        if words.iter().all(|word| *word == 0) { Self::default() } else { Self { words } }
    }

    /// Whether the set contains an edge.
    #[inline]
    #[must_use]
    pub(crate) fn contains(&self, edge: usize) -> bool {
        self.words.get(edge / 64).is_some_and(|word| word >> (edge % 64) & 1 == 1)
    }

    /// Whether the set is empty.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Calls `does` with each edge, in parallel.
    pub(crate) fn par_for_each(&self, does: impl Fn(usize) + Sync) {
        self.words.par_iter().enumerate().with_min_len(MIN_TASK_ITEMS / 64).for_each(|(k, word)| {
            let mut word = *word;
            while word != 0 {
                does(64 * k + word.trailing_zeros() as usize);
                word &= word - 1;
            }
        });
    }

    /// The edges, ascending.
    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().filter(|(_, word)| **word != 0).flat_map(|(k, word)| {
            (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| 64 * k + bit)
        })
    }

    /// The set with more edges added; the mesh has `count` edges.
    #[must_use]
    pub(crate) fn with(&self, more: &[usize], count: usize) -> Self {
        if more.is_empty() {
            return self.clone();
        }
        let mut words = self.words.clone();
        words.resize(count.div_ceil(64), 0);
        more.iter().for_each(|edge| words[edge / 64] |= 1 << (edge % 64));
        Self { words }
    }

    /// The edges of both sets.
    #[must_use]
    pub(crate) fn union(&self, other: &Self) -> Self {
        match (self.words.is_empty(), other.words.is_empty()) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => Self { words: self.words.iter().zip(&other.words).map(|(a, b)| a | b).collect() },
        }
    }

    /// The set as edges of a finer mesh with `count` edges. `ids` maps the edges of this mesh to it, with
    /// `u32::MAX` for edges that were cut; `pieces` lists cut edges, each with one of its pieces.
    #[must_use]
    pub(crate) fn refined(&self, ids: &[u32], pieces: &[(u32, usize)], count: usize) -> Self {
        let own = pieces.iter().filter(|(edge, _)| self.contains(*edge as usize)).map(|(_, piece)| *piece);
        self.remapped(ids, count).with(&own.collect::<Vec<_>>(), count)
    }

    /// The set in a derived mesh with `count` edges. `ids` maps the edges of this mesh to it, `u32::MAX` for
    /// edges that are gone.
    #[must_use]
    pub(crate) fn remapped(&self, ids: &[u32], count: usize) -> Self {
        let mut words = Vec::new();
        for edge in self.iter().map(|edge| ids[edge]).filter(|edge| *edge != u32::MAX) {
            if words.is_empty() {
                words = vec![0u64; count.div_ceil(64)];
            }
            words[edge as usize / 64] |= 1 << (edge % 64);
        }
        Self { words }
    }
}
