//! The shape of the source: imports point down the list of rooms and lead in no circle, files are short, readers do
//! not panic.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::imports::{File, import_cycles, import_graph};

/// The rooms from the ground up; a room may use itself and the rooms before it.
const ROOMS: [&str; 34] = [
    "error", "parallel", "math", "mesh", "trees", "shape", "scene", "section", "explode", "lod", "pose",
    "load", "view", "raster", "field", "lines", "viewmap", "shadow", "drawing", "text", "chain", "export",
    "region", "picture", "diff", "testing", "stroke", "hatch", "motion", "style", "render", "animate",
    "page", "cli",
];

/// The folder of those rooms that are stages; it is no room itself.
const STAGES: &str = "stages";

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
                let text = fs::read_to_string(&path).unwrap();
                found.push(Source { path: inner.to_path_buf(), room: room(inner), text });
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(found.len() > 50, "src/ was not found");
    found
}

/// The room of a file; empty for the roots of the crate and the list of stages, which are in none.
fn room(path: &Path) -> String {
    let mut names = path.iter().map(|name| name.to_string_lossy()).filter(|name| name != STAGES);
    let first = names.next().unwrap_or_default();
    let name = first.trim_end_matches(".rs");
    // The heap is the program's alone, beside its `main`.
    if ["lib", "main", "mod", "heap"].contains(&name) { String::new() } else { name.to_owned() }
}

impl Source {
    /// Its path with `/`.
    fn place(&self) -> String {
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
fn rooms_are_those_of_the_list() {
    let sources = sources();
    let found: BTreeSet<&str> = sources.iter().map(|s| s.room.as_str()).filter(|r| !r.is_empty()).collect();
    assert_eq!(found, BTreeSet::from(ROOMS), "rooms in src/, and those of the list");
    let list = sources.iter().find(|s| s.place() == "stages/mod.rs").unwrap();
    let is_module = |line: &str| line.is_empty() || line.starts_with("pub mod ") && line.ends_with(';');
    assert!(list.code().iter().all(|(_, line)| is_module(line)), "stages/mod.rs holds more than a list");
}

#[test]
fn imports_point_down_the_list_of_rooms() {
    let level = |room: &str| ROOMS.iter().position(|r| *r == room);
    let mut faults = Vec::new();
    for source in sources().iter().filter(|s| !s.is_test()) {
        let Some(own) = level(&source.room) else { continue };
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

/// Circles among the files of a crate, each as its places.
fn circles_among(files: &[File]) -> Vec<String> {
    import_cycles(&import_graph(files)).into_iter().map(|circle| circle.join(" > ")).collect()
}

#[test]
fn files_import_each_other_in_no_circle() {
    let sources = sources();
    let file = |source: &Source| {
        let lines: Vec<&str> = source.code().into_iter().map(|(_, line)| line).collect();
        File { path: source.place(), code: lines.join("\n") }
    };
    let files: Vec<File> = sources.iter().filter(|s| !s.is_test()).map(file).collect();
    let all = import_graph(&files);
    // That there is none means something only if imports are found.
    assert!(all["stages/chain/line.rs"].contains("stages/chain/sample.rs"), "a name made public by a mod.rs");
    assert!(all["render/on_view.rs"].contains("stages/viewmap/graph.rs"), "a name of a stage");
    let found = circles_among(&files);
    assert!(found.is_empty(), "files that import each other:\n{}", found.join("\n"));
}

#[test]
fn circles_are_found() {
    let made = |files: &[(&str, &str)]| -> Vec<String> {
        let file = |(place, code): &(&str, &str)| File { path: (*place).into(), code: (*code).into() };
        circles_among(&files.iter().map(file).collect::<Vec<_>>())
    };
    let root = ("lib.rs", "pub mod room;\nmod low;\npub use low::Low;");
    // Up and down within a room; the root only hands names on.
    let one_way =
        [root, ("low.rs", ""), ("room/a.rs", "use super::b::B;\nuse crate::Low;"), ("room/b.rs", "")];
    assert!(made(&one_way).is_empty());
    let both = [("room/a.rs", "use super::b::{self, B};"), ("room/b.rs", "use crate::room::a::A as B;")];
    assert_eq!(made(&both), ["room/a.rs > room/b.rs"]);
    let by_path = [("room/a.rs", "use super::b;"), ("room/b.rs", "fn f() {\n    super::a::g();\n}")];
    assert_eq!(made(&by_path), ["room/a.rs > room/b.rs"]);
    // By way of a name that a mod.rs makes public; that alone makes no circle with the mod.rs.
    let front = ("room/mod.rs", "mod a;\nmod b;\npub use a::{A, Other};");
    assert_eq!(made(&[front, ("room/a.rs", "use super::b::B;"), ("room/b.rs", "")]), [""; 0]);
    let through = [front, ("room/a.rs", "use super::b::B;"), ("room/b.rs", "use super::A;")];
    assert_eq!(made(&through), ["room/a.rs > room/b.rs"]);
    // A mod.rs that uses a child which uses what the mod.rs defines.
    let parent = [("room/mod.rs", "mod a;\nuse a::A;\nstruct Own;"), ("room/a.rs", "use super::Own;")];
    assert_eq!(made(&parent), ["room/a.rs > room/mod.rs"]);
    // Longer ones.
    let three = [
        ("a.rs", "use crate::{b::B};"),
        ("b.rs", "use super::{\n    c::{C},\n};"),
        ("c.rs", "use crate::a::*;"),
    ];
    assert_eq!(made(&[&[root][..], &three].concat()), ["a.rs > b.rs > c.rs"]);
}

#[test]
fn files_are_short() {
    let lines = |s: &Source| s.text.lines().count();
    let long: Vec<String> = sources().iter().filter(|s| lines(s) > LONGEST_FILE).map(Source::place).collect();
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
    for source in
        sources().iter().filter(|s| ["scene", "section", "lod", "load"].contains(&&*s.room) && !s.is_test())
    {
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
