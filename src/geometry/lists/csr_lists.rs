//! [`CsrLists`]: a list of values for each group, in compressed sparse row (CSR) form, built by a counting
//! sort.

use std::ops::Range;

use crate::parallel::prelude::*;

/// Lists of values, one per group, in CSR form. Values of a group keep their order of insertion.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CsrLists<T> {
    /// Start of each group in `values`, and the end of the last; empty without groups.
    starts: Vec<u32>,
    values: Vec<T>,
}

impl<T> Default for CsrLists<T> {
    fn default() -> Self {
        Self { starts: Vec::new(), values: Vec::new() }
    }
}

/// Builds the lists of `count` groups from the pairs (group, value) that `fill` passes to its argument.
///
/// `fill` is called twice and must pass the same pairs both times.
pub(crate) fn csr_lists<T: Copy>(count: usize, fill: impl Fn(&mut dyn FnMut(usize, T))) -> CsrLists<T> {
    // Counting sort in one array: counts are stored two places ahead and become starts one place ahead.
    // Filling a group advances its start to its end, which is the start of the next group.
    let mut starts = vec![0u32; count + 2];
    let mut any = None;
    fill(&mut |group, value| {
        starts[group + 2] += 1;
        any = Some(value);
    });
    for group in 0..count {
        starts[group + 2] += starts[group + 1];
    }
    let mut values = any.map_or_else(Vec::new, |blank| vec![blank; starts[count + 1] as usize]);
    fill(&mut |group, value| {
        let next = &mut starts[group + 1];
        values[*next as usize] = value;
        *next += 1;
    });
    starts.truncate(count + 1);
    CsrLists { starts, values }
}

/// Builds the lists of `count` groups from an iterator of pairs, twice as fast as [`csr_lists`].
pub(crate) fn csr_lists_from_pairs<T: Copy>(
    count: usize,
    pairs: impl Iterator<Item = (usize, T)> + Clone,
) -> CsrLists<T> {
    let Some((_, blank)) = pairs.clone().next() else {
        return CsrLists { starts: vec![0; count + 1], values: Vec::new() };
    };
    // Counting sort as in `csr_lists`.
    let mut starts = vec![0u32; count + 2];
    pairs.clone().for_each(|(group, _)| starts[group + 2] += 1);
    for group in 0..count {
        starts[group + 2] += starts[group + 1];
    }
    let mut values = vec![blank; starts[count + 1] as usize];
    for (group, value) in pairs {
        let next = &mut starts[group + 1];
        values[*next as usize] = value;
        *next += 1;
    }
    starts.truncate(count + 1);
    CsrLists { starts, values }
}

/// Groups that one task rewrites.
const LISTS_PER_TASK: usize = 1 << 13;

impl<T: Copy> CsrLists<T> {
    /// Number of groups.
    pub(crate) fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Values of a group.
    #[inline]
    pub(crate) fn of(&self, group: usize) -> &[T] {
        &self.values[self.range(group)]
    }

    /// Mutable values of a group.
    pub(crate) fn of_mut(&mut self, group: usize) -> &mut [T] {
        let range = self.range(group);
        &mut self.values[range]
    }

    /// Values of consecutive groups.
    pub(crate) fn of_all(&self, groups: Range<usize>) -> &[T] {
        &self.values[self.starts[groups.start] as usize..self.starts[groups.end] as usize]
    }

    /// Range of a group's values within all values.
    #[inline]
    pub(crate) fn range(&self, group: usize) -> Range<usize> {
        self.starts[group] as usize..self.starts[group + 1] as usize
    }

    /// Rewrites each list that is not empty with `tidy`, which may sort, merge or remove values. Runs in
    /// parallel if there are many groups.
    pub(crate) fn tidied(self, tidy: impl Fn(usize, &mut Vec<T>) + Sync) -> Self
    where
        T: Send + Sync,
    {
        let count = self.count();
        let chunks = (count / LISTS_PER_TASK).max(1);
        let of_chunk = |chunk: usize| {
            let groups = chunk * count / chunks..(chunk + 1) * count / chunks;
            let mut ends = Vec::with_capacity(groups.len());
            let mut values = Vec::with_capacity(self.of_all(groups.clone()).len());
            let mut own: Vec<T> = Vec::new();
            for group in groups {
                let found = self.of(group);
                if !found.is_empty() {
                    own.clear();
                    own.extend_from_slice(found);
                    tidy(group, &mut own);
                    values.extend_from_slice(&own);
                }
                ends.push(values.len() as u32);
            }
            (ends, values)
        };
        let found: Vec<(Vec<u32>, Vec<T>)> =
            (0..chunks).into_par_iter().with_max_len(1).map(of_chunk).collect();
        let mut tidied = Self { starts: Vec::with_capacity(count + 1), values: Vec::new() };
        tidied.starts.push(0);
        tidied.values.reserve_exact(found.iter().map(|(_, values)| values.len()).sum());
        for (ends, values) in found {
            let before = tidied.values.len() as u32;
            tidied.starts.extend(ends.iter().map(|end| before + end));
            tidied.values.extend_from_slice(&values);
        }
        tidied
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lists_by_word_length(words: &[&'static str]) -> CsrLists<&'static str> {
        csr_lists(4, |put| words.iter().copied().for_each(|word| put(word.len(), word)))
    }

    #[test]
    fn csr_lists_keep_the_order_of_values_in_a_group() {
        let lengths = lists_by_word_length(&["an", "b", "of", "", "c", "to"]);
        assert_eq!((lengths.count(), lengths.of_all(0..4).len()), (4, 6));
        assert_eq!([lengths.of(0), lengths.of(1), lengths.of(3)], [&[""][..], &["b", "c"], &[]]);
        assert_eq!(lengths.of(2), ["an", "of", "to"]);
        assert_eq!(lengths.of_all(1..3), ["b", "c", "an", "of", "to"]);
        assert_eq!(lengths.range(2), 3..6);
    }

    #[test]
    fn csr_lists_may_have_empty_groups() {
        let none = lists_by_word_length(&[]);
        assert_eq!((none.count(), none.of(3).len()), (4, 0));
        assert_eq!(CsrLists::<u32>::default().count(), 0);
    }

    #[test]
    fn csr_lists_from_pairs_and_tidied_match_plain_lists() {
        let count = 3 * LISTS_PER_TASK + 17;
        let pairs =
            |items: usize| (0..items).map(move |item| (item.wrapping_mul(2_654_435_761) % count, item));
        for items in [0, 1, 100, 5 * LISTS_PER_TASK] {
            let plain = csr_lists(count, |put| pairs(items).for_each(|(group, value)| put(group, value)));
            assert_eq!(csr_lists_from_pairs(count, pairs(items)), plain, "{items} items");
            let kept = |_: usize, own: &mut Vec<usize>| own.retain(|value| value % 7 < 3);
            let tidied = plain.clone().tidied(kept);
            for group in 0..count {
                let mut own = plain.of(group).to_vec();
                kept(group, &mut own);
                assert_eq!(tidied.of(group), own, "{group}");
            }
        }
    }

    #[test]
    fn tidied_groups_are_shorter_and_in_order() {
        let tidied = lists_by_word_length(&["to", "an", "x", "to"]).tidied(|_, own| {
            own.sort_unstable();
            own.dedup();
        });
        assert_eq!((tidied.of(1), tidied.of(2), tidied.of(3).len()), (&["x"][..], &["an", "to"][..], 0));
    }
}
