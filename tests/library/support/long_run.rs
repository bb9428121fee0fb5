//! How much a run looks at: a part of the views and models by day, all of them at night.

/// Whether all is looked at: in release, or where `LIGNE_ALL` is set.
pub fn is_long() -> bool {
    !cfg!(debug_assertions) || std::env::var_os("LIGNE_ALL").is_some()
}

/// All of these in a long run, else every third, the first among them.
pub fn some<T>(all: Vec<T>) -> Vec<T> {
    let step = if is_long() { 1 } else { 3 };
    all.into_iter().step_by(step).collect()
}
