//! [`on_threads`]: work that is begun on the threads that share it.

/// Does some work on one of the threads that parts of it are shared out to: whoever calls from another thread waits for them
/// once, and not at each part.
pub(crate) fn on_threads<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon_core::scope(|_| work())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_begins_on_a_thread_that_shares_it() {
        assert!(rayon_core::current_thread_index().is_none());
        assert!(on_threads(rayon_core::current_thread_index).is_some());
    }
}
