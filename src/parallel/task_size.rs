//! [`MIN_TASK_ITEMS`]: the minimum size of a parallel task.

/// Minimum items (vertices, edges or faces) of a task for another thread, at a few nanoseconds each.
///
/// Waking a sleeping thread takes about 10 microseconds, so smaller tasks finish sooner on one thread. A
/// larger value would leave a small part to a single thread.
pub(crate) const MIN_TASK_ITEMS: usize = 1 << 11;
