//! `ligne diff`: exit status, findings, JSON and Markdown output, difference pictures, models and folders.

use crate::folder::TestFolder;

const OLD_SVG: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><g fill="none" stroke="#000">
<path class="crease" data-part="lid" d="M10 10H90"/>
<path class="contour" data-part="bolt" d="M10 50H90"/></g></svg>"##;

/// A folder with the cubes and three drawings: `old.svg`, an equivalent `same.svg`, and `new.svg` with a bolt
/// 2 px lower.
fn folder_with_drawings(name: &str) -> TestFolder {
    let folder = TestFolder::with_cubes(name);
    folder.write("old.svg", OLD_SVG);
    folder.write("same.svg", &OLD_SVG.replace("M10 10H90", "M90 10L50 10M10 10L50 10"));
    folder.write("new.svg", &OLD_SVG.replace("M10 50H90", "M10 52H90"));
    folder
}

#[test]
fn diff_sets_the_exit_status_and_prints_findings() {
    let folder = folder_with_drawings("diff-lines");
    folder.ligne("diff old.svg same.svg").expect_status(0).expect_output("the same within");
    let told = folder.ligne("diff old.svg new.svg");
    told.expect_status(1).expect_output("moved      contour of `bolt` at (50, 51): by 2 px (2 down)");
    assert!(!told.out.contains('\u{1b}'), "colours in a pipe");
    folder.ligne("diff old.svg new.svg --tolerance 3px").expect_status(0);
    folder.ligne("diff old.svg new.svg --tolerance contour=3px").expect_status(0);
    folder.ligne("diff old.svg new.svg --tolerance crease=3px").expect_status(1);
    folder.ligne("diff old.svg new.svg --quiet").expect_status(1);
    folder.ligne("diff old.svg new.svg --pixels").expect_status(1).expect_output("pixels differ");
}

#[test]
fn diff_writes_json_markdown_and_pictures() {
    let folder = folder_with_drawings("diff-forms");
    let told = folder.ligne("diff old.svg new.svg --json");
    told.expect_status(1);
    let json: serde_json::Value = serde_json::from_str(&told.out).unwrap();
    assert_eq!(json["findings"][0]["verdict"], "moved");
    assert_eq!(json["findings"][0]["part"], "bolt");
    assert_eq!(json["same"], false);
    folder.ligne("diff old.svg new.svg --markdown").expect_status(1).expect_output("| moved | 1 |");
    folder.ligne("diff old.svg same.svg --markdown").expect_status(0).expect_output("Nothing differs");
    folder.ligne("diff old.svg same.svg --image none.svg").expect_status(0);
    assert!(!folder.path("none.svg").exists(), "a picture of no difference");
    folder.ligne("diff old.svg new.svg --image over.svg").expect_status(1);
    folder.ligne("diff old.svg new.svg --image beside.png --side-by-side").expect_status(1);
    let over = folder.text("over.svg");
    assert!(over.contains("#d1242f") && over.contains("#1a7f37") && over.contains("#0969da"), "{over}");
    assert!(folder.path("beside.png").exists());
}

#[test]
fn diff_draws_both_models_with_the_same_options() {
    let folder = folder_with_drawings("diff-models");
    let cubes = folder.text("cubes.obj");
    folder.write("again.obj", &format!("# exported anew\n{cubes}"));
    folder.write("one.obj", cubes.split("\no ").next().unwrap_or(&cubes));
    folder.ligne("diff cubes.obj again.obj --view iso").expect_status(0);
    folder.ligne("diff cubes.obj again.obj --style toon --size 300").expect_status(0);
    folder.ligne("draw cubes.obj drawn.svg --size 300").expect_success();
    folder.ligne("diff drawn.svg cubes.obj --size 300").expect_status(0);
}

#[test]
fn diff_pairs_drawings_in_folders_by_name() {
    let folder = folder_with_drawings("diff-folders");
    for (path, text) in [
        ("a/one.svg", OLD_SVG),
        ("a/deep/two.svg", OLD_SVG),
        ("a/gone.svg", OLD_SVG),
        ("b/one.svg", OLD_SVG),
        ("b/notes.txt", ""),
    ] {
        folder.write(path, text);
    }
    folder.write("b/deep/two.svg", &folder.text("new.svg"));
    let told = folder.ligne("diff a b");
    told.expect_status(1)
        .expect_output("removed    gone.svg")
        .expect_output("deep/two.svg: 1 moved (up to 2 px)")
        .expect_output("2 of 3 drawings differ");
    folder.ligne("diff a a").expect_status(0).expect_output("0 of 3 drawings differ");
    folder.write("pictures/readme.txt", "");
    folder.ligne("diff a b --image pictures").expect_status(1);
    assert!(folder.path("pictures/deep-two.svg").exists() && !folder.path("pictures/one.svg").exists());
}

#[test]
fn diff_refuses_inputs_that_cannot_be_compared() {
    let folder = folder_with_drawings("diff-wrong");
    folder.write("broken.svg", &OLD_SVG[..60]);
    folder.write("d/one.svg", OLD_SVG);
    for (call, words) in [
        ("diff old.svg", "required"),
        ("diff old.svg no-such.svg", "no-such.svg"),
        ("diff old.svg broken.svg", "broken.svg"),
        ("diff old.svg d", "is a folder"),
        ("diff old.svg new.svg --tolerance wide", "not a tolerance"),
        ("diff old.svg new.svg --image out.pdf", ".svg or .png"),
        ("diff old.svg new.svg --side-by-side", "--image"),
        ("diff old.svg new.svg --json --markdown", "cannot be used"),
        ("diff d d --image nowhere", "folder"),
    ] {
        folder.ligne(call).expect_status(2).expect_output(words);
    }
}
