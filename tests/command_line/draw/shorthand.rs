//! Short forms and older option names: `ligne MODEL`, several outputs, and animations selected by pattern.

use crate::folder::{CUBES, Folder, Run};

/// A model with one animation, `lift`.
const CRANE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");

/// A glTF model with a moving node and two animations.
fn two_clips() -> String {
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
fn same(folder: &Folder, one: &str, other: &str) {
    assert_eq!(folder.text(one), folder.text(other), "{one} and {other}");
}

#[test]
fn a_model_as_the_first_word_is_drawn() {
    let folder = Folder::with_cubes("shorthand");
    folder.ligne("draw cubes.obj long.svg --view iso").done();
    folder.ligne("cubes.obj short.svg --view iso").done();
    folder.ligne("--view iso cubes.obj first.svg").done();
    folder.ligne("--no-config ./cubes.obj").done();
    same(&folder, "long.svg", "short.svg");
    same(&folder, "long.svg", "first.svg");
    assert_eq!(folder.names(), ["cubes.obj", "cubes.svg", "first.svg", "long.svg", "short.svg"]);
    // `ligne.toml` applies as it does for `ligne draw`.
    folder.write("ligne.toml", "[draw]\nstyle = 'toon'\n");
    folder.ligne("cubes.obj toon.svg --view iso").done();
    assert_ne!(folder.text("toon.svg"), folder.text("long.svg"));
    folder.ligne("no-such.obj").refused("no-such.obj: ");
    folder.ligne("picture.fbx").refused(".fbx");
}

#[test]
fn a_mistyped_command_gets_a_suggestion_and_a_hidden_file_a_note() {
    let folder = Folder::with_cubes("shorthand-typo");
    folder.ligne("drow cubes.obj").refused("'draw'");
    folder.ligne("sytles").refused("'styles'");
    folder.write("styles", CUBES);
    let run = folder.ligne("styles");
    run.done();
    assert!(
        run.out.contains("ink") && run.err.contains("note: `styles` is a command here; write ./styles"),
        "{run:?}"
    );
    folder.ligne("./styles").refused("styles");
}

#[test]
fn several_drawings_are_named_after_the_model() {
    let folder = Folder::with_cubes("several-outputs");
    folder.ligne("draw cubes.obj a.svg b.png c.dxf -o d.svg").done();
    assert_eq!(folder.names(), ["a.svg", "b.png", "c.dxf", "cubes.obj", "d.svg"]);
    same(&folder, "a.svg", "d.svg");
    folder.ligne("cubes.obj a.svg a.svg").refused("named twice");
    folder.ligne("draw cubes.obj more.obj").refused("--out-dir");
    folder.ligne("draw cubes.obj e.svg f.svg --resume").done();
    assert!(folder.names().contains(&"f.svg".to_owned()));
}

#[test]
fn the_first_clip_is_the_default_and_names_are_patterns() {
    let folder = Folder::new("clips");
    folder.write("flag.gltf", &two_clips());
    let note = |run: Run| {
        run.done().err.lines().filter(|line| line.starts_with("note: ")).collect::<Vec<_>>().join("\n")
    };
    let first = note(folder.ligne("draw flag.gltf first.svg --time 0.5 --strict"));
    assert!(
        first.contains("the first of 2 animations, `wave-slow`; --animation selects others: wave-fast"),
        "{first}"
    );
    assert_eq!(note(folder.ligne("draw flag.gltf named.svg --time 0.5 --animation wave-slow")), "");
    same(&folder, "first.svg", "named.svg");
    assert_eq!(note(folder.ligne("draw flag.gltf glob.svg --time 0.5 --animation *slow")), "");
    same(&folder, "named.svg", "glob.svg");
    let several = note(folder.ligne("draw flag.gltf both.svg --time 0.5 --animation wave*"));
    assert!(several.contains("matches 2 animations; uses the first, `wave-slow`"), "{several}");
    let film = note(folder.ligne("animate flag.gltf film.svg --fps 2 --size 100"));
    assert!(film.contains("the first of 2 animations"), "{film}");
    assert_eq!(note(folder.ligne("draw flag.gltf quiet.svg --time 0.5 --quiet")), "");
    let wrong = |name: &str, expected: &str| {
        folder.run(&["draw", "flag.gltf", "no.svg", "--animation", name]).refused(expected);
    };
    wrong("Wave-Slow", "did you mean `wave-slow`?");
    wrong("wave-fats", "did you mean `wave-fast`?");
    wrong("jump", "its animations are wave-slow, wave-fast");
}

#[test]
fn older_spellings_of_options_still_work() {
    let folder = Folder::with_cubes("spellings");
    folder.write("cases/cubes.toml", "model = '../cubes.obj'\nsize = 100\n");
    folder.write("cases/other.toml", "model = '../cubes.obj'\nsize = 100\nview = 'iso'\n");
    folder.ligne("test cases --bless --cases cubes").done().says("1 blessed");
    folder.ligne("test cases --bless --only other").done().says("1 blessed");
    folder.write("cases/cubes.toml", "model = '../cubes.obj'\nsize = 100\nview = 'top'\n");
    folder.ligne("test cases --html new.html --html-all --out-dir new").ends(1);
    folder.ligne("test cases --report old.html --report-all --output old").ends(1);
    same(&folder, "new.html", "old.html");
    assert_eq!(folder.names_in("new"), folder.names_in("old"));
    assert_eq!(folder.names_in("new"), ["cubes.actual.svg", "cubes.diff.svg"]);

    folder.ligne("draw cubes.obj new.svg --current-colour").done();
    folder.ligne("draw cubes.obj us.svg --current-color").done();
    folder.ligne("draw cubes.obj old.svg --ink currentColor").done();
    same(&folder, "new.svg", "old.svg");
    same(&folder, "us.svg", "old.svg");
    assert!(folder.text("new.svg").contains("currentColor"));
    folder.ligne("draw cubes.obj both.svg both.pdf --current-colour --ink k").done();
    let piped = |words: &str| {
        let mut command = folder.command(&words.split_whitespace().collect::<Vec<_>>());
        let input = std::fs::File::open(folder.path("cubes.obj")).expect("a model");
        Run::new(command.stdin(input).output().expect("the program runs"))
    };
    let new = piped("draw - --input-format obj --quiet");
    assert_eq!(new.done().out, piped("draw - --format obj --quiet").done().out);
    piped("draw -").refused("--input-format");
    piped("draw - --input-format svg").refused("write obj, gltf, glb, stl or ply");
    piped("draw - --input-format obj --format obj").refused("standard input has two formats");
}

#[test]
fn face_counts_are_written_by_one_option_and_read_by_another() {
    let folder = Folder::new("levels");
    let animate =
        |more: &str| folder.ligne(&format!("animate {CRANE} film.svg --size 100 --fps 2 --to 1 {more}"));
    animate("--budget 10s --save-levels new.json").done();
    animate("--budget 10s --levels old.json").done();
    assert!(folder.text("new.json").contains("faces") && folder.text("old.json").contains("faces"));
    animate("--levels new.json").done();
    animate("--save-levels new.json").refused("--budget");
    animate("--budget 10s --levels a.json --save-levels b.json").refused("--levels: face counts are either");
}

#[test]
fn shared_options_have_one_heading() {
    let folder = Folder::new("shared");
    for command in ["animate", "diff"] {
        let help = folder.run(&[command, "--help"]).done().out.clone();
        let (_, shared) = help.split_once("Options shared with ligne draw:\n").expect("the heading");
        for option in ["--style <", "--azimuth <", "--section <", "--page <", "--threads <"] {
            assert!(
                shared.contains(option) && help.matches(option).count() == 1,
                "{command} {option}: {help}"
            );
        }
        assert!(!help.contains("\nView:"), "{help}");
    }
    assert!(!folder.ligne("draw --help").done().out.contains("shared with"));
}
