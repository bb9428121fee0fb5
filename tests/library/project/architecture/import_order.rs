//! Imports point down the list of areas, and no files import each other in a circle.

use std::collections::BTreeSet;

use super::{Source, sources};
use crate::library::support::imports::{File, import_cycles, import_graph};

/// The areas from the ground up. An area may use itself and the areas before it.
const AREAS: [&str; 31] = [
    "error",
    "parallel",
    "geometry",
    "colour",
    "mesh",
    "surface",
    "scene",
    "edit",
    "animation",
    "load",
    "view",
    "light",
    "lines",
    "visibility",
    "shadows",
    "drawing",
    "text",
    "chains",
    "export",
    "regions",
    "images",
    "diff",
    "testing",
    "strokes",
    "hatching",
    "motion",
    "style",
    "pipeline",
    "animate",
    "page",
    "cli",
];

/// The areas that a piece of code names as `crate::area` or `crate::{area, …}`.
fn areas_named(code: &str) -> Vec<String> {
    let word =
        |text: &str| -> String { text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect() };
    let mut areas = Vec::new();
    for (at, found) in code.match_indices("crate::") {
        let standing_alone = code[..at].chars().next_back().is_none_or(|c| !c.is_alphanumeric() && c != '_');
        let rest = &code[at + found.len()..];
        match rest.strip_prefix('{') {
            _ if !standing_alone => {}
            Some(list) => {
                // Only the outermost names of the list are areas.
                let (mut depth, mut fresh) = (1, true);
                for (i, c) in list.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' => depth -= 1,
                        ',' => fresh = true,
                        _ if fresh && depth == 1 && c.is_alphabetic() => {
                            areas.push(word(&list[i..]));
                            fresh = false;
                        }
                        _ => {}
                    }
                    if depth == 0 {
                        break;
                    }
                }
            }
            None => areas.push(word(rest)),
        }
    }
    areas
}

#[test]
fn areas_named_in_code_are_found() {
    assert_eq!(areas_named("use crate::mesh::{Mesh, Soup};"), ["mesh"]);
    assert_eq!(
        areas_named("use crate::{\n    error::Error,\n    mesh::{Mesh, lines},\n};"),
        ["error", "mesh"]
    );
    assert_eq!(areas_named("let a = crate::geometry::numbers::sin(crate::view::x);"), ["geometry", "view"]);
    assert!(areas_named("use othercrate::mesh;").is_empty());
}

#[test]
fn areas_are_those_of_the_list() {
    let sources = sources();
    let found: BTreeSet<&str> = sources.iter().map(|s| s.area.as_str()).filter(|a| !a.is_empty()).collect();
    assert_eq!(found, BTreeSet::from(AREAS), "folders of src/, and areas of the list");
}

#[test]
fn imports_point_down_the_list_of_areas() {
    let level = |area: &str| AREAS.iter().position(|a| *a == area);
    let mut faults = Vec::new();
    for source in sources().iter().filter(|s| !s.is_test()) {
        let Some(own) = level(&source.area) else { continue };
        let code: Vec<&str> = source.code().into_iter().map(|(_, line)| line).collect();
        for named in areas_named(&code.join("\n")) {
            match level(&named) {
                Some(other) if other <= own => {}
                Some(_) => faults.push(format!("{} uses {named}, a later area", source.path.display())),
                // Macros and re-exports of the crate itself.
                None if named.is_empty() || named == "Error" => {}
                None => faults.push(format!("{} uses {named}, which is no area", source.path.display())),
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A type has one address in the crate: a file exports names of its child modules only. The `mod.rs` of a public
/// area may also publish types of private areas (`pub use crate::…`), for users of the library.
#[test]
fn files_export_only_names_of_their_children() {
    let mut faults = Vec::new();
    let mut exports = 0;
    for source in sources().iter().filter(|s| !s.is_test()) {
        for (number, line) in source.code() {
            let Some((_, path)) = line.split_once("use ").filter(|(before, _)| before.starts_with("pub"))
            else {
                continue;
            };
            exports += 1;
            // A macro belongs to the root of the crate.
            let is_macro = path.starts_with("super::assert_drawing");
            let collects = [
                "animate/mod.rs",
                "drawing/mod.rs",
                "edit/section/mod.rs",
                "internals.rs",
                "pipeline/mod.rs",
            ];
            let collects = collects.contains(&&*source.name())
                || ["scene/mod.rs", "style/mod.rs"].contains(&&*source.name());
            if collects && line.trim_start().starts_with("pub use crate::") {
                continue;
            }
            if (path.starts_with("crate::") || path.starts_with("super::")) && !is_macro {
                faults.push(format!("{}:{number}: {}", source.name(), line.trim()));
            }
        }
    }
    assert!(exports > 100, "{exports} exports");
    assert!(faults.is_empty(), "second addresses:\n{}", faults.join("\n"));
}

/// Circles among the files of a crate, each as its paths.
fn circles_among(files: &[File]) -> Vec<String> {
    import_cycles(&import_graph(files)).into_iter().map(|circle| circle.join(" > ")).collect()
}

#[test]
fn files_import_each_other_in_no_circle() {
    let sources = sources();
    let file = |source: &Source| {
        let lines: Vec<&str> = source.code().into_iter().map(|(_, line)| line).collect();
        File { path: source.name(), code: lines.join("\n") }
    };
    let files: Vec<File> = sources.iter().filter(|s| !s.is_test()).map(file).collect();
    let all = import_graph(&files);
    // The absence of circles means something only if imports are found.
    assert!(all["chains/sampled_line.rs"].contains("chains/sample.rs"), "a name exported by a mod.rs");
    assert!(
        all["pipeline/view/visibility_pass.rs"].contains("visibility/graph.rs"),
        "a name of another area"
    );
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
    // Up and down within an area; the root only exports names.
    let one_way =
        [root, ("low.rs", ""), ("room/a.rs", "use super::b::B;\nuse crate::Low;"), ("room/b.rs", "")];
    assert!(made(&one_way).is_empty());
    let both = [("room/a.rs", "use super::b::{self, B};"), ("room/b.rs", "use crate::room::a::A as B;")];
    assert_eq!(made(&both), ["room/a.rs > room/b.rs"]);
    let by_path = [("room/a.rs", "use super::b;"), ("room/b.rs", "fn f() {\n    super::a::g();\n}")];
    assert_eq!(made(&by_path), ["room/a.rs > room/b.rs"]);
    // Through a name that a mod.rs exports. The export alone makes no circle with the mod.rs.
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
