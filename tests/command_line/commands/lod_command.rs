//! `ligne lod`: level-of-detail files are stored next to the model, reused, and ignored if they do not match.

use crate::folder::TestFolder;

/// A folder with a goose of 390 faces and the cubes.
fn folder_with_goose(name: &str) -> TestFolder {
    let folder = TestFolder::with_cubes(name);
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/goose.obj");
    folder.write("goose.obj", &std::fs::read_to_string(example).expect("the goose"));
    folder
}

#[test]
fn lod_files_are_written_next_to_the_model_and_change_no_drawing() {
    let folder = folder_with_goose("lod");
    let run = folder.ligne("draw goose.obj found.svg --faces 200");
    let line = run.expect_success().err.trim_end();
    assert!(line.ends_with(" triangles") && line.lines().count() == 1, "{run:?}");
    let run = folder.ligne("lod goose.obj");
    let line = run.expect_success().err.trim_end();
    assert!(line.starts_with("goose.ligne-lod: 390 faces down to ") && line.ends_with(" ms"), "{run:?}");
    assert_eq!(run.out, "");
    folder.ligne("draw goose.obj taken.svg --faces 200 --threads 1").expect_success();
    assert_eq!(folder.text("found.svg"), folder.text("taken.svg"));
    folder.ligne("draw goose.obj full.svg").expect_success();
    folder.ligne("draw goose.obj all.svg --faces 9999999").expect_success();
    assert_eq!(folder.text("full.svg"), folder.text("all.svg"));
    assert_ne!(folder.text("full.svg"), folder.text("taken.svg"));
}

#[test]
fn lod_files_of_another_model_are_ignored_with_a_warning() {
    let folder = folder_with_goose("lod-foreign");
    folder.ligne("draw goose.obj own.svg --faces 200").expect_success();
    assert_eq!(folder.ligne("lod cubes.obj goose.ligne-lod --quiet").expect_success().err, "");
    let run = folder.ligne("draw goose.obj foreign.svg --faces 200");
    run.expect_success().expect_output(
        "warning: goose.obj: goose.ligne-lod is ignored: these levels of detail belong to another model",
    );
    assert_eq!(folder.text("own.svg"), folder.text("foreign.svg"));
    folder.write("goose.ligne-lod", "nothing of the kind");
    folder
        .ligne("draw goose.obj foreign.svg --faces 200")
        .expect_success()
        .expect_output("this is not a file of levels of detail");
    folder.ligne("draw goose.obj strict.svg --faces 200 --strict").expect_refusal("is ignored");
}

#[test]
fn simplification_keeps_the_faces_that_each_component_needs() {
    let folder = folder_with_goose("lod-few");
    let run = folder.ligne("draw cubes.obj --faces 3");
    run.expect_success().expect_output(
        "warning: cubes.obj: the model keeps 8 faces, because its pieces cannot be simplified further",
    );
    folder
        .ligne("draw cubes.obj knob.svg --faces 5 --only knob")
        .expect_success()
        .expect_output(" 4 triangles");
    folder.ligne("draw cubes.obj --faces 0").expect_refusal("--faces");
}

#[test]
fn lod_refuses_missing_models_and_does_not_overwrite_models() {
    let folder = folder_with_goose("lod-wrong");
    folder.ligne("lod goose.obj goose.obj").expect_refusal("would overwrite the model");
    folder.ligne("lod gone.obj").expect_refusal("gone.obj: ");
    folder.ligne("lod goose.obj nowhere/goose.ligne-lod").expect_refusal("there is no folder nowhere");
    folder.write("broken.obj", "f 1 2 3\n");
    folder.ligne("lod broken.obj").expect_refusal("broken.obj: ");
    assert_eq!(folder.names(), ["broken.obj", "cubes.obj", "goose.obj"]);
}
