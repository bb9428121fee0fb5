//! [`run_on_pool`]: runs work on the threads of the pool.

/// Runs work on a thread of the pool. A caller from another thread then waits once, instead of once per
/// parallel part.
pub(crate) fn run_on_pool<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon_core::scope(|_| work())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn run_on_pool_runs_work_on_a_pool_thread() {
        assert!(rayon_core::current_thread_index().is_none());
        assert!(run_on_pool(rayon_core::current_thread_index).is_some());
    }
}
