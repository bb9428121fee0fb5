//! Parallel loops over slices, vectors and ranges, with little code for each loop.
//!
//! A loop has a *source* that can be split ([`sources`]), *steps* such as `map` and `filter` ([`steps`]), and
//! an *end* such as `collect` ([`ends`]). [`starts`] makes loops from collections; [`sort`] sorts under the
//! names of rayon.
//!
//! 1. The length, the limits of the loop and the number of threads give the number of parts (`part_count`).
//! 2. The source is split into that many parts (`cut`).
//! 3. Threads take parts in order until none is left (`run`, the only function that starts threads).
//! 4. Each part passes the steps as an ordinary iterator and yields one result.
//! 5. The end joins the results in the order of the parts, so the result does not depend on the schedule.
//!
//! The names are those of rayon, whose threads run the parts. Rayon's iterators compile their scheduling
//! again for every closure; here it is compiled once. `with_min_len` bounds the items of a part from below,
//! for cheap items. `with_max_len` bounds them from above, for items of unequal cost. Without limits a loop
//! has up to 8 parts per thread.

pub(crate) mod concatenation;
mod ends;
mod sort;
mod sources;
mod starts;
mod steps;
pub(crate) mod task_size;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

pub(crate) use ends::ParallelExtend;
pub(crate) use sort::ParallelSort;
use sources::Split;
pub(crate) use starts::{ParallelSlice, ParallelSliceMut};
pub(crate) use steps::{IntoParallelIterator, Parallel, Step};

/// Traits that modules with parallel loops import.
pub(crate) mod prelude {
    pub(crate) use super::{
        IntoParallelIterator, ParallelExtend, ParallelSlice, ParallelSliceMut, ParallelSort,
    };
}

/// Number of parts per thread in a loop without limits. Threads with cheap parts can take over others.
const PARTS_PER_THREAD: usize = 8;

/// Maximum number of parts per thread. Bounds the memory for results.
const MAX_PARTS_PER_THREAD: usize = 128;

/// Runs `work(0)` to `work(tasks - 1)` on the threads of the current pool, each once, and waits for all.
fn run(tasks: usize, work: &(dyn Fn(usize) + Sync)) {
    let threads = rayon_core::current_num_threads().min(tasks);
    if threads <= 1 {
        (0..tasks).for_each(work);
        return;
    }
    let next = AtomicUsize::new(0);
    let take = || {
        loop {
            let task = next.fetch_add(1, Ordering::Relaxed);
            if task >= tasks {
                break;
            }
            work(task);
        }
    };
    rayon_core::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(|_| take());
        }
        take();
    });
}

/// Runs both functions, in parallel if a thread is free, and returns their results.
pub(crate) fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    let (mut first, mut second) = (Some(first), Some(second));
    let (mut a, mut b) = (None, None);
    join_tasks(&mut || a = first.take().map(|first| first()), &mut || {
        b = second.take().map(|second| second())
    });
    match (a, b) {
        (Some(a), Some(b)) => (a, b),
        _ => unreachable!("both functions ran"),
    }
}

fn join_tasks(first: &mut (dyn FnMut() + Send), second: &mut (dyn FnMut() + Send)) {
    rayon_core::join(first, second);
}

/// Number of parts of a loop over `len` items with at least `min` and at most `max` items per part.
fn part_count(len: usize, min: usize, max: usize) -> usize {
    let threads = rayon_core::current_num_threads();
    if threads == 1 {
        return 1;
    }
    let most = (len / min.max(1)).min(threads * MAX_PARTS_PER_THREAD);
    (threads * PARTS_PER_THREAD).max(len.div_ceil(max.max(1))).min(most).max(1)
}

/// Part of a source until a thread takes it, and the number of items before it.
struct SourcePart<S> {
    first: usize,
    source: Mutex<Option<S>>,
}

/// Splits a source into `count` parts whose lengths differ by at most one.
fn cut<S: Split>(source: S, count: usize) -> Vec<SourcePart<S>> {
    let len = source.length();
    let mut parts = Vec::with_capacity(count);
    let (mut first, mut rest) = (0, source);
    for k in 1..count {
        let end = len * k / count;
        let (part, after) = rest.cut_at(end - first);
        parts.push(SourcePart { first, source: Mutex::new(Some(part)) });
        (first, rest) = (end, after);
    }
    parts.push(SourcePart { first, source: Mutex::new(Some(rest)) });
    parts
}

fn slots<R>(count: usize) -> Vec<Mutex<Option<R>>> {
    (0..count).map(|_| Mutex::new(None)).collect()
}

fn take<T>(slot: &Mutex<Option<T>>) -> Option<T> {
    slot.lock().unwrap_or_else(PoisonError::into_inner).take()
}

fn put<T>(slot: &Mutex<Option<T>>, value: T) {
    *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(value);
}

/// Results of all parts, in order.
fn gather<R>(slots: Vec<Mutex<Option<R>>>) -> Vec<R> {
    slots.into_iter().filter_map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
}

#[cfg(test)]
mod tests;
