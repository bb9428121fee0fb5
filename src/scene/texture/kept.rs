//! [`Kept`]: what one view made of a picture, for views to come.

use std::sync::{Arc, Mutex, PoisonError};

/// More things than this are not kept: those that were asked for first go.
const MOST: usize = 16;

/// What one view made of a picture, for views to come, by what it depends on.
///
/// What is asked for but once is not kept: pictures are large, and most are drawn once. Clones share what is kept.
#[derive(Debug)]
pub(super) struct Kept<K, V>(Arc<Mutex<Vec<Asked<K, V>>>>);

/// What was asked for, and that itself from the second time on.
#[derive(Debug)]
struct Asked<K, V> {
    key: K,
    made: Option<Arc<V>>,
}

impl<K, V> Clone for Kept<K, V> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<K: Copy + PartialEq, V> Kept<K, V> {
    /// What belongs to a key, as it was kept or is made now: the same whenever it is made.
    pub fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let asked = lock().iter().find(|asked| asked.key == key).map(|asked| asked.made.clone());
        if let Some(Some(made)) = asked {
            return made;
        }
        // The lock is open meanwhile: making may take up other work that asks for the same.
        let made = Arc::new(make());
        let mut all = lock();
        match all.iter_mut().find(|asked| asked.key == key) {
            Some(again) => again.made = asked.map(|_| Arc::clone(&made)).or(again.made.take()),
            None => all.push(Asked { key, made: None }),
        }
        let more = all.len().saturating_sub(MOST);
        all.drain(..more);
        made
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_asked_for_again_is_kept() {
        let kept: Kept<usize, usize> = Kept::default();
        let asked = |key: usize| {
            let mut made = false;
            let value = kept.clone().get(key, || {
                made = true;
                10 * key
            });
            assert_eq!(*value, 10 * key);
            made
        };
        assert_eq!([1, 2, 1, 1, 2, 2, 1].map(asked), [true, true, true, false, true, false, false]);
        // Of very many the first go.
        (10..10 + MOST).for_each(|key| assert!(asked(key)));
        assert!(asked(1));
        assert!(asked(10 + MOST - 1) && !asked(10 + MOST - 1));
    }
}
