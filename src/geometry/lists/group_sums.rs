//! [`sums`]: sums over the members of groups, in an order that does not depend on the number of threads.

use std::ops::AddAssign;

use crate::parallel::prelude::*;

/// Implements addition for a type whose fields add up.
macro_rules! summed {
    ($type:ident: $($field:ident),+) => {
        impl std::ops::AddAssign<&$type> for $type {
            #[inline]
            fn add_assign(&mut self, other: &Self) {
                $(self.$field += &other.$field;)+
            }
        }
    };
}
pub(crate) use summed;

/// Number of items per task.
const ITEMS_PER_TASK: usize = 1 << 13;

/// The sum of each group over all items. `adds` returns the contributions of an item, with their groups.
///
/// Consecutive items mostly contribute to one group, so partial sums are kept per run.
pub(crate) fn sums<T, A>(groups: usize, items: usize, adds: impl Fn(usize) -> A + Sync) -> Vec<T>
where
    T: Clone + Default + Send + for<'a> AddAssign<&'a T>,
    A: IntoIterator<Item = (u32, T)>,
{
    let runs_of = |items: std::ops::Range<usize>| {
        let mut runs: Vec<(u32, T)> = Vec::new();
        // The current run is kept outside the list, so that it can stay in registers.
        let mut last: Option<(u32, T)> = None;
        for item in items {
            adds(item).into_iter().for_each(|(group, own)| match &mut last {
                Some((of, sum)) if *of == group => *sum += &own,
                _ => runs.extend(last.replace((group, own))),
            });
        }
        runs.extend(last);
        runs
    };
    let runs: Vec<Vec<(u32, T)>> = (0..items.div_ceil(ITEMS_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|k| runs_of(k * ITEMS_PER_TASK..((k + 1) * ITEMS_PER_TASK).min(items)))
        .collect();
    let mut sums = vec![T::default(); groups];
    for (group, run) in runs.iter().flatten() {
        sums[*group as usize] += run;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn group_sums_match_plain_sums_on_any_number_of_threads() {
        let items = 3 * ITEMS_PER_TASK + 17;
        let adds = |k: usize| [((k / 1000 % 7) as u32, 1.0 / (k + 1) as f64), (7, 1.0)];
        let on = |threads| {
            let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| sums::<f64, _>(9, items, adds))
        };
        let found = on(1);
        assert_eq!(found, on(3));
        assert_eq!(found[7..], [items as f64, 0.0]);
        for group in 0..7 {
            let plain: f64 = (0..items).map(adds).filter(|a| a[0].0 == group).map(|a| a[0].1).sum();
            assert!((found[group as usize] - plain).abs() < 1e-12);
        }
    }
}
