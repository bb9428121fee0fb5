//! The shape of the source: imports point down the list of rooms, files are short, readers do not
//! panic.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms from the ground up; a room may use itself and the rooms before it.
const ROOMS: [&str; 22] = [
    "error", "math", "mesh", "scene", "view", "raster", "field", "lines", "viewmap", "shadow", "drawing",
    "chain", "export", "region", "diff", "testing", "stroke", "hatch", "motion", "style", "render", "cli",
];

const LONGEST_FILE: usize = 500;

/// Files that are to be cut in two; an entry that is short by now must go.
const TOO_LONG: [&str; 0] = [];

struct Source {
    path: PathBuf,
    room: String,
    text: String,
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let inner = path.strip_prefix(&root).unwrap();
                let room = inner.components().next().unwrap().as_os_str().to_string_lossy().into_owned();
                let room = room.trim_end_matches(".rs").to_owned();
                let text = fs::read_to_string(&path).unwrap();
                found.push(Source { path: inner.to_path_buf(), room, text });
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(found.len() > 50, "src/ was not found");
    found
}

impl Source {
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
                if line == *end {
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

/// The rooms that a piece of code names as `crate::room` or `crate::{room, …}`.
fn rooms_named(code: &str) -> Vec<String> {
    let word =
        |text: &str| -> String { text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect() };
    let mut rooms = Vec::new();
    for (at, found) in code.match_indices("crate::") {
        let standing_alone = code[..at].chars().next_back().is_none_or(|c| !c.is_alphanumeric() && c != '_');
        let rest = &code[at + found.len()..];
        match rest.strip_prefix('{') {
            _ if !standing_alone => {}
            Some(list) => {
                // Only the outermost names of the list are rooms.
                let (mut depth, mut fresh) = (1, true);
                for (i, c) in list.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' => depth -= 1,
                        ',' => fresh = true,
                        _ if fresh && depth == 1 && c.is_alphabetic() => {
                            rooms.push(word(&list[i..]));
                            fresh = false;
                        }
                        _ => {}
                    }
                    if depth == 0 {
                        break;
                    }
                }
            }
            None => rooms.push(word(rest)),
        }
    }
    rooms
}

#[test]
fn names_of_rooms_are_found() {
    assert_eq!(rooms_named("use crate::mesh::{Mesh, Soup};"), ["mesh"]);
    assert_eq!(
        rooms_named("use crate::{\n    error::Error,\n    mesh::{Mesh, lines},\n};"),
        ["error", "mesh"]
    );
    assert_eq!(rooms_named("let a = crate::math::function::sin(crate::view::x);"), ["math", "view"]);
    assert!(rooms_named("use othercrate::mesh;").is_empty());
}

#[test]
fn imports_point_down_the_list_of_rooms() {
    let level = |room: &str| ROOMS.iter().position(|r| *r == room);
    let mut faults = Vec::new();
    for source in sources().iter().filter(|s| !s.is_test()) {
        if ["lib", "main"].contains(&source.room.as_str()) {
            continue;
        }
        let Some(own) = level(&source.room) else {
            faults.push(format!("{}: no room of the list", source.path.display()));
            continue;
        };
        let code: Vec<&str> = source.code().into_iter().map(|(_, line)| line).collect();
        for named in rooms_named(&code.join("\n")) {
            match level(&named) {
                Some(other) if other <= own => {}
                Some(_) => faults.push(format!("{} uses {named}, a room above", source.path.display())),
                // Macros and re-exports of the crate itself.
                None if named.is_empty() || named == "Error" => {}
                None => faults.push(format!("{} uses {named}, no room of the list", source.path.display())),
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn files_are_short() {
    let lines = |s: &Source| s.text.lines().count();
    let long: Vec<String> = sources()
        .iter()
        .filter(|s| lines(s) > LONGEST_FILE)
        .map(|s| s.path.display().to_string().replace('\\', "/"))
        .collect();
    assert_eq!(long, TOO_LONG, "files of more than {LONGEST_FILE} lines");
}

#[test]
fn files_open_with_what_they_make() {
    let silent: Vec<String> = sources()
        .iter()
        .filter(|s| !s.is_test() && !s.text.starts_with("//!"))
        .map(|s| s.path.display().to_string())
        .collect();
    assert!(silent.is_empty(), "{}", silent.join("\n"));
}

#[test]
fn readers_do_not_panic() {
    let mut faults = Vec::new();
    for source in sources().iter().filter(|s| s.room == "scene" && !s.is_test()) {
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
