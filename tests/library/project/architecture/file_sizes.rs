//! Folders hold at most 12 files, files at most 400 lines, and each file opens with a sentence that says what it makes.

use std::collections::BTreeMap;

use super::{Source, sources, sources_in};

/// `mod.rs` is not counted.
const MAX_FILES_PER_FOLDER: usize = 12;

const MAX_LINES_PER_FILE: usize = 400;

/// A head that explains an algorithm and lists the files is short enough to be read.
const MAX_HEAD_LINES: usize = 25;

const FOLDERS: [&str; 4] = ["src", "tests", "benches", "examples"];

/// Every Rust file of the project with its path from the root.
fn all_files() -> Vec<(String, Source)> {
    let named = |folder: &str| -> Vec<(String, Source)> {
        sources_in(folder).into_iter().map(|source| (format!("{folder}/{}", source.name()), source)).collect()
    };
    FOLDERS.into_iter().flat_map(named).collect()
}

#[test]
fn folders_hold_at_most_12_files() {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for (path, _) in all_files() {
        let (folder, name) = path.rsplit_once('/').unwrap();
        if name != "mod.rs" {
            *counts.entry(folder.to_owned()).or_default() += 1;
        }
    }
    counts.retain(|_, count| *count > MAX_FILES_PER_FOLDER);
    assert!(counts.is_empty(), "folders of more than {MAX_FILES_PER_FOLDER} files: {counts:#?}");
}

#[test]
fn files_hold_at_most_400_lines() {
    let lines = |source: &Source| source.text.lines().count();
    let long: Vec<String> = all_files()
        .iter()
        .filter(|(_, source)| lines(source) > MAX_LINES_PER_FILE)
        .map(|(path, source)| format!("{path}: {}", lines(source)))
        .collect();
    assert!(long.is_empty(), "files of more than {MAX_LINES_PER_FILE} lines:\n{}", long.join("\n"));
}

#[test]
fn files_open_with_what_they_make() {
    let is_silent = |source: &Source| !source.is_test() && !source.text.starts_with("//!");
    let silent: Vec<String> = sources().iter().filter(|s| is_silent(s)).map(Source::name).collect();
    assert!(silent.is_empty(), "files without a head:\n{}", silent.join("\n"));
}

#[test]
fn heads_of_folders_are_short_and_list_their_folders() {
    let sources = sources();
    let mut faults = Vec::new();
    for source in sources.iter().filter(|s| s.name().ends_with("/mod.rs") && !s.is_test()) {
        // An example in a head may be long.
        let head: Vec<&str> = source.text.lines().take_while(|line| line.starts_with("//!")).collect();
        let mut in_example = false;
        let lines = head.iter().filter(|line| {
            let is_fence = line.starts_with("//! ```");
            in_example ^= is_fence;
            !is_fence && !in_example
        });
        let count = lines.count();
        if count > MAX_HEAD_LINES {
            faults.push(format!("{}: {count} lines", source.name()));
        }
        let own = source.path.parent().unwrap();
        let children = sources.iter().filter_map(|s| s.path.parent()?.strip_prefix(own).ok());
        for child in children.filter(|child| child.iter().count() == 1) {
            let child = child.display().to_string();
            let is_test_only = child == "tests";
            // The children of a file `foo.rs` are in `foo/`, and its own head names them.
            let has_head = sources.iter().any(|s| s.path == own.join(&child).join("mod.rs"));
            if has_head && !is_test_only && !head.iter().any(|line| line.contains(&format!("`{child}`"))) {
                faults.push(format!("{}: no word of {child}/", source.name()));
            }
        }
    }
    faults.sort();
    faults.dedup();
    assert!(faults.is_empty(), "heads:\n{}", faults.join("\n"));
}
