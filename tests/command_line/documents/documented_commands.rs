//! Commands in the documentation run as written: every `sh` block, in a copy of the example files.
//!
//! The blocks of a page run in order, in one folder with a copy of `examples/`. A block of another language
//! with `file=NAME` is written to that file first. Words after `sh` limit a block:
//!
//! - `slow`: runs in the nightly tests only.
//! - `needs=PROGRAM`: is skipped with a message if the program is missing.

use std::env::{self, join_paths, split_paths};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use super::links_and_examples::{documents, read, root};
use crate::folder::TestFolder;

/// A fenced block of a page.
struct Block<'a> {
    line: usize,
    language: &'a str,
    words: Vec<&'a str>,
    text: String,
}

/// All fenced blocks of a Markdown page, in order.
fn fenced_blocks(page: &str) -> Vec<Block<'_>> {
    let mut found: Vec<Block> = Vec::new();
    let mut is_open = false;
    for (number, line) in page.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if is_open => is_open = false,
            Some(info) => {
                let mut words = info.split_whitespace();
                let language = words.next().unwrap_or_default();
                let block = Block { line: number + 1, language, words: words.collect(), text: String::new() };
                found.push(block);
                is_open = true;
            }
            None if is_open => {
                let text = &mut found.last_mut().unwrap().text;
                text.push_str(line);
                text.push('\n');
            }
            None => {}
        }
    }
    found
}

/// Copies a folder with all subfolders.
fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().flatten() {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy_folder(&entry.path(), &target)
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// The variable `PATH` with the folder of `ligne` first.
fn path_with_program() -> std::ffi::OsString {
    let folder = Path::new(env!("CARGO_BIN_EXE_ligne")).parent().unwrap().to_owned();
    let others = env::var_os("PATH").unwrap_or_default();
    join_paths([folder].into_iter().chain(split_paths(&others))).unwrap()
}

/// Whether a program is in one of the folders of `PATH`.
fn is_installed(program: &str) -> bool {
    let folders: Vec<PathBuf> = split_paths(&env::var_os("PATH").unwrap_or_default()).collect();
    folders.iter().any(|folder| folder.join(program).is_file())
}

/// Runs the blocks of a page. Returns the failures and the number of blocks that ran.
fn run_page(page: &str, with_slow: bool) -> (Vec<String>, usize) {
    let text = read(page);
    let blocks = fenced_blocks(&text);
    let is_command = |block: &&Block| block.language == "sh";
    let (mut faults, mut count) = (Vec::new(), 0);
    if !blocks.iter().any(|block| is_command(&block)) {
        return (faults, count);
    }
    let folder = TestFolder::new("documented");
    copy_folder(&root().join("examples"), &folder.path("examples"));
    for block in &blocks {
        if let Some(name) = block.words.iter().find_map(|word| word.strip_prefix("file=")) {
            folder.write(name, &block.text);
        }
        if !is_command(&block) || (block.words.contains(&"slow") && !with_slow) {
            continue;
        }
        if let Some(needed) = block.words.iter().find_map(|word| word.strip_prefix("needs="))
            && !is_installed(needed)
        {
            eprintln!("{page}:{}: skipped, for {needed} is not installed", block.line);
            continue;
        }
        let output = Command::new("sh")
            .args(["-eu", "-c", &block.text])
            .current_dir(folder.path(""))
            .env("PATH", path_with_program())
            .env_remove("CI")
            .output()
            .unwrap();
        count += 1;
        if !output.status.success() {
            let message = String::from_utf8_lossy(&output.stderr);
            faults.push(format!("{page}:{}: {}\n{}{message}", block.line, output.status, block.text));
        }
    }
    (faults, count)
}

/// Runs all pages on four threads and checks that no block fails.
fn run_all(with_slow: bool) {
    let pages = documents();
    let pages = std::sync::Mutex::new(pages.iter());
    let results = thread::scope(|scope| {
        let work = || {
            let mut done = Vec::new();
            loop {
                let Some(page) = pages.lock().unwrap().next() else { break done };
                done.push(run_page(page, with_slow));
            }
        };
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
    });
    let count: usize = results.iter().map(|(_, count)| count).sum();
    let faults: Vec<&str> = results.iter().flat_map(|(faults, _)| faults).map(String::as_str).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
    assert!(count > 60, "{count} blocks ran");
}

#[cfg(unix)]
#[test]
fn documented_commands_run_as_written() {
    run_all(false);
}

#[cfg(unix)]
#[test]
#[ignore = "long: the slow commands as well"]
fn all_documented_commands_including_slow_ones_run_as_written() {
    run_all(true);
}

#[test]
fn fenced_blocks_are_parsed_with_their_words() {
    let page = "a\n```sh slow needs=vpype\nls\n```\n```toml file=a.toml\nb = 1\n```\n";
    let found = fenced_blocks(page);
    assert_eq!(found.len(), 2);
    assert_eq!((found[0].line, found[0].language, found[0].text.as_str()), (2, "sh", "ls\n"));
    assert_eq!(found[0].words, ["slow", "needs=vpype"]);
    assert_eq!((found[1].words.as_slice(), found[1].text.as_str()), (&["file=a.toml"][..], "b = 1\n"));
}
