//! The heap of `ligne` uses huge pages, as set up in `src/heap.rs`.
#![cfg(all(target_os = "linux", target_env = "gnu", target_pointer_width = "64"))]

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::folder::TestFolder;

/// Bytes of the heap that are marked for huge pages (`hg`) in `/proc/<process>/smaps`.
fn huge_page_heap_bytes(process: u32) -> u64 {
    let maps = fs::read_to_string(format!("/proc/{process}/smaps")).unwrap_or_default();
    let (mut heap, mut size, mut large) = (false, 0, 0);
    for line in maps.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            [range, _, _, _, _, name @ ..] if range.contains('-') => heap = name == ["[heap]"],
            ["Size:", kib, "kB"] => size = 1024 * kib.parse::<u64>().unwrap(),
            ["VmFlags:", flags @ ..] if heap && flags.contains(&"hg") => large += size,
            _ => {}
        }
    }
    large
}

#[test]
fn the_heap_uses_huge_pages() {
    if !Path::new("/sys/kernel/mm/transparent_hugepage").exists() {
        eprintln!("skipped: this system has no large pages");
        return;
    }
    let folder = TestFolder::new("heap");
    let mut command = folder.command(&["draw", "-", "a.svg", "--format", "obj"]);
    // The program waits for a model on standard input.
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    let mut large = 0;
    while large == 0 && start.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(5));
        large = huge_page_heap_bytes(child.id());
    }
    drop(child.stdin.take());
    let _ = child.wait();
    assert!(large >= 32 << 20, "{large} bytes");
}
