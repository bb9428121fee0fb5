//! Batches of `ligne draw_arguments` give the files of single runs: shards, `--resume`, `--watch`, standard input.

use std::fs;
use std::io::Write;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crate::folder::{CUBES, RunResult, TestFolder};

/// Models in a batch. One model in `MODELS_PER_BROKEN_ONE` is broken: 2 %.
const MODEL_COUNT: usize = 100;
const MODELS_PER_BROKEN_ONE: usize = 50;

/// The cubes as OBJ, with the base stretched to this width along x.
fn cubes_of_width(width: f64) -> String {
    CUBES.replace("v 1 ", &format!("v {width} "))
}

/// A folder with models in `models/`, 2 % of them broken, and the names of the models.
fn folder_with_models(name: &str) -> (TestFolder, Vec<String>) {
    let folder = TestFolder::new(name);
    let names: Vec<String> = (0..MODEL_COUNT).map(|i| format!("models/m{i:03}.obj")).collect();
    for (i, name) in names.iter().enumerate() {
        let text = if i % MODELS_PER_BROKEN_ONE == 7 {
            "v 0 0 0\nf 1 2 3\n".to_owned()
        } else {
            cubes_of_width(1.0 + i as f64 / 100.0)
        };
        folder.write(name, &text);
    }
    (folder, names)
}

/// Arguments of a call that draws these models at 200 px, followed by `more`.
fn draw_arguments<'a>(models: &'a [String], more: &'a str) -> Vec<&'a str> {
    let models = models.iter().map(String::as_str);
    ["draw"].into_iter().chain(models).chain(["--size", "200"]).chain(more.split_whitespace()).collect()
}

/// Waits until the condition holds, at most 60 s, and returns the time it took.
fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) -> Duration {
    let started = Instant::now();
    while !is_so() {
        assert!(started.elapsed() < Duration::from_secs(60), "{what} did not come about");
        std::thread::sleep(Duration::from_millis(2));
    }
    started.elapsed()
}

/// Checks that two folders hold the same files with the same bytes.
fn assert_same_files(folder: &TestFolder, one: &str, other: &str) {
    assert_eq!(folder.names_in(one), folder.names_in(other));
    for name in folder.names_in(one) {
        let of = |run: &str| folder.read(&format!("{run}/{name}"));
        assert_eq!(of(one), of(other), "{name}");
    }
}

#[test]
fn killed_and_resumed_shards_give_the_same_files_as_one_run() {
    let (folder, models) = folder_with_models("many-shards");
    let run = folder.run(&draw_arguments(&models, "--out-dir one --threads 2"));
    run.expect_status(2).expect_output("one: 98 models drawn, 98 files, ").expect_output(", 2 refused");
    for broken in ["error: models/m007.obj: line 2: ", "error: models/m057.obj: line 2: "] {
        run.expect_output(broken);
    }
    assert_eq!(folder.names_in("one").len(), 98);
    assert_eq!(
        folder.run(&draw_arguments(&models, "--out-dir one --quiet")).expect_status(2).err.lines().count(),
        2
    );

    // Models 7 and 57 are broken, so their shards end with status 2. SLURM variables select shard 4.
    for (shard, status) in [("1/4", 0), ("2/4", 2)] {
        let run =
            folder.run(&draw_arguments(&models, &format!("--out-dir four --threads 1 --shard {shard}")));
        run.expect_status(status).expect_output(&format!("four: shard {shard}, "));
    }
    let mut command = folder.command(&draw_arguments(&models, "--out-dir four --threads 1 --quiet"));
    let task = [("SLURM_ARRAY_TASK_ID", "4"), ("SLURM_ARRAY_TASK_COUNT", "4"), ("SLURM_ARRAY_TASK_MIN", "1")];
    RunResult::new(command.envs(task).output().unwrap()).expect_status(2);
    let before = folder.names_in("four").len();
    assert_eq!(before, 73);

    let mut child = folder
        .command(&draw_arguments(&models, "--out-dir four --threads 1 --quiet --shard 3/4"))
        .spawn()
        .unwrap();
    wait_until("the third drawing of a shard", || folder.names_in("four").len() >= before + 3);
    child.kill().unwrap();
    child.wait().unwrap();
    for name in folder.names_in("four").iter().filter(|name| !name.starts_with('.')) {
        assert_eq!(
            folder.read(&format!("four/{name}")),
            folder.read(&format!("one/{name}")),
            "half a file: {name}"
        );
    }
    // A temporary file that a kill may leave, one of another run, and a drawing that is older than its model.
    folder.write("four/.m002.svg.99999-0.tmp", "<svg");
    folder.write("four/.other.svg.99999-0.tmp", "not of this run");
    let _ = fs::remove_file(folder.path("four/m002.svg"));
    let old = fs::File::options().write(true).open(folder.path("four/m001.svg")).unwrap();
    old.set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
    let run = folder.run(&draw_arguments(&models, "--out-dir four --shard 3/4 --resume"));
    run.expect_status(0).expect_output(" up to date");
    let run = folder.run(&draw_arguments(&models, "--out-dir four --resume"));
    run.expect_status(2)
        .expect_output("four: 1 model drawn, 1 file, ")
        .expect_output(", 2 refused, 97 up to date");
    fs::remove_file(folder.path("four/.other.svg.99999-0.tmp")).unwrap();
    assert_same_files(&folder, "one", "four");
}

