//! Help, exit status and refused calls of `ligne`; after an error all files are as before.

use crate::folder::TestFolder;

#[test]
fn every_command_has_help_with_an_example() {
    let folder = TestFolder::new("help");
    for command in ["draw", "diff", "test", "fmt", "info", "styles", "lod", "completions", "man"] {
        let run = folder.run(&[command, "--help"]);
        run.expect_success();
        assert!(run.out.contains(&format!("Usage: ligne {command}")), "{run:?}");
        let (_, example) = run.out.split_once("Example").unwrap_or_else(|| panic!("{run:?}"));
        assert!(example.contains(&format!("ligne {command} ")), "{run:?}");
        assert!(run.err.is_empty());
    }
    assert!(folder.run(&["--help"]).expect_success().out.contains("ligne model.obj"));
    assert_eq!(
        folder.run(&["--version"]).expect_success().out,
        format!("ligne {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn help_lists_every_drawing_option() {
    let help = TestFolder::new("options").ligne("draw --help").out;
    let options = "style set camera view azimuth elevation fov ortho size page margin scale only hide animation repeat time faces up \
                   background precision report stage threads quiet strict output dpi group id-prefix landscape out-dir format folders \
                   shard resume watch";
    for option in options.split_whitespace() {
        assert!(help.contains(&format!("--{option}")), "{option}");
    }
}

#[test]
fn wrong_arguments_get_a_suggestion() {
    let folder = TestFolder::new("calls");
    folder.ligne("").expect_refusal("Usage: ligne [OPTIONS] <COMMAND>");
    folder.ligne("drow").expect_refusal("'draw'");
    folder.ligne("draw").expect_refusal("<MODEL>");
    folder.ligne("draw m.obj --backgruond white").expect_refusal("'--background'");
    folder.ligne("draw m.obj --veiw iso").expect_refusal("'--view'");
    folder.ligne("draw m.obj --view fron").expect_refusal("'front'");
    folder.ligne("draw m.obj --size 0").expect_refusal("sides must be above 0");
    folder.ligne("draw m.obj --page A99").expect_refusal("210x297mm");
    folder.ligne("draw m.obj --scale 2 --size 9").expect_refusal("--page");
    folder
        .ligne("draw m.obj m.gif")
        .expect_refusal("m.gif: ligne cannot write drawings as .gif; end the name with .svg");
    assert!(folder.names().is_empty());
}

#[test]
fn a_missing_model_is_reported_by_name() {
    let folder = TestFolder::new("missing");
    folder.ligne("draw no-such.obj").expect_refusal("no-such.obj: ");
    folder.ligne("info no-such.obj").expect_refusal("no-such.obj: ");
    assert!(folder.names().is_empty());
}

#[test]
fn an_existing_drawing_survives_an_error() {
    let folder = TestFolder::new("survives");
    folder.write("drawing.svg", "mine");
    folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    for model in ["broken.obj", "no-such.obj"] {
        folder.run(&["draw", model, "drawing.svg", "--report", "report.json"]).expect_refusal(model);
    }
    assert_eq!(folder.names(), ["broken.obj", "drawing.svg"]);
    assert_eq!(folder.text("drawing.svg"), "mine");
}

#[test]
fn the_model_is_never_overwritten() {
    let folder = TestFolder::with_cubes("overwrite");
    folder.write("model.svg", "not a model");
    folder.ligne("draw model.svg model.svg").expect_refusal("would overwrite the model");
    folder.ligne("draw cubes.obj a.svg --report cubes.obj").expect_refusal("would overwrite the model");
    folder.ligne("draw cubes.obj a.svg -o a.svg").expect_refusal("a.svg: this output is named twice");
    assert_eq!(folder.text("cubes.obj"), crate::folder::CUBES);
}

#[test]
fn a_missing_output_folder_is_refused_before_reading_the_model() {
    let folder = TestFolder::with_cubes("place");
    folder.ligne("draw no-such.obj nowhere/a.svg").expect_refusal("create the folder first");
    folder.ligne("draw no-such.obj a.svg --report nowhere/a.json").expect_refusal("create the folder first");
}

#[test]
fn completions_exist_for_every_shell() {
    let folder = TestFolder::new("completions");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = folder.run(&["completions", shell]);
        assert!(run.expect_success().out.contains("id-prefix"), "{shell}");
    }
    folder.ligne("completions tcsh").expect_refusal("possible values");
}

#[test]
fn a_closed_output_pipe_is_not_an_error() {
    let folder = TestFolder::new("pipe");
    let mut command = folder.command(&["completions", "zsh"]);
    let child = command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped()).spawn();
    let mut child = child.expect("the program runs");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}
