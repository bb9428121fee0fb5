//! Batches of `ligne draw` give the files of single runs: shards, `--resume`, `--watch`, standard input.

use std::fs;
use std::io::Write;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crate::folder::{CUBES, Folder, Run};

/// Models in a batch. One model in `EACH` is broken: 2 %.
const MODELS: usize = 100;
const EACH: usize = 50;

/// The cubes as OBJ, with the base stretched to this width along x.
fn cubes(width: f64) -> String {
    CUBES.replace("v 1 ", &format!("v {width} "))
}

/// A folder with models in `models/`, 2 % of them broken, and the names of the models.
fn with_models(name: &str) -> (Folder, Vec<String>) {
    let folder = Folder::new(name);
    let names: Vec<String> = (0..MODELS).map(|i| format!("models/m{i:03}.obj")).collect();
    for (i, name) in names.iter().enumerate() {
        let text =
            if i % EACH == 7 { "v 0 0 0\nf 1 2 3\n".to_owned() } else { cubes(1.0 + i as f64 / 100.0) };
        folder.write(name, &text);
    }
    (folder, names)
}

/// Arguments of a call that draws these models at 200 px, followed by `more`.
fn draw<'a>(models: &'a [String], more: &'a str) -> Vec<&'a str> {
    let models = models.iter().map(String::as_str);
    ["draw"].into_iter().chain(models).chain(["--size", "200"]).chain(more.split_whitespace()).collect()
}

/// Waits until the condition holds, at most 60 s, and returns the time it took.
fn until(what: &str, mut is_so: impl FnMut() -> bool) -> Duration {
    let started = Instant::now();
    while !is_so() {
        assert!(started.elapsed() < Duration::from_secs(60), "{what} did not come about");
        std::thread::sleep(Duration::from_millis(2));
    }
    started.elapsed()
}

/// Checks that two folders hold the same files with the same bytes.
fn same_files(folder: &Folder, one: &str, other: &str) {
    assert_eq!(folder.names_in(one), folder.names_in(other));
    for name in folder.names_in(one) {
        let of = |run: &str| folder.read(&format!("{run}/{name}"));
        assert_eq!(of(one), of(other), "{name}");
    }
}

#[test]
fn shards_of_which_one_is_killed_and_resumed_make_what_one_run_makes() {
    let (folder, models) = with_models("many-shards");
    let run = folder.run(&draw(&models, "--out-dir one --threads 2"));
    run.ends(2).says("one: 98 models drawn, 98 files, ").says(", 2 refused");
    for broken in ["error: models/m007.obj: line 2: ", "error: models/m057.obj: line 2: "] {
        run.says(broken);
    }
    assert_eq!(folder.names_in("one").len(), 98);
    assert_eq!(folder.run(&draw(&models, "--out-dir one --quiet")).ends(2).err.lines().count(), 2);

    // Models 7 and 57 are broken, so their shards end with status 2. SLURM variables select shard 4.
    for (shard, status) in [("1/4", 0), ("2/4", 2)] {
        let run = folder.run(&draw(&models, &format!("--out-dir four --threads 1 --shard {shard}")));
        run.ends(status).says(&format!("four: shard {shard}, "));
    }
    let mut command = folder.command(&draw(&models, "--out-dir four --threads 1 --quiet"));
    let task = [("SLURM_ARRAY_TASK_ID", "4"), ("SLURM_ARRAY_TASK_COUNT", "4"), ("SLURM_ARRAY_TASK_MIN", "1")];
    Run::new(command.envs(task).output().unwrap()).ends(2);
    let before = folder.names_in("four").len();
    assert_eq!(before, 73);

    let mut child =
        folder.command(&draw(&models, "--out-dir four --threads 1 --quiet --shard 3/4")).spawn().unwrap();
    until("the third drawing of a shard", || folder.names_in("four").len() >= before + 3);
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
    let run = folder.run(&draw(&models, "--out-dir four --shard 3/4 --resume"));
    run.ends(0).says(" up to date");
    let run = folder.run(&draw(&models, "--out-dir four --resume"));
    run.ends(2).says("four: 1 model drawn, 1 file, ").says(", 2 refused, 97 up to date");
    fs::remove_file(folder.path("four/.other.svg.99999-0.tmp")).unwrap();
    same_files(&folder, "one", "four");
}

