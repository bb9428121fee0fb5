//! Help, exit status and refused calls of `ligne`; after an error all files are as before.

use crate::folder::Folder;

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new("help");
    for command in ["draw", "diff", "test", "fmt", "info", "styles", "lod", "completions", "man"] {
        let run = folder.run(&[command, "--help"]);
        run.done();
        assert!(run.out.contains(&format!("Usage: ligne {command}")), "{run:?}");
        let (_, example) = run.out.split_once("Example").unwrap_or_else(|| panic!("{run:?}"));
        assert!(example.contains(&format!("ligne {command} ")), "{run:?}");
        assert!(run.err.is_empty());
    }
    assert!(folder.run(&["--help"]).done().out.contains("ligne model.obj"));
    assert_eq!(folder.run(&["--version"]).done().out, format!("ligne {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn help_names_every_option_of_drawing() {
    let help = Folder::new("options").ligne("draw --help").out;
    let options = "style set camera view azimuth elevation fov ortho size page margin scale only hide animation repeat time faces up \
                   background precision report stage threads quiet strict output dpi group id-prefix landscape out-dir format folders \
                   shard resume watch";
    for option in options.split_whitespace() {
        assert!(help.contains(&format!("--{option}")), "{option}");
    }
}

#[test]
fn wrong_calls_say_what_is_meant() {
    let folder = Folder::new("calls");
    folder.ligne("").refused("Usage: ligne [OPTIONS] <COMMAND>");
    folder.ligne("drow").refused("'draw'");
    folder.ligne("draw").refused("<MODEL>");
    folder.ligne("draw m.obj --backgruond white").refused("'--background'");
    folder.ligne("draw m.obj --veiw iso").refused("'--view'");
    folder.ligne("draw m.obj --view fron").refused("'front'");
    folder.ligne("draw m.obj --size 0").refused("sides must be above 0");
    folder.ligne("draw m.obj --page A99").refused("210x297mm");
    folder.ligne("draw m.obj --scale 2 --size 9").refused("--page");
    folder
        .ligne("draw m.obj m.gif")
        .refused("m.gif: ligne cannot write drawings as .gif; end the name with .svg");
    assert!(folder.names().is_empty());
}

#[test]
fn a_missing_model_is_named() {
    let folder = Folder::new("missing");
    folder.ligne("draw no-such.obj").refused("no-such.obj: ");
    folder.ligne("info no-such.obj").refused("no-such.obj: ");
    assert!(folder.names().is_empty());
}

#[test]
fn an_existing_drawing_survives_an_error() {
    let folder = Folder::new("survives");
    folder.write("drawing.svg", "mine");
    folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    for model in ["broken.obj", "no-such.obj"] {
        folder.run(&["draw", model, "drawing.svg", "--report", "report.json"]).refused(model);
    }
    assert_eq!(folder.names(), ["broken.obj", "drawing.svg"]);
    assert_eq!(folder.text("drawing.svg"), "mine");
}

#[test]
fn the_model_is_never_overwritten() {
    let folder = Folder::with_cubes("overwrite");
    folder.write("model.svg", "not a model");
    folder.ligne("draw model.svg model.svg").refused("would overwrite the model");
    folder.ligne("draw cubes.obj a.svg --report cubes.obj").refused("would overwrite the model");
    folder.ligne("draw cubes.obj a.svg -o a.svg").refused("a.svg: this output is named twice");
    assert_eq!(folder.text("cubes.obj"), crate::folder::CUBES);
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_reading() {
    let folder = Folder::with_cubes("place");
    folder.ligne("draw no-such.obj nowhere/a.svg").refused("create the folder first");
    folder.ligne("draw no-such.obj a.svg --report nowhere/a.json").refused("create the folder first");
}

#[test]
fn shells_get_their_completions() {
    let folder = Folder::new("completions");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = folder.run(&["completions", shell]);
        assert!(run.done().out.contains("id-prefix"), "{shell}");
    }
    folder.ligne("completions tcsh").refused("possible values");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let folder = Folder::new("pipe");
    let mut command = folder.command(&["completions", "zsh"]);
    let child = command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped()).spawn();
    let mut child = child.expect("the program runs");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}
