//! [`UnionFind`] and [`DisjointSets`]: sets that grow by joining pairs of numbers, and the finished sets.
//!
//! Numbers form trees, and a join links the greater root below the smaller one. The root of a set is therefore
//! always its smallest member, in any order of joins. Any thread may join pairs.
//!
//! Source: Jayanti and Tarjan, "Concurrent disjoint set union", 2021. The order of numbers replaces their
//! random order.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::parallel::prelude::*;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Sets of the numbers below a count, which joins make larger.
#[derive(Debug)]
pub(crate) struct UnionFind {
    /// Parent of each number. A root is its own parent.
    parents: Vec<AtomicU32>,
}

impl UnionFind {
    /// One set per number.
    pub(crate) fn new(count: usize) -> Self {
        let numbers = (0..count as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        Self { parents: numbers.map(AtomicU32::new).collect() }
    }

    /// The root of a set: its smallest member, if no set was merged by [`UnionFind::join_into`].
    ///
    /// Halves the path. Concurrent changes keep the invariant: all ancestors of a number belong to its set, and
    /// each is smaller than its child.
    pub(crate) fn root(&self, mut number: u32) -> u32 {
        let above = |number: u32| self.parents[number as usize].load(Relaxed);
        loop {
            let next = above(number);
            if next == number {
                return number;
            }
            let after = above(next);
            if after == next {
                return next;
            }
            self.parents[number as usize].store(after, Relaxed);
            number = after;
        }
    }

    /// Joins the sets of two numbers.
    pub(crate) fn join(&self, mut a: u32, mut b: u32) {
        loop {
            (a, b) = (self.root(a), self.root(b));
            let (least, most) = (a.min(b), a.max(b));
            // Another thread may have linked the root in the meantime.
            if a == b || self.parents[most as usize].compare_exchange(most, least, Relaxed, Relaxed).is_ok() {
                return;
            }
        }
    }

    /// Merges the set with the root `from` into the one with the root `to`, which stays the root. Not for
    /// sets that other threads join.
    pub(crate) fn join_into(&mut self, from: u32, to: u32) {
        *self.parents[from as usize].get_mut() = to;
    }
}

/// Finished disjoint sets, each identified by its smallest member.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct DisjointSets {
    first: Vec<u32>,
}

impl DisjointSets {
    /// The sets of `count` numbers. `joins` calls its argument with pairs, on any threads and in any order.
    #[must_use]
    pub(crate) fn new(count: usize, joins: impl FnOnce(&(dyn Fn(u32, u32) + Sync))) -> Self {
        let sets = UnionFind::new(count);
        joins(&|a, b| sets.join(a, b));
        // A separate list, because path halving on another thread may overwrite an entry with an older value.
        let numbers = (0..count as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        Self { first: numbers.map(|number| sets.root(number)).collect() }
    }

    /// The smallest member of the set of a number.
    #[inline]
    #[must_use]
    pub(crate) fn representative(&self, number: u32) -> u32 {
        self.first[number as usize]
    }

    /// For each number, the smallest member of its set.
    #[must_use]
    pub(crate) fn into_representatives(self) -> Vec<u32> {
        self.first
    }

    /// Numbers the sets in the order of their smallest members. Where `instead` returns a value for the smallest
    /// member of a set, that value is stored and the set gets no number.
    #[must_use]
    pub(crate) fn numbered(self, instead: impl Fn(u32) -> Option<u32>) -> NumberedSets {
        let Self { first: mut set_of_face } = self;
        let mut first = Vec::new();
        for face in 0..set_of_face.len() {
            let root = set_of_face[face] as usize;
            // The root has the smallest number, so it is done already.
            set_of_face[face] = if root == face {
                instead(face as u32).unwrap_or_else(|| {
                    first.push(face as u32);
                    first.len() as u32 - 1
                })
            } else {
                set_of_face[root]
            };
        }
        NumberedSets { set_of_face, first }
    }
}

/// Disjoint sets with consecutive numbers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct NumberedSets {
    /// Set number of each face.
    pub set_of_face: Vec<u32>,
    /// The smallest face of each set.
    pub first: Vec<u32>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn disjoint_sets_are_named_by_their_least_face_in_any_join_order() {
        let pairs = [[5, 6], [1, 3], [6, 3], [2, 4]];
        for turn in 0..pairs.len() {
            let groups = DisjointSets::new(8, |join| {
                for k in 0..pairs.len() {
                    let [a, b] = pairs[(k + turn) % pairs.len()];
                    join(b, a);
                }
            });
            assert_eq!(groups.first, [0, 1, 2, 1, 2, 1, 1, 7]);
            let numbered = groups.numbered(|face| (face == 0).then_some(u32::MAX));
            assert_eq!(numbered.first, [1, 2, 7]);
            assert_eq!(numbered.set_of_face, [u32::MAX, 0, 1, 0, 1, 0, 0, 2]);
        }
    }

    #[test]
    fn disjoint_sets_may_be_joined_in_parallel() {
        // Pairs that connect distant numbers; multiples of seven stay alone.
        let count = 100_000_u32;
        let pairs: Vec<[u32; 2]> = (0..count)
            .map(|k| if k % 2 == 0 { k } else { count - k })
            .map(|k| [k, (u64::from(k) * 48_271 % u64::from(count)) as u32])
            .filter(|pair| pair.iter().all(|k| k % 7 != 0))
            .collect();
        let pool = rayon_core::ThreadPoolBuilder::new().num_threads(4).build().expect("a pool");
        let groups = pool.install(|| {
            DisjointSets::new(count as usize, |join| pairs.par_iter().for_each(|[a, b]| join(*a, *b)))
        });
        // Reference: the smallest number is propagated until nothing changes.
        let mut plain: Vec<u32> = (0..count).collect();
        let mut before = Vec::new();
        while before != plain {
            before.clone_from(&plain);
            for pair in &pairs {
                let least = pair.map(|k| plain[k as usize]).into_iter().min().unwrap_or_default();
                pair.iter().for_each(|k| plain[*k as usize] = least);
            }
        }
        assert_eq!(groups.first, plain);
        // Set numbers count the first faces before theirs, except multiples of 14.
        let counts = |first: u32| !first.is_multiple_of(14);
        let numbered = groups.numbered(|first| (!counts(first)).then_some(9));
        let firsts: Vec<u32> = (0..count).filter(|k| plain[*k as usize] == *k && counts(*k)).collect();
        assert!(numbered.first == firsts && firsts.len() > 5000);
        let number = |first: &u32| firsts.binary_search(first).map_or(9, |at| at as u32);
        assert_eq!(numbered.set_of_face, plain.iter().map(number).collect::<Vec<_>>());
    }

    #[test]
    fn concurrent_joins_of_one_root_all_take_effect() {
        // Every join links the last face to a smaller root than before.
        let (threads, each) = (4, 50_000_u32);
        let last = threads * each;
        let pool =
            rayon_core::ThreadPoolBuilder::new().num_threads(threads as usize).build().expect("a pool");
        // Enough repetitions for two joins to collide.
        for _ in 0..40 {
            let groups = pool.install(|| {
                DisjointSets::new(last as usize + 1, |join| {
                    let joins = |own: u32| (0..each).rev().for_each(|k| join(threads * k + own, last));
                    (0..threads).into_par_iter().with_max_len(1).for_each(joins);
                })
            });
            assert!(groups.first.iter().all(|first| *first == 0));
        }
    }
}
