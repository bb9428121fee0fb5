//! Memory settings of the program on Linux: one heap that never shrinks and starts with large pages.
//!
//! A drawing allocates and frees arrays of many megabytes at every stage. By default glibc returns each to
//! the system and requests the next again. The system then clears and maps pages of 4 kB, which takes 10 to
//! 17 % of the time of a drawing (`docs/dev/speed.md`). The settings are hints. On systems that do not
//! support them, or with little memory, the program runs as it would without them.
//!
//! This is the only unsafe code of the project. It calls two functions of the C library on its own memory,
//! before a second thread starts.

use std::ffi::c_int;

/// Size of the reserve in large pages, bytes: the memory of a drawing with a million faces. Pages are only
/// allocated when written. Larger reserves gave inconsistent gains between runs.
const RESERVE_BYTES: usize = 256 << 20;

/// Minimum reserve, bytes. Smaller ones have no measurable effect.
const MIN_RESERVE_BYTES: usize = 32 << 20;

/// Alignment of the reserve, bytes: the largest page size on Linux systems with glibc.
const PAGE_ALIGN_BYTES: usize = 64 << 10;

/// Value of a threshold that disables trimming.
const TRIM_NEVER: c_int = -1;

/// Configures the allocator: one heap that never shrinks, with large pages where the system supports them.
///
/// Call this first, while there is one thread.
pub fn configure_allocator() {
    // SAFETY: `mallopt` sets parameters of the allocator and may be called at any time. It refuses unknown
    // parameters, and its return value only reports that.
    unsafe {
        // All threads share one heap, so freed memory is reused.
        libc::mallopt(libc::M_ARENA_MAX, 1);
        // The heap does not shrink.
        libc::mallopt(libc::M_TRIM_THRESHOLD, TRIM_NEVER);
        // Arrays stay on the heap. Separately mapped arrays would be returned to the system when freed.
        libc::mallopt(libc::M_MMAP_MAX, 0);
    }
    let mut size = RESERVE_BYTES;
    while size >= MIN_RESERVE_BYTES && !reserve(size) {
        size /= 2;
    }
}

/// Grows the heap by `size` bytes in large pages and frees them again. Returns whether that worked.
fn reserve(size: usize) -> bool {
    let mut room: Vec<u8> = Vec::new();
    if room.try_reserve_exact(size).is_err() {
        return false;
    }
    let start = room.as_mut_ptr();
    let into_page = start.align_offset(PAGE_ALIGN_BYTES);
    let length = (size - into_page) / PAGE_ALIGN_BYTES * PAGE_ALIGN_BYTES;
    // SAFETY: the range consists of whole pages inside `room`, which is alive. The advice changes the size of
    // future pages, but no readable contents. An error means that nothing changed.
    unsafe {
        libc::madvise(start.wrapping_add(into_page).cast(), length, libc::MADV_HUGEPAGE);
    }
    true
}
