//! Steps of parallel loops: adapters between source and end.

use super::sources::{SourcePair, Split};

/// Parallel loop before it runs: a source, its steps, and the limits of its parts.
#[must_use]
#[derive(Clone)]
pub(crate) struct Parallel<S, F> {
    pub(crate) source: S,
    pub(crate) step: F,
    pub(crate) min: usize,
    pub(crate) max: usize,
}

/// A step, including all steps before it.
pub(crate) trait Step<S: Split>: Sync {
    type Item;
    /// Items that result from a part of the source. `first` is the number of items before the part.
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = Self::Item>;
}

/// Value that a parallel loop can run over.
pub(crate) trait IntoParallelIterator {
    type Source: Split;
    type Step: Step<Self::Source>;
    fn into_par_iter(self) -> Parallel<Self::Source, Self::Step>;
}

impl<S: Split, F: Step<S>> IntoParallelIterator for Parallel<S, F> {
    type Source = S;
    type Step = F;
    fn into_par_iter(self) -> Self {
        self
    }
}

/// Identity step.
#[derive(Clone)]
pub(crate) struct NoStep;

impl<S: Split> Step<S> for NoStep {
    type Item = S::Item;
    fn pass(&self, part: S, _: usize) -> impl Iterator<Item = S::Item> {
        part.items()
    }
}

/// Steps that apply a function or combine loops.
#[derive(Clone)]
pub(crate) struct Map<F, G>(F, G);
#[derive(Clone)]
pub(crate) struct Filter<F, G>(F, G);
#[derive(Clone)]
pub(crate) struct FilterMap<F, G>(F, G);
#[derive(Clone)]
pub(crate) struct FlatMap<F, G>(F, G);
#[derive(Clone)]
pub(crate) struct Enumerate<F>(F);
#[derive(Clone)]
pub(crate) struct Copied<F>(F);
#[derive(Clone)]
pub(crate) struct Zip<F, G>(F, G);
#[derive(Clone)]
pub(crate) struct MapInit<F, I, G>(F, I, G);
#[derive(Clone)]
pub(crate) struct Fold<F, I, G>(F, I, G);

impl<S: Split, F: Step<S>, R, G: Fn(F::Item) -> R + Sync> Step<S> for Map<F, G> {
    type Item = R;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = R> {
        self.0.pass(part, first).map(&self.1)
    }
}

impl<S: Split, F: Step<S>, G: Fn(&F::Item) -> bool + Sync> Step<S> for Filter<F, G> {
    type Item = F::Item;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = F::Item> {
        self.0.pass(part, first).filter(&self.1)
    }
}

impl<S: Split, F: Step<S>, R, G: Fn(F::Item) -> Option<R> + Sync> Step<S> for FilterMap<F, G> {
    type Item = R;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = R> {
        self.0.pass(part, first).filter_map(&self.1)
    }
}

impl<S: Split, F: Step<S>, R: IntoIterator, G: Fn(F::Item) -> R + Sync> Step<S> for FlatMap<F, G> {
    type Item = R::Item;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = R::Item> {
        self.0.pass(part, first).flat_map(&self.1)
    }
}

impl<S: Split, F: Step<S>> Step<S> for Enumerate<F> {
    type Item = (usize, F::Item);
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = (usize, F::Item)> {
        (first..).zip(self.0.pass(part, first))
    }
}

impl<'a, S: Split, T: Copy + 'a, F: Step<S, Item = &'a T>> Step<S> for Copied<F> {
    type Item = T;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = T> {
        self.0.pass(part, first).copied()
    }
}

impl<A: Split, B: Split, F: Step<A>, G: Step<B>> Step<SourcePair<A, B>> for Zip<F, G> {
    type Item = (F::Item, G::Item);
    fn pass(&self, part: SourcePair<A, B>, first: usize) -> impl Iterator<Item = (F::Item, G::Item)> {
        self.0.pass(part.0, first).zip(self.1.pass(part.1, first))
    }
}

impl<S: Split, F: Step<S>, T, R, I: Fn() -> T + Sync, G: Fn(&mut T, F::Item) -> R + Sync> Step<S>
    for MapInit<F, I, G>
{
    type Item = R;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = R> {
        let mut own = (self.1)();
        self.0.pass(part, first).map(move |item| (self.2)(&mut own, item))
    }
}

