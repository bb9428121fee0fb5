//! Sorting methods with the names of rayon. They run on one thread.

use std::cmp::Ordering;

pub(crate) trait ParallelSort<T> {
    fn par_sort_unstable(&mut self)
    where
        T: Ord;
    fn par_sort_unstable_by(&mut self, compare: impl Fn(&T, &T) -> Ordering + Sync);
    fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl Fn(&T) -> K + Sync);
    fn par_sort_by(&mut self, compare: impl Fn(&T, &T) -> Ordering + Sync);
    fn par_sort_by_key<K: Ord>(&mut self, key: impl Fn(&T) -> K + Sync);
}

impl<T: Send> ParallelSort<T> for [T] {
    fn par_sort_unstable(&mut self)
    where
        T: Ord,
    {
        self.sort_unstable();
    }
    fn par_sort_unstable_by(&mut self, compare: impl Fn(&T, &T) -> Ordering + Sync) {
        self.sort_unstable_by(compare);
    }
    fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl Fn(&T) -> K + Sync) {
        self.sort_unstable_by_key(key);
    }
    fn par_sort_by(&mut self, compare: impl Fn(&T, &T) -> Ordering + Sync) {
        self.sort_by(compare);
    }
    fn par_sort_by_key<K: Ord>(&mut self, key: impl Fn(&T) -> K + Sync) {
        self.sort_by_key(key);
    }
}