#[test]
fn views_and_formats_of_a_batch_equal_separate_calls() {
    let folder = TestFolder::with_cubes("many-views");
    folder.write("gear.obj", &cubes_of_width(2.0));
    let run = folder
        .ligne("draw cubes.obj gear.obj --out-dir d --format svg,png --view front,top,front --style toon");
    run.expect_success().expect_output("d: 2 models drawn, 8 files, ");
    assert_eq!(folder.names_in("d").len(), 8);
    for (model, view) in [("cubes", "front"), ("cubes", "top"), ("gear", "top")] {
        // The title is the name of the model, not of the output file.
        for ending in ["svg", "png"] {
            let alone = format!("{model}-{view}.{ending}");
            folder
                .ligne(&format!("draw {model}.obj {alone} --view {view} --style toon --quiet"))
                .expect_success();
            assert_eq!(folder.read(&alone), folder.read(&format!("d/{alone}")), "{alone}");
        }
    }
    let run = folder.ligne("draw cubes.obj out.svg -o out.pdf --view iso,back");
    run.expect_success().expect_output("out-iso.svg: 1000 x 1000 px, ").expect_output("out-back.pdf: ");
    folder.ligne("draw cubes.obj alone.svg --view back --quiet").expect_success();
    assert_eq!(folder.text("alone.svg"), folder.text("out-back.svg"));
    folder.ligne("draw gear.obj --format png,svg --quiet").expect_success();
    assert!(
        folder.names().contains(&"gear.png".to_owned()) && folder.names().contains(&"gear.svg".to_owned())
    );
}

#[test]
fn output_name_collisions_between_models_are_refused() {
    let folder = TestFolder::new("many-names");
    folder.write("a/m.obj", CUBES);
    folder.write("b/m.obj", &cubes_of_width(3.0));
    let both = "draw a/m.obj b/m.obj --out-dir d";
    folder.ligne(both).expect_refusal(
        "d/m.svg: the drawings of a/m.obj and b/m.obj would have the same name; give --folders",
    );
    assert_eq!(folder.names(), ["a", "b"]);
    folder.ligne(&format!("{both} --folders")).expect_success();
    assert_ne!(folder.text("d/a/m.svg"), folder.text("d/b/m.svg"));
    // Two paths of the same model count once.
    folder
        .ligne("draw a/m.obj ./a/m.obj --out-dir e")
        .expect_success()
        .expect_output("e: 1 model drawn, 1 file, ");
    folder.write("a/m.stl", "solid");
    folder.ligne("draw a/m.obj a/m.stl --out-dir d").expect_refusal("rename one");
    folder.ligne("draw a/m.obj ../m.obj --out-dir d --folders").expect_refusal("..");
}

