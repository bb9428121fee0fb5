//! Laws of the source: order of imports, size of files and folders, 2-D and 3-D, tolerances, and plain words.
//!
//! [`import_order`] reads the import graph; [`file_sizes`] counts files and lines; [`dimensions`] keeps page and
//! world apart; [`tolerances`] finds stray literals; [`wording`] measures names and comments.

mod dimensions;
mod file_sizes;
mod import_order;
mod tolerances;
mod wording;

use std::fs;
use std::path::{Path, PathBuf};

/// A Rust file of the project.
struct Source {
    /// Path under the folder that was read.
    path: PathBuf,
    /// Top-level folder of `src` that holds the file; empty for files directly in `src`.
    area: String,
    text: String,
}

/// All Rust files under a folder of the project, by path.
fn sources_in(folder: &str) -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut found = Vec::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let inner = path.strip_prefix(&root).unwrap();
                let text = fs::read_to_string(&path).unwrap();
                found.push(Source { path: inner.to_path_buf(), area: area_of(inner), text });
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(found.len() > 10, "{folder} was not found");
    found
}

/// The files of the crate.
fn sources() -> Vec<Source> {
    sources_in("src")
}

fn area_of(path: &Path) -> String {
    let folder = path.iter().next().filter(|_| path.iter().count() > 1);
    folder.map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

impl Source {
    /// Path under the folder, with `/`.
    fn name(&self) -> String {
        self.path.display().to_string().replace('\\', "/")
    }

    fn is_test(&self) -> bool {
        let name = self.path.file_name().unwrap().to_string_lossy();
        name == "tests.rs" || self.path.components().any(|c| c.as_os_str() == "tests")
    }

    /// Lines of code with their numbers: no comments, and nothing of blocks under `#[cfg(test)]`.
    fn code(&self) -> Vec<(usize, &str)> {
        let mut code = Vec::new();
        let mut test_block: Option<String> = None;
        let mut pending = false;
        for (number, line) in self.text.lines().enumerate() {
            let indent: String = line.chars().take_while(|c| *c == ' ').collect();
            let bare = line.trim();
            if let Some(end) = &test_block {
                if line.trim_end_matches(';') == *end {
                    test_block = None;
                }
            } else if bare.starts_with("#[cfg(test)]") {
                pending = true;
            } else if pending && bare.ends_with('{') {
                // Formatted code closes a block at the indent that opened it.
                test_block = Some(format!("{indent}}}"));
                pending = false;
            } else if pending {
                pending = bare.starts_with("#[");
            } else if !bare.starts_with("//") {
                code.push((number + 1, line.split(" // ").next().unwrap_or(line)));
            }
        }
        code
    }
}

#[test]
fn reader_code_does_not_panic() {
    let mut faults = Vec::new();
    for source in sources().iter().filter(|s| ["scene", "edit", "load"].contains(&&*s.area) && !s.is_test()) {
        for (number, line) in source.code() {
            // `self.expect` is a parser's own method, which returns an error.
            let line = &line.replace("self.expect(", "self.demand(");
            if [".unwrap()", ".expect(", "panic!(", "unreachable!(", "todo!("]
                .iter()
                .any(|p| line.contains(p))
            {
                faults.push(format!("{}:{number}: {}", source.path.display(), line.trim()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
