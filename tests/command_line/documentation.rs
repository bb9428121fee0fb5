//! What the documents say is there: links, options, examples, and the tests that rules name.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const DOCUMENTS: [&str; 19] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "docs/styles.md",
    "docs/detail.md",
    "docs/exactness.md",
    "docs/fills.md",
    "docs/letters.md",
    "docs/lines.md",
    "docs/many.md",
    "docs/motion.md",
    "docs/pages.md",
    "docs/print.md",
    "docs/sheets.md",
    "docs/smooth.md",
    "docs/stages.md",
    "docs/testing.md",
    "docs/web.md",
    "examples/README.md",
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What stands in a text between each `open` and the next `close`.
fn between<'a>(text: &'a str, open: &'a str, close: char) -> impl Iterator<Item = &'a str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split_once(close)).map(|(inner, _)| inner)
}

/// All Rust files under a folder, as one text.
fn sources(folder: &str) -> String {
    let (mut folders, mut text) = (vec![root().join(folder)], String::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                text.push_str(&fs::read_to_string(&path).unwrap());
            }
        }
    }
    text
}

/// How links name a heading: small letters, digits, and hyphens for spaces.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[test]
fn links_lead_to_files() {
    let mut links = 0;
    for document in DOCUMENTS {
        let folder = Path::new(document).parent().unwrap_or(Path::new(""));
        let text = read(document);
        for link in between(&text, "](", ')').filter(|link| !link.contains("://")) {
            let (link, heading) = link.split_once('#').unwrap_or((link, ""));
            assert!(root().join(folder).join(link).exists(), "{document}: {link}");
            let is_there =
                |text: &str| text.lines().any(|line| line.starts_with('#') && anchor(line) == heading);
            assert!(heading.is_empty() || is_there(&read(folder.join(link))), "{document}: {link}#{heading}");
            links += 1;
        }
    }
    assert!(links > 15, "{links} links found");
}

#[test]
fn tests_that_documents_name_are_there() {
    let code = sources("src") + &sources("tests");
    let mut names = 0;
    for document in ["ARCHITECTURE.md", "docs/exactness.md"] {
        let text = read(document);
        // Names of tests are sentences; nothing else between back-ticks has three underscores.
        let spans = text.split('`').skip(1).step_by(2);
        for name in spans.clone().filter(|span| span.matches('_').count() > 2 && !span.contains(['/', ' '])) {
            assert!(code.contains(&format!("fn {name}(")), "{document}: there is no test {name}");
            names += 1;
        }
        for file in spans.filter(|span| span.starts_with("tests/") && span.ends_with(".rs")) {
            assert!(root().join(file).exists(), "{document}: {file}");
        }
    }
    assert!(names > 30, "{names} names found");
}

#[test]
fn options_that_the_readme_names_are_there() {
    let help: String = ["draw", "animate", "diff", "fmt", "test", "info", "lod", "styles", "page"]
        .map(|command| {
            let help = Command::new(env!("CARGO_BIN_EXE_ligne")).args([command, "--help"]).output().unwrap();
            String::from_utf8(help.stdout).unwrap()
        })
        .concat();
    // `--report-all` is an older spelling of `--html-all`.
    let known = ["--release", "--path", "--open", "--json", "--example", "--test", "--report-all"];
    // Those of GNU parallel and of Slurm.
    let others = [
        "--joblog",
        "--retry-failed",
        "--job-name",
        "--array",
        "--cpus-per-task",
        "--requeue",
        "--open-mode",
    ];
    let mut options = 0;
    for document in [
        "README.md",
        "docs/detail.md",
        "docs/fills.md",
        "docs/many.md",
        "docs/styles.md",
        "docs/smooth.md",
        "docs/stages.md",
        "docs/diff.md",
        "docs/testing.md",
        "docs/print.md",
        "docs/sheets.md",
        "docs/web.md",
        "examples/README.md",
    ] {
        let text = read(document);
        let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
        for option in words.filter(|word| word.starts_with("--") && word.chars().any(char::is_alphabetic)) {
            let there = help.contains(&format!("{option} ")) || help.contains(&format!("{option}\n"));
            assert!(there || known.contains(&option) || others.contains(&option), "{document}: {option}");
            options += 1;
        }
    }
    assert!(options > 25, "{options} options found");
}

#[test]
fn examples_are_listed() {
    let index = read("examples/README.md");
    for entry in fs::read_dir(root().join("examples")).unwrap().flatten() {
        let path = entry.path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let is_program = path.extension().is_some_and(|e| e == "rs") || path.join("main.rs").exists();
        assert!(!is_program || index.contains(&format!("--example {name}")), "{name}");
    }
    for entry in fs::read_dir(root().join("examples/models")).unwrap().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        assert!(name.ends_with(".mtl") || index.contains(&format!("models/{name}")), "{name}");
    }
}
