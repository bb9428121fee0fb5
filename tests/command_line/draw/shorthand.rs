//! Short forms and older option names: `ligne MODEL`, several outputs, and animations selected by pattern.

use crate::folder::{CUBES, RunResult, TestFolder};

/// A model with one animation, `lift`.
const CRANE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");

/// A glTF model with a moving node and two animations.
fn gltf_with_two_animations() -> String {
    let positions: Vec<u8> =
        [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let times: Vec<u8> = [0.0_f32, 1.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let moves: Vec<u8> = [0.0_f32, 0.0, 0.0, 0.0, 2.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let bytes = [positions, times, moves].concat();
    let data: String = bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    let clip = |name: &str| {
        format!(
            "{{\"name\":\"{name}\",\"samplers\":[{{\"input\":1,\"output\":2}}],\
             \"channels\":[{{\"sampler\":0,\"target\":{{\"node\":0,\"path\":\"translation\"}}}}]}}"
        )
    };
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"scene\":0,\
         \"nodes\":[{{\"name\":\"flag\",\"mesh\":0}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],\
         \"buffers\":[{{\"byteLength\":{},\"uri\":\"data:application/octet-stream,{data}\"}}],\
         \"bufferViews\":[{{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}},\
         {{\"buffer\":0,\"byteOffset\":36,\"byteLength\":8}},{{\"buffer\":0,\"byteOffset\":44,\"byteLength\":24}}],\
         \"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}},\
         {{\"bufferView\":1,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\",\"min\":[0],\"max\":[1]}},\
         {{\"bufferView\":2,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}}],\
         \"animations\":[{},{}]}}",
        bytes.len(),
        clip("wave-slow"),
        clip("wave-fast")
    )
}

/// Checks that two files have the same text.
fn assert_same_text(folder: &TestFolder, one: &str, other: &str) {
    assert_eq!(folder.text(one), folder.text(other), "{one} and {other}");
}

#[test]
fn a_model_as_first_argument_is_drawn() {
    let folder = TestFolder::with_cubes("shorthand");
    folder.ligne("draw cubes.obj long.svg --view iso").expect_success();
    folder.ligne("cubes.obj short.svg --view iso").expect_success();
    folder.ligne("--view iso cubes.obj first.svg").expect_success();
    folder.ligne("--no-config ./cubes.obj").expect_success();
    assert_same_text(&folder, "long.svg", "short.svg");
    assert_same_text(&folder, "long.svg", "first.svg");
    assert_eq!(folder.names(), ["cubes.obj", "cubes.svg", "first.svg", "long.svg", "short.svg"]);
    // `ligne.toml` applies as it does for `ligne draw`.
    folder.write("ligne.toml", "[draw]\nstyle = 'toon'\n");
    folder.ligne("cubes.obj toon.svg --view iso").expect_success();
    assert_ne!(folder.text("toon.svg"), folder.text("long.svg"));
    folder.ligne("no-such.obj").expect_refusal("no-such.obj: ");
    folder.ligne("picture.fbx").expect_refusal(".fbx");
}

#[test]
fn a_mistyped_command_gets_a_suggestion_and_a_shadowed_file_a_note() {
    let folder = TestFolder::with_cubes("shorthand-typo");
    folder.ligne("drow cubes.obj").expect_refusal("'draw'");
    folder.ligne("sytles").expect_refusal("'styles'");
    folder.write("styles", CUBES);
    let run = folder.ligne("styles");
    run.expect_success();
    assert!(
        run.out.contains("ink") && run.err.contains("note: `styles` is a command here; write ./styles"),
        "{run:?}"
    );
    folder.ligne("./styles").expect_refusal("styles");
}

#[test]
fn several_outputs_may_follow_the_model_argument() {
    let folder = TestFolder::with_cubes("several-outputs");
    folder.ligne("draw cubes.obj a.svg b.png c.dxf -o d.svg").expect_success();
    assert_eq!(folder.names(), ["a.svg", "b.png", "c.dxf", "cubes.obj", "d.svg"]);
    assert_same_text(&folder, "a.svg", "d.svg");
    folder.ligne("cubes.obj a.svg a.svg").expect_refusal("named twice");
    folder.ligne("draw cubes.obj more.obj").expect_refusal("--out-dir");
    folder.ligne("draw cubes.obj e.svg f.svg --resume").expect_success();
    assert!(folder.names().contains(&"f.svg".to_owned()));
}

#[test]
fn animation_defaults_to_the_first_and_accepts_name_patterns() {
    let folder = TestFolder::new("clips");
    folder.write("flag.gltf", &gltf_with_two_animations());
    let note = |run: RunResult| {
        run.expect_success()
            .err
            .lines()
            .filter(|line| line.starts_with("note: "))
            .collect::<Vec<_>>()
            .join("\n")
    };
    let first = note(folder.ligne("draw flag.gltf first.svg --time 0.5 --strict"));
    assert!(
        first.contains("the first of 2 animations, `wave-slow`; --animation selects others: wave-fast"),
        "{first}"
    );
    assert_eq!(note(folder.ligne("draw flag.gltf named.svg --time 0.5 --animation wave-slow")), "");
    assert_same_text(&folder, "first.svg", "named.svg");
    assert_eq!(note(folder.ligne("draw flag.gltf glob.svg --time 0.5 --animation *slow")), "");
    assert_same_text(&folder, "named.svg", "glob.svg");
    let several = note(folder.ligne("draw flag.gltf both.svg --time 0.5 --animation wave*"));
    assert!(several.contains("matches 2 animations; uses the first, `wave-slow`"), "{several}");
    let film = note(folder.ligne("animate flag.gltf film.svg --fps 2 --size 100"));
    assert!(film.contains("the first of 2 animations"), "{film}");
    assert_eq!(note(folder.ligne("draw flag.gltf quiet.svg --time 0.5 --quiet")), "");
    let wrong = |name: &str, expected: &str| {
        folder.run(&["draw", "flag.gltf", "no.svg", "--animation", name]).expect_refusal(expected);
    };
    wrong("Wave-Slow", "did you mean `wave-slow`?");
    wrong("wave-fats", "did you mean `wave-fast`?");
    wrong("jump", "its animations are wave-slow, wave-fast");
}

#[test]
fn older_option_names_still_work() {
    let folder = TestFolder::with_cubes("spellings");
    folder.write("cases/cubes.toml", "model = '../cubes.obj'\nsize = 100\n");
    folder.write("cases/other.toml", "model = '../cubes.obj'\nsize = 100\nview = 'iso'\n");
    folder.ligne("test cases --bless --cases cubes").expect_success().expect_output("1 blessed");
    folder.ligne("test cases --bless --only other").expect_success().expect_output("1 blessed");
    folder.write("cases/cubes.toml", "model = '../cubes.obj'\nsize = 100\nview = 'top'\n");
    folder.ligne("test cases --html new.html --html-all --out-dir new").expect_status(1);
    folder.ligne("test cases --report old.html --report-all --output old").expect_status(1);
    assert_same_text(&folder, "new.html", "old.html");
    assert_eq!(folder.names_in("new"), folder.names_in("old"));
    assert_eq!(folder.names_in("new"), ["cubes.actual.svg", "cubes.diff.svg"]);

    folder.ligne("draw cubes.obj new.svg --current-colour").expect_success();
    folder.ligne("draw cubes.obj us.svg --current-color").expect_success();
    folder.ligne("draw cubes.obj old.svg --ink currentColor").expect_success();
    assert_same_text(&folder, "new.svg", "old.svg");
    assert_same_text(&folder, "us.svg", "old.svg");
    assert!(folder.text("new.svg").contains("currentColor"));
    folder.ligne("draw cubes.obj both.svg both.pdf --current-colour --ink k").expect_success();
    let piped = |words: &str| {
        let mut command = folder.command(&words.split_whitespace().collect::<Vec<_>>());
        let input = std::fs::File::open(folder.path("cubes.obj")).expect("a model");
        RunResult::new(command.stdin(input).output().expect("the program runs"))
    };
    let new = piped("draw - --input-format obj --quiet");
    assert_eq!(new.expect_success().out, piped("draw - --format obj --quiet").expect_success().out);
    piped("draw -").expect_refusal("--input-format");
    piped("draw - --input-format svg").expect_refusal("write obj, gltf, glb, stl or ply");
    piped("draw - --input-format obj --format obj").expect_refusal("standard input has two formats");
}

#[test]
fn save_levels_writes_face_counts_and_levels_reads_them() {
    let folder = TestFolder::new("levels");
    let animate =
        |more: &str| folder.ligne(&format!("animate {CRANE} film.svg --size 100 --fps 2 --to 1 {more}"));
    animate("--budget 10s --save-levels new.json").expect_success();
    animate("--budget 10s --levels old.json").expect_success();
    assert!(folder.text("new.json").contains("faces") && folder.text("old.json").contains("faces"));
    animate("--levels new.json").expect_success();
    animate("--save-levels new.json").expect_refusal("--budget");
    animate("--budget 10s --levels a.json --save-levels b.json")
        .expect_refusal("--levels: face counts are either");
}

#[test]
fn help_lists_shared_options_under_one_heading() {
    let folder = TestFolder::new("shared");
    for command in ["animate", "diff"] {
        let help = folder.run(&[command, "--help"]).expect_success().out.clone();
        let (_, shared) = help.split_once("Options shared with ligne draw:\n").expect("the heading");
        for option in ["--style <", "--azimuth <", "--section <", "--page <", "--threads <"] {
            assert!(
                shared.contains(option) && help.matches(option).count() == 1,
                "{command} {option}: {help}"
            );
        }
        assert!(!help.contains("\nView:"), "{help}");
    }
    assert!(!folder.ligne("draw --help").expect_success().out.contains("shared with"));
}
