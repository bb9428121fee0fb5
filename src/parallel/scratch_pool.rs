//! [`ScratchPool`]: a pool of scratch objects that parallel tasks reuse.

use std::sync::{Mutex, PoisonError};

/// Pool of scratch objects, each lent to one task at a time.
///
/// Objects are not reset: lists keep their capacity, and their content, between tasks.
#[derive(Debug, Default)]
pub(crate) struct ScratchPool<T>(Mutex<Vec<T>>);

impl<T: Default> ScratchPool<T> {
    /// Runs `work` with an object of the pool, or with a new one if all are lent.
    pub(crate) fn lend<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
        let mut one = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default();
        let result = work(&mut one);
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(one);
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scratch_pool_reuses_only_returned_objects() {
        let spare: ScratchPool<Vec<u32>> = ScratchPool::default();
        spare.lend(|one| {
            one.push(1);
            spare.lend(|other| {
                assert!(other.is_empty());
                other.extend([2, 3]);
            });
        });
        // The object returned last is lent first.
        spare.lend(|one| {
            assert_eq!(*one, [1]);
            spare.lend(|other| assert_eq!(*other, [2, 3]));
        });
    }
}
