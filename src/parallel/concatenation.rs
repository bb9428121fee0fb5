//! [`concatenate`]: concatenates lists in parallel.
//!
//! The system clears memory pages when they are first touched. For long lists this takes longer than the copy
//! itself, so all threads share it.

use super::prelude::*;

/// Minimum number of values that one task copies.
const MIN_TASK_VALUES: usize = 1 << 12;

/// Concatenates lists in their order, on all threads.
pub(crate) fn concatenate<T: Copy + Send + Sync>(lists: &[Vec<T>]) -> Vec<T> {
    let mut starts = Vec::with_capacity(lists.len());
    let mut total = 0;
    for list in lists {
        starts.push(total);
        total += list.len();
    }
    // Consecutive values are mostly from one list.
    let value = |own: &mut usize, at: usize| match lists[*own].get(at.wrapping_sub(starts[*own])) {
        Some(value) => *value,
        None => {
            *own = starts.partition_point(|start| *start <= at) - 1;
            lists[*own][at - starts[*own]]
        }
    };
    (0..total).into_par_iter().with_min_len(MIN_TASK_VALUES).map_init(|| 0, value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn concatenate_joins_lists_in_order() {
        let lists: Vec<Vec<usize>> = (0..200)
            .map(|k| (0..(k * 7919) % 301 * usize::from(k % 5 > 1)).map(|i| k * 1000 + i).collect())
            .collect();
        assert!(lists.concat().len() > 3 * MIN_TASK_VALUES && lists.iter().any(Vec::is_empty));
        for some in [&lists[..], &lists[..3], &lists[..1], &[]] {
            assert_eq!(concatenate(some), some.concat());
        }
    }
}
