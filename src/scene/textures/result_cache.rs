//! [`Kept`]: what one view made of a picture, for views to come.

use std::sync::{Arc, Mutex, PoisonError};

/// Of more keys than this it is forgotten that they were asked for, of the first first.
const MOST_ASKED: usize = 64;

/// What one view made of a picture, for views to come, by what it depends on.
///
/// What is asked for but once is not kept: pictures are large, and most are drawn once. Of all else only so much is, and what
/// was kept first goes first. Clones share what is kept.
#[derive(Debug)]
pub(crate) struct Kept<K, V> {
    asked: Arc<Mutex<Vec<Asked<K, V>>>>,
    /// How large a thing is, and how large all that is kept may be.
    size: fn(&V) -> usize,
    most: usize,
}

/// What was asked for, and that itself from the second time on.
#[derive(Debug)]
struct Asked<K, V> {
    key: K,
    made: Option<Arc<V>>,
}

impl<K, V> Clone for Kept<K, V> {
    fn clone(&self) -> Self {
        Self { asked: Arc::clone(&self.asked), ..*self }
    }
}

impl<K: Copy + PartialEq, V> Kept<K, V> {
    /// Keeps no more than so much of things that are so large.
    pub fn new(most: usize, size: fn(&V) -> usize) -> Self {
        Self { asked: Arc::default(), size, most }
    }

    /// What belongs to a key, as it was kept or is made now: the same whenever it is made.
    pub fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        let lock = || self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        let asked = lock().iter().find(|asked| asked.key == key).map(|asked| asked.made.clone());
        if let Some(Some(made)) = asked {
            return made;
        }
        // The lock is open meanwhile: making may take up other work that asks for the same.
        let made = Arc::new(make());
        let mut all = lock();
        all.retain(|asked| asked.key != key);
        all.push(Asked { key, made: asked.map(|_| Arc::clone(&made)) });
        self.forget(&mut all);
        made
    }

    /// Forgets what is too much, the first first.
    fn forget(&self, all: &mut Vec<Asked<K, V>>) {
        let mut left = self.most;
        for asked in all.iter_mut().rev() {
            let size = asked.made.as_ref().map_or(0, |made| (self.size)(made));
            match left.checked_sub(size) {
                Some(rest) => left = rest,
                None => asked.made = None,
            }
        }
        let more = all.len().saturating_sub(MOST_ASKED);
        all.drain(..more);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether each of some sizes has to be made when it is asked for after those before it.
    fn made(kept: &Kept<usize, usize>, sizes: &[usize]) -> Vec<bool> {
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
    fn what_is_asked_for_again_is_kept() {
        let kept = Kept::new(10, |size: &usize| *size);
        assert_eq!(made(&kept, &[1, 2, 1, 1, 2, 2, 1]), [true, true, true, false, true, false, false]);
    }

    #[test]
    fn no_more_than_so_much_is_kept() {
        let kept = Kept::new(10, |size: &usize| *size);
        assert_eq!(made(&kept, &[4, 4, 5, 5, 4, 5]), [true, true, true, true, false, false]);
        // The first goes, and is made anew when it is wanted again.
        assert_eq!(made(&kept, &[3, 3, 5, 3, 4, 4, 3]), [true, true, false, false, true, false, false]);
        // What is too large by itself never stays.
        assert_eq!(made(&kept, &[11, 11, 11, 4]), [true, true, true, false]);
        (100..200).for_each(|size| assert_eq!(made(&kept, &[size]), [true]));
        assert!(kept.asked.lock().unwrap().len() <= MOST_ASKED);
    }
}
