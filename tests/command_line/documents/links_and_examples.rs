//! Names in the documentation exist: link targets, options, examples and tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Other programs in the documentation. Their lines are not checked for options.
const OTHER_PROGRAMS: [&str; 8] = ["axicli", "cargo ", "vpype", "pip ", "git ", "npm ", "sbatch", "parallel"];

/// Options that no help page lists: of Slurm, `ligne --version`, and a hidden option of `ligne styles`.
const OTHER_OPTIONS: [&str; 7] =
    ["--array", "--cpus-per-task", "--job-name", "--open-mode", "--reference", "--requeue", "--version"];

/// The root of the repository.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The text of a file, by its path from the root.
pub fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// All pages, by their paths from the root.
pub fn documents() -> Vec<String> {
    let mut pages = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "examples/README.md", "fonts/README.md"]
        .map(str::to_owned)
        .to_vec();
    let mut folders = vec!["docs".to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root().join(&folder)).unwrap().flatten() {
            let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                folders.push(path);
            } else if path.ends_with(".md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    assert!(pages.len() > 40, "{} pages found", pages.len());
    pages
}

/// The texts between each `open` and the next `close`.
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

/// The anchor of a heading: lower-case letters, digits, and hyphens for spaces.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[test]
fn links_lead_to_existing_files_and_headings() {
    let mut links = 0;
    for document in &documents() {
        let folder = Path::new(document).parent().unwrap_or(Path::new(""));
        let text = read(document);
        for link in between(&text, "](", ')').filter(|link| !link.contains("://")) {
            let (link, heading) = link.split_once('#').unwrap_or((link, ""));
            // A link with a heading only leads to the same page.
            let target = if link.is_empty() { PathBuf::from(document) } else { folder.join(link) };
            assert!(root().join(&target).exists(), "{document}: {link}");
            let is_there =
                |text: &str| text.lines().any(|line| line.starts_with('#') && anchor(line) == heading);
            assert!(heading.is_empty() || is_there(&read(&target)), "{document}: {link}#{heading}");
            links += 1;
        }
    }
    assert!(links > 15, "{links} links found");
}

/// Every page is reachable by links from the README.
#[test]
fn every_page_is_linked_from_the_readme() {
    let mut reached = vec![root().join("README.md").canonicalize().unwrap()];
    let mut at = 0;
    while let Some(page) = reached.get(at).cloned() {
        at += 1;
        for link in
            between(&fs::read_to_string(&page).unwrap(), "](", ')').filter(|link| !link.contains("://"))
        {
            let link = link.split('#').next().unwrap_or_default();
            let target = page.parent().unwrap().join(link).canonicalize().unwrap();
            if link.ends_with(".md") && !reached.contains(&target) {
                reached.push(target);
            }
        }
    }
    for document in documents().iter().filter(|document| document.starts_with("docs/")) {
        assert!(
            reached.contains(&root().join(document).canonicalize().unwrap()),
            "{document} is linked from nowhere"
        );
    }
}

#[test]
fn the_readme_and_the_changelog_are_short() {
    let words = read("README.md").split_whitespace().count();
    assert!(words <= 700, "{words} words");
    let lines = read("CHANGELOG.md").lines().count();
    assert!(lines <= 60, "{lines} lines in CHANGELOG.md");
}

#[test]
fn tests_named_in_documents_exist() {
    let code = sources("src") + &sources("tests");
    let mut names = 0;
    let pages = ["laws", "architecture", "algorithms", "decisions", "contributing"];
    let pages = pages.map(|page| format!("docs/dev/{page}.md"));
    for document in pages.iter().map(String::as_str).chain(["docs/explanation/exactness.md"]) {
        let text = read(document);
        // Between backticks, only test names have three underscores or more.
        let spans = text.split('`').skip(1).step_by(2);
        for name in spans.clone().filter(|span| span.matches('_').count() > 2 && !span.contains(['/', ' '])) {
            assert!(code.contains(&format!("fn {name}(")), "{document}: there is no test {name}");
            names += 1;
        }
        let is_file = |span: &&str| {
            let is_path = ["src/", "tests/", "docs/", ".ci/"].iter().any(|root| span.starts_with(root));
            is_path && !span.contains('*')
        };
        for file in spans.filter(is_file) {
            assert!(root().join(file).exists(), "{document}: there is no {file}");
        }
    }
    assert!(names > 30, "{names} names found");
}

#[test]
fn options_named_in_documents_exist() {
    let help: String = ["draw", "animate", "diff", "fmt", "test", "info", "lod", "styles", "page"]
        .map(|command| {
            let help = Command::new(env!("CARGO_BIN_EXE_ligne")).args([command, "--help"]).output().unwrap();
            String::from_utf8(help.stdout).unwrap()
        })
        .concat();
    let known: BTreeSet<&str> = help.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).collect();
    let mut options = 0;
    for document in documents().iter().filter(|document| !document.starts_with("docs/dev/")) {
        let text = read(document);
        // Lines that call another program contain its options.
        let own = text.lines().filter(|line| !OTHER_PROGRAMS.iter().any(|name| line.contains(name)));
        for line in own {
            let words = line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
            for option in words.filter(|word| word.starts_with("--") && word.chars().any(char::is_alphabetic))
            {
                assert!(
                    known.contains(option) || OTHER_OPTIONS.contains(&option),
                    "{document}: {option} in: {line}"
                );
                options += 1;
            }
        }
    }
    assert!(options > 100, "{options} options found");
}

#[test]
fn all_examples_are_listed_in_their_readme() {
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