#[test]
fn views_and_formats_are_those_of_calls_of_their_own() {
    let folder = Folder::with_cubes("many-views");
    folder.write("gear.obj", &cubes(2.0));
    let run = folder
        .ligne("draw cubes.obj gear.obj --out-dir d --format svg,png --view front,top,front --style toon");
    run.done().says("d: 2 models drawn, 8 files, ");
    assert_eq!(folder.names_in("d").len(), 8);
    for (model, view) in [("cubes", "front"), ("cubes", "top"), ("gear", "top")] {
        // The title is the name of the model, not of the output file.
        for ending in ["svg", "png"] {
            let alone = format!("{model}-{view}.{ending}");
            folder.ligne(&format!("draw {model}.obj {alone} --view {view} --style toon --quiet")).done();
            assert_eq!(folder.read(&alone), folder.read(&format!("d/{alone}")), "{alone}");
        }
    }
    let run = folder.ligne("draw cubes.obj out.svg -o out.pdf --view iso,back");
    run.done().says("out-iso.svg: 1000 x 1000 px, ").says("out-back.pdf: ");
    folder.ligne("draw cubes.obj alone.svg --view back --quiet").done();
    assert_eq!(folder.text("alone.svg"), folder.text("out-back.svg"));
    folder.ligne("draw gear.obj --format png,svg --quiet").done();
    assert!(
        folder.names().contains(&"gear.png".to_owned()) && folder.names().contains(&"gear.svg".to_owned())
    );
}

#[test]
fn no_drawing_of_another_model_is_written_over() {
    let folder = Folder::new("many-names");
    folder.write("a/m.obj", CUBES);
    folder.write("b/m.obj", &cubes(3.0));
    let both = "draw a/m.obj b/m.obj --out-dir d";
    folder
        .ligne(both)
        .refused("d/m.svg: the drawings of a/m.obj and b/m.obj would have the same name; give --folders");
    assert_eq!(folder.names(), ["a", "b"]);
    folder.ligne(&format!("{both} --folders")).done();
    assert_ne!(folder.text("d/a/m.svg"), folder.text("d/b/m.svg"));
    // Two paths of the same model count once.
    folder.ligne("draw a/m.obj ./a/m.obj --out-dir e").done().says("e: 1 model drawn, 1 file, ");
    folder.write("a/m.stl", "solid");
    folder.ligne("draw a/m.obj a/m.stl --out-dir d").refused("rename one");
    folder.ligne("draw a/m.obj ../m.obj --out-dir d --folders").refused("..");
}

