//! [`ResultCache`]: a cache of results computed from a picture, shared between views.

use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of keys that are remembered; the oldest are forgotten first.
const MAX_REMEMBERED_KEYS: usize = 64;

/// Cache of results computed from a picture, by key.
///
/// A result is stored only when it is requested for the second time, because pictures are large and most are
/// drawn once. The total size is bounded, and the oldest results are dropped first. Clones share the cache.
#[derive(Debug)]
pub(crate) struct ResultCache<K, V> {
    entries: Arc<Mutex<Vec<CacheEntry<K, V>>>>,
    /// Size of a result, and maximum total size.
    size: fn(&V) -> usize,
    max_total: usize,
}

/// A requested key, with its result from the second request on.
#[derive(Debug)]
struct CacheEntry<K, V> {
    key: K,
    computed_value: Option<Arc<V>>,
}

impl<K, V> Clone for ResultCache<K, V> {
    fn clone(&self) -> Self {
        Self { entries: Arc::clone(&self.entries), ..*self }
    }
}

impl<K: Copy + PartialEq, V> ResultCache<K, V> {
    /// Makes a cache of at most `max_total` units, as measured by `size`.
    pub(crate) fn new(most: usize, size: fn(&V) -> usize) -> Self {
        Self { entries: Arc::default(), size, max_total: most }
    }

    /// Returns the result of a key, from the cache or computed by `make`. `make` must be deterministic.
    pub(crate) fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        let lock = || self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let remembered =
            lock().iter().find(|asked| asked.key == key).map(|asked| asked.computed_value.clone());
        if let Some(Some(known_result)) = remembered {
            return known_result;
        }
        // The lock is released here: `make` may run other tasks that request the same key.
        let computed = Arc::new(make());
        let mut all = lock();
        all.retain(|entry| entry.key != key);
        all.push(CacheEntry { key, computed_value: remembered.map(|_| Arc::clone(&computed)) });
        self.forget(&mut all);
        computed
    }

    /// Drops the oldest results and keys until the limits are met.
    fn forget(&self, all: &mut Vec<CacheEntry<K, V>>) {
        let mut left = self.max_total;
        for cached in all.iter_mut().rev() {
            let size = cached.computed_value.as_ref().map_or(0, |made| (self.size)(made));
            match left.checked_sub(size) {
                Some(rest) => left = rest,
                None => cached.computed_value = None,
            }
        }
        let more = all.len().saturating_sub(MAX_REMEMBERED_KEYS);
        all.drain(..more);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For each of some sizes, whether it has to be computed when requested after those before it.
    fn is_computed_per_request(kept: &ResultCache<usize, usize>, sizes: &[usize]) -> Vec<bool> {
        let ask = |size: &usize| {
            let mut is_made = false;
            let value = kept.clone().get(*size, || {
                is_made = true;
                *size
            });
            assert_eq!(*value, *size);
            is_made
        };
        sizes.iter().map(ask).collect()
    }

    #[test]
    fn result_cache_stores_results_on_their_second_request() {
        let kept = ResultCache::new(10, |size: &usize| *size);
        assert_eq!(
            is_computed_per_request(&kept, &[1, 2, 1, 1, 2, 2, 1]),
            [true, true, true, false, true, false, false]
        );
    }

    #[test]
    fn result_cache_stays_within_its_size_limit() {
        let kept = ResultCache::new(10, |size: &usize| *size);
        assert_eq!(
            is_computed_per_request(&kept, &[4, 4, 5, 5, 4, 5]),
            [true, true, true, true, false, false]
        );
        // The oldest result is dropped and computed again later.
        assert_eq!(
            is_computed_per_request(&kept, &[3, 3, 5, 3, 4, 4, 3]),
            [true, true, false, false, true, false, false]
        );
        // A result larger than the limit is never stored.
        assert_eq!(is_computed_per_request(&kept, &[11, 11, 11, 4]), [true, true, true, false]);
        (100..200).for_each(|size| assert_eq!(is_computed_per_request(&kept, &[size]), [true]));
        assert!(kept.entries.lock().unwrap().len() <= MAX_REMEMBERED_KEYS);
    }
}