#[test]
fn resume_redraws_only_when_an_input_file_changed() {
    let folder = TestFolder::with_cubes("many-resume");
    folder.write("base.toml", "extends = \"ink\"\n");
    folder.write("mine.toml", "extends = \"base.toml\"\n");
    let record =
        "{\"type\":\"perspective\",\"eye\":[4,3,9],\"target\":[0,0,0],\"up\":[0,1,0],\"fov_y_deg\":35}";
    folder.write("c.json", record);
    let line = "draw cubes.obj --out-dir d --format svg,png --style mine.toml --camera c.json --resume";
    let drawn = |wanted: u32| {
        folder.ligne(line).expect_success().expect_output(&format!("d: {wanted} model"));
    };
    drawn(1);
    drawn(0);
    for file in ["cubes.obj", "mine.toml", "base.toml", "c.json"] {
        std::thread::sleep(Duration::from_millis(20));
        let text = folder.text(file);
        folder.write(file, &text);
        drawn(1);
        drawn(0);
    }
    fs::remove_file(folder.path("d/cubes.png")).unwrap();
    drawn(1);
}

#[test]
fn exit_status_separates_broken_models_from_write_errors() {
    let folder = TestFolder::with_cubes("many-status");
    folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    folder.ligne("draw cubes.obj broken.obj --out-dir d").expect_status(2);
    // A folder that cannot be created is a write error: status 75, try again.
    folder.write("d/sub", "in the way");
    folder.write("sub/cubes.obj", CUBES);
    let run = folder.ligne("draw sub/cubes.obj broken.obj cubes.obj --out-dir d --folders");
    run.expect_status(75)
        .expect_output("d/sub")
        .expect_output("1 model drawn, 1 file, ")
        .expect_output(", 1 refused, 1 to be tried again");
    folder.ligne("draw cubes.obj --out-dir cubes.obj").expect_refusal("this is not a folder");
    #[cfg(target_os = "linux")]
    if fs::metadata("/dev/full").is_ok() {
        std::os::unix::fs::symlink("/dev/full", folder.path("full.svg")).unwrap();
        let run = folder.ligne("draw cubes.obj full.svg");
        run.expect_status(75).expect_output("full.svg: cannot write").expect_output("free some space");
    }
}

/// Runs `ligne` with a model on standard input.
fn run_with_input(folder: &TestFolder, model: &[u8], line: &str) -> RunResult {
    let mut command = folder.command(&line.split_whitespace().collect::<Vec<_>>());
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // A refused call closes standard input without reading it, so the write may fail.
    let _ = child.stdin.take().unwrap().write_all(model);
    RunResult::new(child.wait_with_output().unwrap())
}

#[test]
fn models_are_read_from_standard_input() {
    let folder = TestFolder::with_cubes("many-piped");
    folder.write("model.obj", CUBES);
    folder.ligne("draw model.obj file.svg --quiet").expect_success();
    let untitled = |text: &str| text.replace("<title>drawing</title>", "<title>model</title>");
    let run = run_with_input(&folder, CUBES.as_bytes(), "draw - --format obj");
    assert_eq!(untitled(&run.expect_success().out), folder.text("file.svg"));
    run_with_input(&folder, CUBES.as_bytes(), "draw - a.svg -o a.png --format obj").expect_success();
    assert_eq!(untitled(&folder.text("a.svg")), folder.text("file.svg"));
    run_with_input(&folder, CUBES.as_bytes(), "draw - --out-dir d --format obj,svg,png --view top,iso")
        .expect_success();
    assert_eq!(folder.names_in("d"), ["model-iso.png", "model-iso.svg", "model-top.png", "model-top.svg"]);
    let crane = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");
    let bytes = fs::read(crane).unwrap();
    let moved = run_with_input(&folder, &bytes, "draw - --format glb --time 2 --quiet");
    folder.run(&["draw", crane, "crane.svg", "--time", "2", "--quiet"]).expect_success();
    assert_eq!(
        moved.expect_success().out.replace("<title>drawing</title>", "<title>crane</title>"),
        folder.text("crane.svg")
    );

    run_with_input(&folder, b"v 0 0 0\nf 1 2 3\n", "draw - a.svg --format obj")
        .expect_refusal("standard input: line 2: ");
    run_with_input(&folder, b"", "draw - a.svg --format stl")
        .expect_refusal("standard input: the file is empty");
    let refused = |line: &str, why: &str| run_with_input(&folder, b"", line).expect_refusal(why);
    refused("draw - a.svg", "--input-format: the format of standard input is missing");
    refused("draw - a.svg --format obj,stl", "standard input has two formats");
    refused("draw - --format obj,png", "standard output can hold a single SVG");
    refused("draw - --format obj --view top,iso", "standard output can hold a single drawing");
    refused("draw - a.svg --format obj --watch", "standard input cannot be watched");
    refused("draw cubes.obj --format obj", "no model is read from standard input");
    refused("draw cubes.obj a.svg --format png", "the names of the drawings already give their formats");
    refused("draw cubes.obj --format gif", "write svg, png, pdf or dxf");
}

