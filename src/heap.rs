//! How the program asks Linux for memory: one heap that does not shrink, the first of it in large pages.
//!
//! A drawing makes and drops arrays of many megabytes at every stage. By default glibc gives each back to the system
//! and asks anew for the next, and the system hands out, and clears, four kilobytes at a time: a tenth to a sixth of
//! the time of a drawing went there (`docs/dev/speed.md`). What is asked for here are hints: where the system knows none
//! of them, or has little memory to promise, the program runs as it would without.
//!
//! This is the one place of the project that calls what the compiler cannot check. It calls two functions of the C
//! library, on its own memory, before there is a second thread.

use std::ffi::c_int;

/// How much is promised large pages, which is what a drawing of a million faces takes. Nothing of it is taken before it
/// is written to. More of it was seen to gain much in one run and to lose as much in the next.
const RESERVE: usize = 256 << 20;

/// Less than this is not worth the trouble.
const LEAST_RESERVE: usize = 32 << 20;

/// Pages are at least, and start at multiples of, so many bytes on all machines that Linux runs on with glibc.
const PAGE: usize = 64 << 10;

/// No number of bytes is too many to be kept.
const NEVER: c_int = -1;

/// Has memory come from one heap that does not shrink, in large pages where the system has them.
///
/// To be called first of all, while there is one thread.
pub fn keep() {
    // SAFETY: `mallopt` sets numbers inside the allocator and may be called at any time; it refuses what it does not
    // know, and what it returns says no more than that.
    unsafe {
        // Threads share the heap: what one has dropped, another takes.
        libc::mallopt(libc::M_ARENA_MAX, 1);
        // The heap does not shrink.
        libc::mallopt(libc::M_TRIM_THRESHOLD, NEVER);
        // And no array has a place outside of it, which would go back to the system as soon as it is dropped.
        libc::mallopt(libc::M_MMAP_MAX, 0);
    }
    let mut size = RESERVE;
    while size >= LEAST_RESERVE && !reserve(size) {
        size /= 2;
    }
}

/// Grows the heap by so many bytes, in large pages, and gives them back to it: whether it could.
fn reserve(size: usize) -> bool {
    let mut room: Vec<u8> = Vec::new();
    if room.try_reserve_exact(size).is_err() {
        return false;
    }
    let start = room.as_mut_ptr();
    let into_page = start.align_offset(PAGE);
    let length = (size - into_page) / PAGE * PAGE;
    // SAFETY: the range is whole pages within `room`, which lives; the advice changes how large the pages are that
    // it will be made of, and nothing that can be read there. An error means that nothing was changed.
    unsafe {
        libc::madvise(start.wrapping_add(into_page).cast(), length, libc::MADV_HUGEPAGE);
    }
    true
}
