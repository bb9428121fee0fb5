//! `ligne lod`: level-of-detail files are stored next to the model, reused, and ignored if they do not match.

use crate::folder::Folder;

/// A folder with a goose of 390 faces and the cubes.
fn with_goose(name: &str) -> Folder {
    let folder = Folder::with_cubes(name);
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/goose.obj");
    folder.write("goose.obj", &std::fs::read_to_string(example).expect("the goose"));
    folder
}

#[test]
fn levels_are_written_beside_the_model_and_change_no_drawing() {
    let folder = with_goose("lod");
    let run = folder.ligne("draw goose.obj found.svg --faces 200");
    let line = run.done().err.trim_end();
    assert!(line.ends_with(" triangles") && line.lines().count() == 1, "{run:?}");
    let run = folder.ligne("lod goose.obj");
    let line = run.done().err.trim_end();
    assert!(line.starts_with("goose.ligne-lod: 390 faces down to ") && line.ends_with(" ms"), "{run:?}");
    assert_eq!(run.out, "");
    folder.ligne("draw goose.obj taken.svg --faces 200 --threads 1").done();
    assert_eq!(folder.text("found.svg"), folder.text("taken.svg"));
    folder.ligne("draw goose.obj full.svg").done();
    folder.ligne("draw goose.obj all.svg --faces 9999999").done();
    assert_eq!(folder.text("full.svg"), folder.text("all.svg"));
    assert_ne!(folder.text("full.svg"), folder.text("taken.svg"));
}

#[test]
fn levels_of_another_model_are_left_aside() {
    let folder = with_goose("lod-foreign");
    folder.ligne("draw goose.obj own.svg --faces 200").done();
    assert_eq!(folder.ligne("lod cubes.obj goose.ligne-lod --quiet").done().err, "");
    let run = folder.ligne("draw goose.obj foreign.svg --faces 200");
    run.done().says(
        "warning: goose.obj: goose.ligne-lod is ignored: these levels of detail belong to another model",
    );
    assert_eq!(folder.text("own.svg"), folder.text("foreign.svg"));
    folder.write("goose.ligne-lod", "nothing of the kind");
    folder
        .ligne("draw goose.obj foreign.svg --faces 200")
        .done()
        .says("this is not a file of levels of detail");
    folder.ligne("draw goose.obj strict.svg --faces 200 --strict").refused("is ignored");
}

#[test]
fn as_many_faces_are_kept_as_the_pieces_need() {
    let folder = with_goose("lod-few");
    let run = folder.ligne("draw cubes.obj --faces 3");
    run.done()
        .says("warning: cubes.obj: the model keeps 8 faces, because its pieces cannot be simplified further");
    folder.ligne("draw cubes.obj knob.svg --faces 5 --only knob").done().says(" 4 triangles");
    folder.ligne("draw cubes.obj --faces 0").refused("--faces");
}

#[test]
fn levels_are_not_written_over_a_model_or_without_one() {
    let folder = with_goose("lod-wrong");
    folder.ligne("lod goose.obj goose.obj").refused("would overwrite the model");
    folder.ligne("lod gone.obj").refused("gone.obj: ");
    folder.ligne("lod goose.obj nowhere/goose.ligne-lod").refused("there is no folder nowhere");
    folder.write("broken.obj", "f 1 2 3\n");
    folder.ligne("lod broken.obj").refused("broken.obj: ");
    assert_eq!(folder.names(), ["broken.obj", "cubes.obj", "goose.obj"]);
}
