//! Size of a test run: all cases in release builds, a third of them in debug builds.

/// Whether all cases are tested: in release builds, or if `LIGNE_ALL` is set.
pub(crate) fn is_long() -> bool {
    !cfg!(debug_assertions) || std::env::var_os("LIGNE_ALL").is_some()
}

/// All items in a long run, otherwise every third one, starting with the first.
pub(crate) fn select_for_run<T>(all: Vec<T>) -> Vec<T> {
    let step = if is_long() { 1 } else { 3 };
    all.into_iter().step_by(step).collect()
}
