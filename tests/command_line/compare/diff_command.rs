//! `ligne diff`: exit status, findings, JSON and Markdown output, difference pictures, models and folders.

use crate::folder::Folder;

const OLD: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><g fill="none" stroke="#000">
<path class="crease" data-part="lid" d="M10 10H90"/>
<path class="contour" data-part="bolt" d="M10 50H90"/></g></svg>"##;

/// A folder with the cubes and three drawings: `old.svg`, an equivalent `same.svg`, and `new.svg` with a bolt
/// 2 px lower.
fn folder(name: &str) -> Folder {
    let folder = Folder::with_cubes(name);
    folder.write("old.svg", OLD);
    folder.write("same.svg", &OLD.replace("M10 10H90", "M90 10L50 10M10 10L50 10"));
    folder.write("new.svg", &OLD.replace("M10 50H90", "M10 52H90"));
    folder
}

#[test]
fn status_and_lines_for_people() {
    let folder = folder("diff-lines");
    folder.ligne("diff old.svg same.svg").ends(0).says("the same within");
    let told = folder.ligne("diff old.svg new.svg");
    told.ends(1).says("moved      contour of `bolt` at (50, 51): by 2 px (2 down)");
    assert!(!told.out.contains('\u{1b}'), "colours in a pipe");
    folder.ligne("diff old.svg new.svg --tolerance 3px").ends(0);
    folder.ligne("diff old.svg new.svg --tolerance contour=3px").ends(0);
    folder.ligne("diff old.svg new.svg --tolerance crease=3px").ends(1);
    folder.ligne("diff old.svg new.svg --quiet").ends(1);
    folder.ligne("diff old.svg new.svg --pixels").ends(1).says("pixels differ");
}

#[test]
fn json_markdown_and_pictures() {
    let folder = folder("diff-forms");
    let told = folder.ligne("diff old.svg new.svg --json");
    told.ends(1);
    let json: serde_json::Value = serde_json::from_str(&told.out).unwrap();
    assert_eq!(json["findings"][0]["verdict"], "moved");
    assert_eq!(json["findings"][0]["part"], "bolt");
    assert_eq!(json["same"], false);
    folder.ligne("diff old.svg new.svg --markdown").ends(1).says("| moved | 1 |");
    folder.ligne("diff old.svg same.svg --markdown").ends(0).says("Nothing differs");
    folder.ligne("diff old.svg same.svg --image none.svg").ends(0);
    assert!(!folder.path("none.svg").exists(), "a picture of no difference");
    folder.ligne("diff old.svg new.svg --image over.svg").ends(1);
    folder.ligne("diff old.svg new.svg --image beside.png --side-by-side").ends(1);
    let over = folder.text("over.svg");
    assert!(over.contains("#d1242f") && over.contains("#1a7f37") && over.contains("#0969da"), "{over}");
    assert!(folder.path("beside.png").exists());
}

#[test]
fn models_are_drawn_alike() {
    let folder = folder("diff-models");
    let cubes = folder.text("cubes.obj");
    folder.write("again.obj", &format!("# exported anew\n{cubes}"));
    folder.write("one.obj", cubes.split("\no ").next().unwrap_or(&cubes));
    folder.ligne("diff cubes.obj again.obj --view iso").ends(0);
    folder.ligne("diff cubes.obj again.obj --style toon --size 300").ends(0);
    folder.ligne("draw cubes.obj drawn.svg --size 300").done();
    folder.ligne("diff drawn.svg cubes.obj --size 300").ends(0);
}

#[test]
fn folders_are_paired_by_name() {
    let folder = folder("diff-folders");
    for (path, text) in [
        ("a/one.svg", OLD),
        ("a/deep/two.svg", OLD),
        ("a/gone.svg", OLD),
        ("b/one.svg", OLD),
        ("b/notes.txt", ""),
    ] {
        folder.write(path, text);
    }
    folder.write("b/deep/two.svg", &folder.text("new.svg"));
    let told = folder.ligne("diff a b");
    told.ends(1)
        .says("removed    gone.svg")
        .says("deep/two.svg: 1 moved (up to 2 px)")
        .says("2 of 3 drawings differ");
    folder.ligne("diff a a").ends(0).says("0 of 3 drawings differ");
    folder.write("pictures/readme.txt", "");
    folder.ligne("diff a b --image pictures").ends(1);
    assert!(folder.path("pictures/deep-two.svg").exists() && !folder.path("pictures/one.svg").exists());
}

#[test]
fn what_cannot_be_compared_is_told() {
    let folder = folder("diff-wrong");
    folder.write("broken.svg", &OLD[..60]);
    folder.write("d/one.svg", OLD);
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
        folder.ligne(call).ends(2).says(words);
    }
}
