//! Parallel loops agree with ordinary iterators for any number of threads.

use super::prelude::*;
use super::{join, part_count};

/// Runs the check on pools of one, two and five threads.
fn with_threads(check: impl Fn() + Send + Sync) {
    for threads in [1, 2, 5] {
        let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(&check);
    }
}

#[test]
fn parallel_steps_keep_the_iterator_order() {
    with_threads(|| {
        for len in [0_u32, 1, 2, 7, 100, 1000] {
            let items: Vec<u32> = (0..len).map(|k| k * 7919 % 1009).collect();
            for min in [1, 3, 5000] {
                let mapped: Vec<u32> = items.par_iter().with_min_len(min).map(|k| k + 1).collect();
                assert_eq!(mapped, items.iter().map(|k| k + 1).collect::<Vec<_>>());
            }
            let kept: Vec<(usize, u32)> =
                items.par_iter().with_max_len(1).copied().enumerate().filter(|(_, k)| k % 3 == 0).collect();
            let expected: Vec<_> = items.iter().copied().enumerate().filter(|(_, k)| k % 3 == 0).collect();
            assert_eq!(kept, expected);
            let flat: Vec<u32> = (0..len).into_par_iter().flat_map_iter(|k| 0..k % 4).collect();
            assert_eq!(flat, (0..len).flat_map(|k| 0..k % 4).collect::<Vec<_>>());
            let owned: Vec<u32> = items.clone().into_par_iter().filter_map(|k| k.checked_sub(500)).collect();
            assert_eq!(owned, items.iter().filter_map(|k| k.checked_sub(500)).collect::<Vec<_>>());
        }
    });
}

#[test]
fn parallel_zip_ends_with_the_shorter_input() {
    with_threads(|| {
        let (long, short): (Vec<u32>, Vec<u32>) = ((0..1000).collect(), (0..613).rev().collect());
        let pairs: Vec<(u32, u32)> =
            long.par_iter().map(|k| k * 2).zip(&short).map(|(a, b)| (a, *b)).collect();
        let expected: Vec<_> = long.iter().map(|k| k * 2).zip(short.iter().copied()).collect();
        assert_eq!(pairs, expected);
        let (a, b): (Vec<u32>, Vec<u32>) = pairs.into_par_iter().unzip();
        assert_eq!((a.len(), b), (613, short.clone()));
        let mut changed = short.clone();
        changed.par_iter_mut().zip(long.par_iter()).for_each(|(to, from)| *to = *from);
        assert_eq!(changed, long[..613]);
    });
}

#[test]
fn parallel_chunks_cover_the_slice_once() {
    with_threads(|| {
        for (len, size) in [(0, 4), (1, 4), (4, 4), (1001, 4), (1001, 1000), (5, 9)] {
            let mut items = vec![0_usize; len];
            items.par_chunks_mut(size).enumerate().for_each(|(k, chunk)| chunk.fill(k + 1));
            let expected: Vec<usize> = (0..len).map(|k| k / size + 1).collect();
            assert_eq!(items, expected);
            let sums: Vec<usize> = items.par_chunks(size).map(|chunk| chunk.iter().sum()).collect();
            assert_eq!(sums, items.chunks(size).map(|chunk| chunk.iter().sum()).collect::<Vec<usize>>());
            let runs: Vec<usize> = items.par_chunk_by(|a, b| a == b).map(<[usize]>::len).collect();
            assert_eq!(runs, items.chunk_by(|a, b| a == b).map(<[usize]>::len).collect::<Vec<_>>());
        }
    });
}

#[test]
fn parallel_reductions_agree_with_iterators() {
    with_threads(|| {
        let items: Vec<u64> = (0..5000).map(|k| k * 7919 % 1009).collect();
        assert!(items.par_iter().any(|k| *k == 1008) && !items.par_iter().any(|k| *k == 1009));
        assert!(items.par_iter().all(|k| *k < 1009) && !items.par_iter().all(|k| *k < 1008));
        assert_eq!(items.par_iter().max(), Some(&1008));
        assert_eq!(items.par_iter().copied().reduce(|| 0, |a, b| a + b), items.iter().sum::<u64>());
        let folded = items.par_iter().fold(|| 0, |sum, k| sum + k).reduce(|| 0, |a, b| a + b);
        assert_eq!(folded, items.iter().sum::<u64>());
        let mut extended = vec![1, 2];
        extended.par_extend(items.par_iter().copied());
        assert_eq!((extended.len(), &extended[2..]), (5002, items.as_slice()));
        let failed: Result<Vec<u64>, u64> =
            items.par_iter().map(|k| if k % 100 == 99 { Err(*k) } else { Ok(*k) }).collect();
        assert_eq!(failed, items.iter().map(|k| if k % 100 == 99 { Err(*k) } else { Ok(*k) }).collect());
        let counted: Vec<u64> = (0..100_u64)
            .into_par_iter()
            .with_max_len(1)
            .map_init(Vec::new, |seen, k| {
                seen.push(k);
                k
            })
            .collect();
        assert_eq!(counted, (0..100).collect::<Vec<_>>());
        assert_eq!(join(|| 1, || "two"), (1, "two"));
    });
}

#[test]
fn part_count_respects_its_length_limits() {
    with_threads(|| {
        let threads = rayon_core::current_num_threads();
        for (len, min, max) in [(0, 1, 1), (1, 1, 9), (1000, 1, usize::MAX), (1000, 300, 1), (9999, 1, 4)] {
            let count = part_count(len, min, max);
            assert!(count >= 1 && (count == 1 || len / count >= min), "{count} parts of {len}");
            assert!(
                threads == 1 || min > 1 || len.div_ceil(count) <= max.max(len.div_ceil(256)),
                "{count} of {len}"
            );
        }
    });
}

#[test]
fn nested_parallel_loops_terminate() {
    with_threads(|| {
        let sums: Vec<u64> = (0..50_u64)
            .into_par_iter()
            .with_max_len(1)
            .map(|k| (0..k).into_par_iter().map(|i| i * i).reduce(|| 0, |a, b| a + b))
            .collect();
        let expected: Vec<u64> = (0..50).map(|k| (0..k).map(|i| i * i).sum()).collect();
        assert_eq!(sums, expected);
    });
}