impl<S: Split, F: Step<S>, T, I: Fn() -> T + Sync, G: Fn(T, F::Item) -> T + Sync> Step<S> for Fold<F, I, G> {
    type Item = T;
    fn pass(&self, part: S, first: usize) -> impl Iterator<Item = T> {
        std::iter::once(self.0.pass(part, first).fold((self.1)(), &self.2))
    }
}

impl<S: Split> Parallel<S, NoStep> {
    pub(crate) fn new(source: S) -> Self {
        Self { source, step: NoStep, min: 1, max: usize::MAX }
    }
}

impl<S: Split, F: Step<S>> Parallel<S, F> {
    fn then<G>(self, step: impl FnOnce(F) -> G) -> Parallel<S, G> {
        let Self { source, step: before, min, max } = self;
        Parallel { source, step: step(before), min, max }
    }

    /// Puts at least `len` items into a part.
    pub(crate) fn with_min_len(self, len: usize) -> Self {
        Self { min: len, ..self }
    }

    /// Puts at most `len` items into a part, as far as memory for results allows.
    pub(crate) fn with_max_len(self, len: usize) -> Self {
        Self { max: len, ..self }
    }

    pub(crate) fn map<R, G: Fn(F::Item) -> R + Sync>(self, function: G) -> Parallel<S, Map<F, G>> {
        self.then(|step| Map(step, function))
    }

    pub(crate) fn filter<G: Fn(&F::Item) -> bool + Sync>(self, function: G) -> Parallel<S, Filter<F, G>> {
        self.then(|step| Filter(step, function))
    }

    pub(crate) fn filter_map<R, G: Fn(F::Item) -> Option<R> + Sync>(
        self,
        function: G,
    ) -> Parallel<S, FilterMap<F, G>> {
        self.then(|step| FilterMap(step, function))
    }

    pub(crate) fn flat_map_iter<R: IntoIterator, G: Fn(F::Item) -> R + Sync>(
        self,
        function: G,
    ) -> Parallel<S, FlatMap<F, G>> {
        self.then(|step| FlatMap(step, function))
    }

    /// Flattens items that are collections.
    #[expect(clippy::type_complexity)]
    pub(crate) fn flatten_iter(self) -> Parallel<S, FlatMap<F, fn(F::Item) -> F::Item>>
    where
        F::Item: IntoIterator,
    {
        self.flat_map_iter(std::convert::identity)
    }

    /// Numbers the items. Earlier steps must keep the number of items.
    pub(crate) fn enumerate(self) -> Parallel<S, Enumerate<F>> {
        self.then(Enumerate)
    }

    pub(crate) fn copied<'a, T: Copy + 'a>(self) -> Parallel<S, Copied<F>>
    where
        F: Step<S, Item = &'a T>,
    {
        self.then(Copied)
    }

    /// Runs two loops together, up to the length of the shorter. Earlier steps must keep the number of items.
    pub(crate) fn zip<B: IntoParallelIterator>(
        self,
        other: B,
    ) -> Parallel<SourcePair<S, B::Source>, Zip<F, B::Step>> {
        let other = other.into_par_iter();
        let len = self.source.length().min(other.source.length());
        let source = SourcePair(self.source.cut_at(len).0, other.source.cut_at(len).0);
        let (min, max) = (self.min.max(other.min), self.max.min(other.max));
        Parallel { source, step: Zip(self.step, other.step), min, max }
    }

    /// Maps with a value that each part creates once, such as a buffer.
    pub(crate) fn map_init<T, R, I: Fn() -> T + Sync, G: Fn(&mut T, F::Item) -> R + Sync>(
        self,
        init: I,
        function: G,
    ) -> Parallel<S, MapInit<F, I, G>> {
        self.then(|step| MapInit(step, init, function))
    }

    /// Folds each part to one item.
    pub(crate) fn fold<T, I: Fn() -> T + Sync, G: Fn(T, F::Item) -> T + Sync>(
        self,
        init: I,
        function: G,
    ) -> Parallel<S, Fold<F, I, G>> {
        self.then(|step| Fold(step, init, function))
    }
}
