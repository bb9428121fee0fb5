//! [`counting_sort`]: stable parallel sort by small integer keys.
//!
//! With several threads, the items are first distributed into buckets by the upper bits of their keys. Each
//! thread writes a run of items to separate slots. Then each bucket is sorted by the lower bits. The result
//! is the same as with one thread.

use crate::parallel::prelude::*;

/// Minimum number of items for several threads.
const MIN_PARALLEL_ITEMS: usize = 1 << 17;
/// Number of key bits that select the bucket.
const UPPER_BITS: u32 = 8;

/// Sorts items by a key below `keys`. Items with equal keys keep their order.
pub(crate) fn counting_sort<T: Copy + Default + Send + Sync>(
    items: Vec<T>,
    keys: usize,
    key: impl Fn(&T) -> u32 + Sync,
) -> Vec<T> {
    let threads = rayon_core::current_num_threads();
    let mut sorted = vec![T::default(); items.len()];
    if threads == 1 || items.len() < MIN_PARALLEL_ITEMS {
        sort_into(&mut sorted, &items, keys, key);
        return sorted;
    }
    let shift = (usize::BITS - keys.leading_zeros()).saturating_sub(UPPER_BITS);
    let hands = (keys >> shift) + 1;
    let upper = |item: &T| (key(item) >> shift) as usize;
    let run = items.len().div_ceil(4 * threads);
    let sizes: Vec<Vec<usize>> = items
        .par_chunks(run)
        .map(|run| {
            let mut sizes = vec![0; hands];
            run.iter().for_each(|item| sizes[upper(item)] += 1);
            sizes
        })
        .collect();
    let mut places: Vec<Vec<&mut [T]>> = sizes.iter().map(|_| Vec::with_capacity(hands)).collect();
    let mut free = sorted.as_mut_slice();
    for hand in 0..hands {
        for (places, sizes) in places.iter_mut().zip(&sizes) {
            let own;
            (own, free) = free.split_at_mut(sizes[hand]);
            places.push(own);
        }
    }
    items.par_chunks(run).zip(places).for_each(|(run, mut places)| {
        for item in run {
            let place = &mut places[upper(item)];
            if let Some((next, rest)) = std::mem::take(place).split_first_mut() {
                *next = *item;
                *place = rest;
            }
        }
    });
    if shift == 0 {
        return sorted;
    }
    // The second pass sorts back into the original buffer.
    let (dealt, mut sorted) = (sorted, items);
    let mut free = sorted.as_mut_slice();
    let mut from = dealt.as_slice();
    let mut each = Vec::with_capacity(hands);
    for hand in 0..hands {
        let size = sizes.iter().map(|sizes| sizes[hand]).sum();
        let (own, of);
        (own, free) = free.split_at_mut(size);
        (of, from) = from.split_at(size);
        each.push((own, of));
    }
    let lower = |item: &T| key(item) & ((1 << shift) - 1);
    each.into_par_iter().for_each(|(own, of)| sort_into(own, of, 1 << shift, lower));
    sorted
}

/// Single-threaded counting sort.
fn sort_into<T: Copy>(sorted: &mut [T], items: &[T], keys: usize, key: impl Fn(&T) -> u32) {
    if items.len() < 2 {
        sorted.copy_from_slice(items);
        return;
    }
    let mut starts = vec![0u32; keys + 1];
    items.iter().for_each(|item| starts[key(item) as usize + 1] += 1);
    let mut total = 0;
    for start in &mut starts {
        total += *start;
        *start = total;
    }
    for item in items {
        let next = &mut starts[key(item) as usize];
        sorted[*next as usize] = *item;
        *next += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counting_sort_is_stable_on_any_number_of_threads() {
        let items: Vec<(u32, u32)> =
            (0..MIN_PARALLEL_ITEMS as u32 + 5_000).map(|k| (k.wrapping_mul(2_654_435_761), k)).collect();
        for keys in [1_u32, 3, 255, 256, 257, 70_000] {
            let key = |item: &(u32, u32)| item.0 % keys;
            let mut expected = items.clone();
            expected.sort_by_key(key);
            for threads in [1, 3] {
                let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
                let sorted = pool.install(|| counting_sort(items.clone(), keys as usize, key));
                assert!(sorted == expected, "{keys} keys on {threads} threads");
            }
        }
    }
}