#[test]
fn conflicting_batch_options_are_refused() {
    let folder = TestFolder::with_cubes("many-refused");
    let refused = |line: &str, why: &str| folder.ligne(line).expect_refusal(why);
    refused("draw cubes.obj other.obj", "--out-dir");
    refused("draw cubes.obj --shard 1/2", "--out-dir");
    refused("draw cubes.obj --out-dir d -o a.svg", "cannot be used with");
    refused("draw cubes.obj --out-dir d --shard 3/2", "K/N");
    refused("draw cubes.obj --out-dir d --shard /2", "not a task of a job array");
    refused(
        "draw cubes.obj --out-dir d --report r.json",
        "--report: this option works with a single drawing",
    );
    refused("draw cubes.obj --out-dir d --style nosuch", "error: there is no style `nosuch`");
    refused("draw cubes.obj nowhere/a.svg --view top,iso", "create the folder first");
    refused("animate cubes.obj f.svg --turntable 3 --view top,iso", "one drawing cannot show several views");
    let task = |line: &str| folder.run_with(&[("JOB_COMPLETION_INDEX", "1")], line);
    folder.write("other.obj", CUBES);
    task("draw cubes.obj other.obj --out-dir d").expect_refusal("JOB_COMPLETIONS is missing");
    assert_eq!(folder.names(), ["cubes.obj", "other.obj"]);
    task("draw cubes.obj other.obj --out-dir d --shard /2")
        .expect_success()
        .expect_output("d: shard 2/2, 1 model drawn, ");
    assert_eq!(folder.names_in("d"), ["other.svg"]);
    task("draw cubes.obj --out-dir e").expect_success();
}

/// A child process that is killed when the guard is dropped.
struct ChildGuard(Child);

impl Drop for ChildGuard {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn watch_redraws_when_the_model_or_the_style_changes() {
    let folder = TestFolder::with_cubes("many-watch");
    folder.write("mine.toml", "extends = \"ink\"\n");
    let mut command = folder.command(&["draw", "cubes.obj", "a.svg", "--style", "mine.toml", "--watch"]);
    let mut watching =
        ChildGuard(command.stderr(fs::File::create(folder.path("told")).unwrap()).spawn().unwrap());
    let told = |what: &str| folder.text("told").contains(what);
    wait_until("the first drawing", || told("watching 1 model"));
    let mut last = folder.text("a.svg");
    let mut changes = |what: &str| {
        let took = wait_until(what, || folder.text("a.svg") != last);
        // Takes about 0.2 s on an idle machine. Other tests may run at the same time, so the limit is higher.
        println!("{what}: drawn again within {took:?}");
        last = folder.text("a.svg");
    };
    folder.write("cubes.obj", &cubes_of_width(2.5));
    changes("a wider model");
    folder.write("mine.toml", "extends = \"ink\"\npage.background = \"#ff0000\"\n");
    changes("a style");
    // Editors save by renaming a new file over the old one.
    folder.write("cubes.obj.new", &cubes_of_width(3.5));
    fs::rename(folder.path("cubes.obj.new"), folder.path("cubes.obj")).unwrap();
    changes("another file in its place");
    folder.write("cubes.obj", "v 0 0 0\nf 1 2 3\n");
    wait_until("the error", || told("error: cubes.obj: line 2: "));
    folder.write("cubes.obj", &cubes_of_width(1.5));
    changes("a mended model");
    assert!(watching.0.try_wait().unwrap().is_none());
}