#[test]
fn what_is_drawn_again_is_what_changed() {
    let folder = Folder::with_cubes("many-resume");
    folder.write("base.toml", "extends = \"ink\"\n");
    folder.write("mine.toml", "extends = \"base.toml\"\n");
    let record =
        "{\"type\":\"perspective\",\"eye\":[4,3,9],\"target\":[0,0,0],\"up\":[0,1,0],\"fov_y_deg\":35}";
    folder.write("c.json", record);
    let line = "draw cubes.obj --out-dir d --format svg,png --style mine.toml --camera c.json --resume";
    let drawn = |wanted: u32| {
        folder.ligne(line).done().says(&format!("d: {wanted} model"));
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
fn statuses_tell_what_is_worth_another_call() {
    let folder = Folder::with_cubes("many-status");
    folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    folder.ligne("draw cubes.obj broken.obj --out-dir d").ends(2);
    // A folder that cannot be created is a write error: status 75, try again.
    folder.write("d/sub", "in the way");
    folder.write("sub/cubes.obj", CUBES);
    let run = folder.ligne("draw sub/cubes.obj broken.obj cubes.obj --out-dir d --folders");
    run.ends(75).says("d/sub").says("1 model drawn, 1 file, ").says(", 1 refused, 1 to be tried again");
    folder.ligne("draw cubes.obj --out-dir cubes.obj").refused("this is not a folder");
    #[cfg(target_os = "linux")]
    if fs::metadata("/dev/full").is_ok() {
        std::os::unix::fs::symlink("/dev/full", folder.path("full.svg")).unwrap();
        let run = folder.ligne("draw cubes.obj full.svg");
        run.ends(75).says("full.svg: cannot write").says("free some space");
    }
}

/// Runs `ligne` with a model on standard input.
fn piped(folder: &Folder, model: &[u8], line: &str) -> Run {
    let mut command = folder.command(&line.split_whitespace().collect::<Vec<_>>());
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // A refused call closes standard input without reading it, so the write may fail.
    let _ = child.stdin.take().unwrap().write_all(model);
    Run::new(child.wait_with_output().unwrap())
}

#[test]
fn a_model_may_come_on_standard_input() {
    let folder = Folder::with_cubes("many-piped");
    folder.write("model.obj", CUBES);
    folder.ligne("draw model.obj file.svg --quiet").done();
    let untitled = |text: &str| text.replace("<title>drawing</title>", "<title>model</title>");
    let run = piped(&folder, CUBES.as_bytes(), "draw - --format obj");
    assert_eq!(untitled(&run.done().out), folder.text("file.svg"));
    piped(&folder, CUBES.as_bytes(), "draw - a.svg -o a.png --format obj").done();
    assert_eq!(untitled(&folder.text("a.svg")), folder.text("file.svg"));
    piped(&folder, CUBES.as_bytes(), "draw - --out-dir d --format obj,svg,png --view top,iso").done();
    assert_eq!(folder.names_in("d"), ["model-iso.png", "model-iso.svg", "model-top.png", "model-top.svg"]);
    let crane = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");
    let bytes = fs::read(crane).unwrap();
    let moved = piped(&folder, &bytes, "draw - --format glb --time 2 --quiet");
    folder.run(&["draw", crane, "crane.svg", "--time", "2", "--quiet"]).done();
    assert_eq!(
        moved.done().out.replace("<title>drawing</title>", "<title>crane</title>"),
        folder.text("crane.svg")
    );

    piped(&folder, b"v 0 0 0\nf 1 2 3\n", "draw - a.svg --format obj").refused("standard input: line 2: ");
    piped(&folder, b"", "draw - a.svg --format stl").refused("standard input: the file is empty");
    let refused = |line: &str, why: &str| piped(&folder, b"", line).refused(why);
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
fn what_does_not_go_together_is_refused() {
    let folder = Folder::with_cubes("many-refused");
    let refused = |line: &str, why: &str| folder.ligne(line).refused(why);
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
    task("draw cubes.obj other.obj --out-dir d").refused("JOB_COMPLETIONS is missing");
    assert_eq!(folder.names(), ["cubes.obj", "other.obj"]);
    task("draw cubes.obj other.obj --out-dir d --shard /2").done().says("d: shard 2/2, 1 model drawn, ");
    assert_eq!(folder.names_in("d"), ["other.svg"]);
    task("draw cubes.obj --out-dir e").done();
}

/// A child process that is killed when the guard is dropped.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn watched_files_are_drawn_again_when_they_change() {
    let folder = Folder::with_cubes("many-watch");
    folder.write("mine.toml", "extends = \"ink\"\n");
    let mut command = folder.command(&["draw", "cubes.obj", "a.svg", "--style", "mine.toml", "--watch"]);
    let mut watching =
        Watching(command.stderr(fs::File::create(folder.path("told")).unwrap()).spawn().unwrap());
    let told = |what: &str| folder.text("told").contains(what);
    until("the first drawing", || told("watching 1 model"));
    let mut last = folder.text("a.svg");
    let mut changes = |what: &str| {
        let took = until(what, || folder.text("a.svg") != last);
        // Takes about 0.2 s on an idle machine. Other tests may run at the same time, so the limit is higher.
        println!("{what}: drawn again within {took:?}");
        last = folder.text("a.svg");
    };
    folder.write("cubes.obj", &cubes(2.5));
    changes("a wider model");
    folder.write("mine.toml", "extends = \"ink\"\npage.background = \"#ff0000\"\n");
    changes("a style");
    // Editors save by renaming a new file over the old one.
    folder.write("cubes.obj.new", &cubes(3.5));
    fs::rename(folder.path("cubes.obj.new"), folder.path("cubes.obj")).unwrap();
    changes("another file in its place");
    folder.write("cubes.obj", "v 0 0 0\nf 1 2 3\n");
    until("the error", || told("error: cubes.obj: line 2: "));
    folder.write("cubes.obj", &cubes(1.5));
    changes("a mended model");
    assert!(watching.0.try_wait().unwrap().is_none());
}
