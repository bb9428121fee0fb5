//! Pictures in the documentation are current, and `ligne test` names the parts that changed in a real model.
//!
//! To approve an intended change, look at the picture, then run `ligne test docs/pictures/cases --bless`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::links_and_examples::documents;
use crate::folder::{RunResult, TestFolder};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn documentation_pictures_are_current() {
    let report = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures.html");
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligne"));
    command.args(["test", "docs/pictures/cases", "--quiet", "--report"]).arg(&report).current_dir(root());
    let run = RunResult::new(command.output().expect("the program runs"));
    assert_eq!(run.status, Some(0), "see {}:\n{}{}", report.display(), run.out, run.err);
}

#[test]
fn every_documentation_svg_has_a_test_case() {
    let mut cases = String::new();
    for entry in fs::read_dir(root().join("docs/pictures/cases")).expect("cases").flatten() {
        cases += &fs::read_to_string(entry.path()).expect("a case");
    }
    let mut pictures = 0;
    for page in documents() {
        let text = fs::read_to_string(root().join(&page)).expect("a page");
        let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
        let names = links.filter_map(|(link, _)| link.split_once("pictures/").map(|(_, name)| name));
        // Difference and stage pictures are not drawings of a model.
        let is_drawing =
            |name: &&str| name.ends_with(".svg") && !name.starts_with("diff-") && !name.starts_with("stage-");
        for name in names.filter(is_drawing) {
            assert!(cases.contains(&format!("drawing = \"../{name}\"")), "{page}: {name}");
            pictures += 1;
        }
    }
    assert!(pictures > 6, "{pictures} pictures found");
}

/// A case that draws the pump, with angles or with a camera that stays fixed when parts are hidden.
const CASE_TOML: &str = "model = '../pump.glb'\nprecision = 2\n";
const VIEW_TOML: &str = "azimuth = 35\nelevation = 22\nsize = 500\n";
const CAMERA_JSON: &str = r#"{"type":"perspective","eye":[1.1,0.55,1.25],"target":[0.2,-0.03,0],"up":[0,1,0],"fov_y_deg":26,
    "width_px":500,"height_px":500}"#;

/// A folder whose drawing is approved with one case file, which is then replaced by `case`.
fn folder_with_pump_case(name: &str, approved: &str, case: &str) -> TestFolder {
    let folder = TestFolder::new(name);
    fs::copy(root().join("examples/models/pump.glb"), folder.path("pump.glb")).expect("the pump");
    folder.write("camera.json", CAMERA_JSON);
    folder.write("cases/pump.toml", approved);
    folder.ligne("test cases --bless").expect_success();
    folder.write("cases/pump.toml", case);
    folder
}

/// All findings of the one case that differs, one per line.
fn findings(folder: &TestFolder) -> Vec<String> {
    let run = folder.ligne("test cases --junit results.xml");
    assert_eq!(run.status, Some(1), "{run:?}");
    let text = folder.text("results.xml");
    let document = usvg::roxmltree::Document::parse(&text).expect("XML");
    let failure = document.descendants().find(|node| node.has_tag_name("failure")).expect("a failure");
    failure.text().unwrap_or_default().lines().map(ToOwned::to_owned).collect()
}

#[test]
fn a_missing_bolt_is_named() {
    let approved = format!("{CASE_TOML}camera = '../camera.json'\n");
    let folder = folder_with_pump_case("pump-bolt", &approved, &format!("{approved}hide = 'frame-bolt-3'\n"));
    let told = findings(&folder);
    assert!(told.len() == 1 && told[0].starts_with("removed    part `frame-bolt-3`: all its "), "{told:#?}");
}

#[test]
fn a_camera_turn_of_a_fifth_of_a_degree_is_reported_once() {
    let approved = format!("{CASE_TOML}{VIEW_TOML}");
    let folder = folder_with_pump_case("pump-camera", &approved, &approved.replace("35", "35.2"));
    let told = findings(&folder);
    let is_one = told.len() == 1 && told[0].contains("seen from another side: ");
    assert!(is_one, "{told:#?}");
    let parts = told[0].split(" marks of ").nth(1).and_then(|rest| rest.split(' ').next());
    let parts: usize = parts.and_then(|parts| parts.parse().ok()).expect("a number of parts");
    assert!(parts > 30, "all that is in sight: {}", told[0]);
}

#[test]
fn a_changed_material_colour_names_its_parts() {
    let approved = format!("{CASE_TOML}camera = '../camera.json'\nstyle = 'toon'\n");
    let case = format!("{approved}[[set.fills.material]]\nname = 'orange rubber'\ncolour = '#3355ee'\n");
    let folder = folder_with_pump_case("pump-colour", &approved, &case);
    let told = findings(&folder);
    let one = |line: &String| {
        line.starts_with("restyled   ") && line.contains("`coupling-star`") && line.contains("colour #")
    };
    assert!(!told.is_empty() && told.iter().all(one), "{told:#?}");
}
