//! [`GRAIN`]: how small a task may be.

/// The smallest piece of work for another thread, in vertices, edges or faces: a few nanoseconds each. A thread that sleeps
/// takes some ten microseconds to wake, so that less is done sooner alone; a small part that is drawn has no more
/// than some of these, and one thread would do all of it while the other waits.
pub const GRAIN: usize = 1 << 11;
