//! [`Spare`]: what tasks need one after the other, and would not make anew each.

use std::sync::{Mutex, PoisonError};

/// Things that are lent to one task at a time, as many as there are tasks at once.
///
/// Lists that grow while a task works keep their room for the next one. What a task gets is as the one before left it.
#[derive(Debug, Default)]
pub(crate) struct Spare<T>(Mutex<Vec<T>>);

impl<T: Default> Spare<T> {
    /// Does some work with one of them.
    pub fn lend<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
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
    fn what_was_lent_is_lent_again_and_what_is_out_is_not() {
        let spare: Spare<Vec<u32>> = Spare::default();
        spare.lend(|one| {
            one.push(1);
            spare.lend(|other| {
                assert!(other.is_empty());
                other.extend([2, 3]);
            });
        });
        // The last one that came back goes first.
        spare.lend(|one| {
            assert_eq!(*one, [1]);
            spare.lend(|other| assert_eq!(*other, [2, 3]));
        });
    }
}
