//! Ends of parallel loops: what happens to the items of each part, and how the results are joined.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

use super::sources::Split;
use super::steps::{IntoParallelIterator, Parallel, Step};
use super::{cut, gather, part_count, put, run, slots, take};

/// Consumer of the items of one part.
trait End<T>: Sync {
    type Result: Send;
    fn end(&self, items: impl Iterator<Item = T>) -> Self::Result;
}

struct ForEach<G>(G);
struct Any<'a, G>(G, &'a AtomicBool);
struct Reduce<I, G>(I, G);
struct Collect;
struct Best<G>(G);

impl<T, G: Fn(T) + Sync> End<T> for ForEach<G> {
    type Result = ();
    fn end(&self, items: impl Iterator<Item = T>) {
        items.for_each(&self.0);
    }
}

impl<T, G: Fn(T) -> bool + Sync> End<T> for Any<'_, G> {
    type Result = ();
    fn end(&self, mut items: impl Iterator<Item = T>) {
        if !self.1.load(Ordering::Relaxed) && items.any(&self.0) {
            self.1.store(true, Ordering::Relaxed);
        }
    }
}

impl<T: Send, I: Fn() -> T + Sync, G: Fn(T, T) -> T + Sync> End<T> for Reduce<I, G> {
    type Result = T;
    fn end(&self, items: impl Iterator<Item = T>) -> T {
        items.fold((self.0)(), &self.1)
    }
}

impl<T: Send> End<T> for Collect {
    type Result = Vec<T>;
    fn end(&self, items: impl Iterator<Item = T>) -> Vec<T> {
        items.collect()
    }
}

impl<T: Send, G: Fn(T, T) -> T + Sync> End<T> for Best<G> {
    type Result = Option<T>;
    fn end(&self, items: impl Iterator<Item = T>) -> Option<T> {
        items.reduce(&self.0)
    }
}

/// Collection that is built from the items of a parallel loop, in order.
pub(crate) trait FromParts<T>: Sized {
    fn from_parts(parts: Vec<Vec<T>>) -> Self;
}

impl<T> FromParts<T> for Vec<T> {
    fn from_parts(parts: Vec<Self>) -> Self {
        let len = parts.iter().map(Self::len).sum::<usize>();
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_default();
        all.reserve_exact(len - all.len());
        parts.for_each(|mut part| all.append(&mut part));
        all
    }
}

impl<T> FromParts<T> for Box<[T]> {
    fn from_parts(parts: Vec<Vec<T>>) -> Self {
        <Vec<T> as FromParts<T>>::from_parts(parts).into_boxed_slice()
    }
}

impl<K: Ord, V> FromParts<(K, V)> for BTreeMap<K, V> {
    fn from_parts(parts: Vec<Vec<(K, V)>>) -> Self {
        parts.into_iter().flatten().collect()
    }
}

/// The first error, or all values.
impl<T, E> FromParts<Result<T, E>> for Result<Vec<T>, E> {
    fn from_parts(parts: Vec<Vec<Result<T, E>>>) -> Self {
        parts.into_iter().flatten().collect()
    }
}

/// All values, if none is missing.
impl<T> FromParts<Option<T>> for Option<Vec<T>> {
    fn from_parts(parts: Vec<Vec<Option<T>>>) -> Self {
        parts.into_iter().flatten().collect()
    }
}

impl<S: Split, F: Step<S>> Parallel<S, F> {
    fn drive<E: End<F::Item>>(self, end: &E) -> Vec<E::Result> {
        let Self { source, step, min, max } = self;
        let count = part_count(source.length(), min, max);
        let parts = cut(source, count);
        let results = slots(parts.len());
        run(parts.len(), &|k| {
            if let Some(part) = take(&parts[k].source) {
                put(&results[k], end.end(step.pass(part, parts[k].first)));
            }
        });
        gather(results)
    }

    pub(crate) fn collect<C: FromParts<F::Item>>(self) -> C
    where
        F::Item: Send,
    {
        C::from_parts(self.drive(&Collect))
    }

    pub(crate) fn for_each(self, function: impl Fn(F::Item) + Sync) {
        self.drive(&ForEach(function));
    }

    /// Whether the function holds for any item. Stops early.
    pub(crate) fn any(self, function: impl Fn(F::Item) -> bool + Sync) -> bool {
        let found = AtomicBool::new(false);
        self.drive(&Any(function, &found));
        found.into_inner()
    }

    /// Whether the function holds for all items.
    pub(crate) fn all(self, function: impl Fn(F::Item) -> bool + Sync) -> bool {
        !self.any(|item| !function(item))
    }

    /// Joins all items with an associative function. `identity` is its neutral element.
    pub(crate) fn reduce(
        self,
        identity: impl Fn() -> F::Item + Sync,
        function: impl Fn(F::Item, F::Item) -> F::Item + Sync,
    ) -> F::Item
    where
        F::Item: Send,
    {
        let end = Reduce(identity, function);
        let results = self.drive(&end);
        results.into_iter().reduce(&end.1).unwrap_or_else(&end.0)
    }

    /// Greatest item; the last one of several.
    pub(crate) fn max(self) -> Option<F::Item>
    where
        F::Item: Ord + Send,
    {
        self.drive(&Best(Ord::max)).into_iter().flatten().reduce(Ord::max)
    }

    /// Calls the function with a value that each part creates once, such as a buffer.
    pub(crate) fn for_each_init<T>(
        self,
        init: impl Fn() -> T + Sync,
        function: impl Fn(&mut T, F::Item) + Sync,
    ) {
        self.map_init(init, function).for_each(|()| ());
    }

    /// Splits pairs into two lists, each in order.
    pub(crate) fn unzip<A: Send, B: Send>(self) -> (Vec<A>, Vec<B>)
    where
        F: Step<S, Item = (A, B)>,
    {
        self.drive(&Collect).into_iter().flatten().unzip()
    }
}

/// Extends a collection with the items of a parallel loop.
pub(crate) trait ParallelExtend<T> {
    fn par_extend<L>(&mut self, items: L)
    where
        L: IntoParallelIterator,
        L::Step: Step<L::Source, Item = T>;
}

impl<T: Send> ParallelExtend<T> for Vec<T> {
    fn par_extend<L>(&mut self, items: L)
    where
        L: IntoParallelIterator,
        L::Step: Step<L::Source, Item = T>,
    {
        let parts = items.into_par_iter().drive(&Collect);
        self.reserve(parts.iter().map(Vec::len).sum());
        parts.into_iter().for_each(|mut part| self.append(&mut part));
    }
}
