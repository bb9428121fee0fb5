//! The SVG pictures of the documents are what ligne draws, and changes of a real model are told by the names of its parts.
//!
//! Where a picture is meant to change, look at it, then approve it: `ligne test docs/pictures/cases --bless`.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use common::Run;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn pictures_are_what_is_drawn() {
    let report = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures.html");
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligne"));
    command.args(["test", "docs/pictures/cases", "--quiet", "--report"]).arg(&report).current_dir(root());
    let run = Run::new(command.output().expect("the program runs"));
    assert_eq!(run.status, Some(0), "see {}:\n{}{}", report.display(), run.out, run.err);
}

#[test]
fn every_svg_picture_of_the_readme_is_a_case() {
    let readme = fs::read_to_string(root().join("README.md")).expect("the README");
    let mut cases = String::new();
    for entry in fs::read_dir(root().join("docs/pictures/cases")).expect("cases").flatten() {
        cases += &fs::read_to_string(entry.path()).expect("a case");
    }
    let links = readme.split("](docs/pictures/").skip(1).filter_map(|rest| rest.split_once(')'));
    let mut pictures = 0;
    for (link, _) in links.filter(|(link, _)| link.ends_with(".svg")) {
        assert!(cases.contains(&format!("drawing = \"../{link}\"")), "{link}");
        pictures += 1;
    }
    assert!(pictures > 6, "{pictures} pictures found");
}
