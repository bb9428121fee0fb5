//! STEP models: converter choice, cache and limits, and the sizes, names and colours of the results.

use std::path::PathBuf;
use std::process::Command;

use super::step_file::{StepBox, glb, step};
use crate::folder::{Folder, Run};

/// A box of 40 x 30 x 20 mm, red.
const BLOCK: StepBox = StepBox { name: "block", size: [40.0, 30.0, 20.0], colour: [1.0, 0.0, 0.0] };
/// A box of 10 x 10 x 60 mm, blue.
const POST: StepBox = StepBox { name: "post", size: [10.0, 10.0, 60.0], colour: [0.0, 0.0, 1.0] };

/// A folder with `part.step`, and a converter `bin/convert` that returns the same 40 x 30 x 20 mm box
/// for every input. The converter appends its name and the tolerance of each call to `calls`.
fn with_part(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("part.step", &step(&[BLOCK, POST], false));
    // glTF has y up: 40 mm along x, 20 mm up, 30 mm towards the viewer.
    std::fs::write(folder.path("box.glb"), glb("block", [0.04, 0.02, 0.03])).expect("a model");
    script(&folder, "bin/convert", "cp \"$home/box.glb\" \"$2\"");
    folder
}

/// Writes an executable shell script. It logs the call to `calls`, then runs `body`.
fn script(folder: &Folder, name: &str, body: &str) {
    let home = folder.path("");
    folder.write(
        name,
        &format!(
            "#!/bin/sh\nPATH=/usr/bin:/bin\nhome='{}'\necho {name} $3 >> \"$home/calls\"\n{body}\n",
            home.display()
        ),
    );
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let executable = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(folder.path(name), executable).expect("a program");
    }
}

/// The path as text.
fn text(path: PathBuf) -> String {
    path.to_string_lossy().into_owned()
}

/// Runs `ligne` with further variables. Its cache is in the folder, and `PATH` holds `bin` only.
fn run(folder: &Folder, variables: &[(&str, &str)], line: &str) -> Run {
    let (cache, path) = (text(folder.path("cache")), text(folder.path("bin")));
    let all = [&[("LIGNE_CACHE", &*cache), ("PATH", &*path)], variables].concat();
    folder.run_with(&all, line)
}

const CONVERT: [(&str, &str); 1] = [("LIGNE_STEP_CONVERTER", "bin/convert")];

/// The logged converter calls, in order.
fn calls(folder: &Folder) -> Vec<String> {
    std::fs::read_to_string(folder.path("calls")).unwrap_or_default().lines().map(str::to_owned).collect()
}

/// Width and height of the bounding box around all paths of an SVG drawing.
fn extent(svg: &str) -> [f64; 2] {
    use ligne::kurbo::Shape as _;
    let paths = svg.split(" d=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let boxes = paths.filter_map(|data| Some(ligne::kurbo::BezPath::from_svg(data).ok()?.bounding_box()));
    let all = boxes.reduce(|a, b| a.union(b)).expect("ink");
    [all.width(), all.height()]
}

#[cfg(unix)]
#[test]
fn a_step_model_is_drawn_true_to_scale_with_the_names_of_its_products() {
    let folder = with_part("step-scale");
    for (view, [width, height]) in [("front", [40.0, 20.0]), ("top", [40.0, 30.0]), ("right", [30.0, 20.0])] {
        let line = format!("draw part.step - --quiet --page A4 --scale 1:1 --view {view}");
        let svg = run(&folder, &CONVERT, &line).done().out.clone();
        let [wide, high] = extent(&svg);
        assert!((wide - width).abs() < 0.05 && (high - height).abs() < 0.05, "{view}: {wide} x {high}");
        assert!(svg.contains("data-part=\"block\"") && !svg.contains("0:1:1:3"), "{svg}");
    }
    let info = run(&folder, &CONVERT, "info part.step").done().out.clone();
    assert!(info.contains("STEP, z up") && info.contains("40 x 30 x 20 mm, from (0, -30, 0)"), "{info}");
    run(&folder, &CONVERT, "draw part.step --only bolt").refused("the parts are block");
    let other = folder.path("bin/convert");
    std::fs::rename(folder.path("part.step"), folder.path("Part.STP")).expect("another ending");
    let line = format!("draw Part.STP part.svg --step-converter {}", other.display());
    run(&folder, &[], &line).done().says("part.svg: 1000 x 1000 px");
}

#[cfg(unix)]
#[test]
fn results_are_cached_by_content_tolerance_and_converter() {
    let folder = with_part("step-cache");
    let draw = |line: &str| run(&folder, &CONVERT, &format!("draw {line} - --quiet")).done().out.clone();
    let first = draw("part.step");
    assert_eq!(calls(&folder), ["bin/convert 0.1"]);
    // The cache key uses the content, not the file name or time.
    folder.write("copy.stp", &folder.text("part.step"));
    assert_eq!(draw("copy.stp"), first.replace("<title>part<", "<title>copy<"));
    assert_eq!(draw("part.step --step-tolerance 0.1mm"), first);
    assert_eq!(calls(&folder).len(), 1);
    draw("part.step --step-tolerance 0.02mm");
    assert_eq!(calls(&folder)[1..], ["bin/convert 0.02"]);
    folder.write("copy.stp", &folder.text("part.step").replace("post", "pole"));
    draw("copy.stp");
    assert_eq!(calls(&folder).len(), 3);
    script(&folder, "bin/other", "cp \"$home/box.glb\" \"$2\"");
    draw("part.step --step-converter other");
    assert_eq!(calls(&folder)[3..], ["bin/other 0.1"]);
    // A changed converter runs again.
    script(&folder, "bin/other", "cp \"$home/box.glb\" \"$2\"; exit 0");
    draw("part.step --step-converter other");
    assert_eq!(calls(&folder).len(), 5);
    // Damaged entries are replaced, and the cache folder holds nothing else.
    let entries = folder.names_in("cache/step");
    assert!(entries.len() == 5 && entries.iter().all(|name| name.ends_with(".step-glb")), "{entries:?}");
    for name in &entries {
        let mut bytes = folder.read(&format!("cache/step/{name}"));
        bytes.truncate(bytes.len() / 2);
        std::fs::write(folder.path("cache/step").join(name), bytes).expect("half an entry");
    }
    assert_eq!(draw("part.step"), first);
    assert_eq!(calls(&folder).len(), 6);
    assert_eq!(draw("part.step"), first);
    assert_eq!(calls(&folder).len(), 6);
}

#[cfg(unix)]
#[test]
fn every_command_that_takes_a_model_takes_step() {
    let folder = with_part("step-commands");
    let done = |line: &str| run(&folder, &CONVERT, line).done().err.clone();
    done("animate part.step turn.svg --turntable 3 --size 100");
    done("lod part.step");
    done("draw part.step few.svg --faces 10");
    done("draw part.step --out-dir many --view front,top");
    assert_eq!(folder.names_in("many"), ["part-front.svg", "part-top.svg"]);
    folder.write("new.step", &folder.text("part.step").replace("post", "pole"));
    assert_eq!(run(&folder, &CONVERT, "diff part.step new.step").status, Some(0));
    let page = "[page]\nkind = 'sheet'\nsize = 'A4'\nmodel = 'part.step'\nscale = '1:1'\nviews = ['front']\n";
    folder.write("page.toml", page);
    done("page page.toml page.svg");
    assert!(folder.text("page.svg").contains("data-part=\"block\""));
    folder.write("cases/sheet.toml", "page-file = '../page.toml'\n");
    folder.write("cases/part.toml", "model = '../part.step'\nstep-tolerance = '0.3mm'\n");
    done("test cases --bless");
    assert!(calls(&folder).contains(&"bin/convert 0.3".to_owned()), "{:?}", calls(&folder));
    done("test cases");
}

#[cfg(unix)]
#[test]
fn the_option_wins_over_the_variable_and_the_variable_over_the_file() {
    let folder = with_part("step-order");
    for name in ["option", "file"] {
        script(&folder, &format!("bin/{name}"), "cp \"$home/box.glb\" \"$2\"");
    }
    folder.write("ligne.toml", "[draw]\nstep-converter = 'bin/file'\nstep-tolerance = '0.5mm'\n");
    run(&folder, &[], "draw part.step").done();
    run(&folder, &[], "info part.step").done();
    assert_eq!(calls(&folder), ["bin/file 0.5"], "info reads the same keys, and the cache");
    run(&folder, &CONVERT, "draw part.step").done();
    run(&folder, &CONVERT, "draw part.step --step-converter option --step-tolerance 1").done();
    assert_eq!(calls(&folder)[1..], ["bin/convert 0.5", "bin/option 1"]);
    folder.write("ligne.toml", "[draw]\nstep-tolerance = 'fine'\n");
    run(&folder, &CONVERT, "draw part.step").refused("write a length from 0.0001mm to 1000mm");
    run(&folder, &CONVERT, "draw part.step --no-config --step-tolerance 0").refused("write a length");
    run(&folder, &[], "draw part.step --no-config --step-converter gone")
        .refused("there is no program `gone`");
}

#[cfg(unix)]
#[test]
fn converters_are_found_in_order_and_their_lack_names_the_remedy() {
    let folder = with_part("step-search");
    let refused = run(&folder, &[], "draw part.step");
    refused.refused("part.step: STEP is read through a converter, and none was found; install one with `pip install cascadio`");
    assert!(!folder.names().contains(&"part.svg".to_owned()));
    // A Python or Node converter gets script arguments first, then the model and the result.
    script(&folder, "bin/python3", "exit 91");
    run(&folder, &[], "draw part.step").refused("`pip install cascadio`");
    run(&folder, &[], "draw part.step --step-converter cascadio").refused("cascadio (");
    script(&folder, "bin/node", "cp \"$home/box.glb\" \"$5\"");
    run(&folder, &[], "draw part.step").done();
    let asked: Vec<String> =
        calls(&folder).iter().map(|call| call.split(' ').next().unwrap_or_default().to_owned()).collect();
    assert_eq!(asked, ["bin/python3", "bin/python3", "bin/python3", "bin/node"]);
    script(&folder, "bin/python3", "cp \"$home/box.glb\" \"$4\"");
    run(&folder, &[], "draw part.step --step-tolerance 1mm").done();
    assert!(calls(&folder)[4..].iter().all(|call| call.starts_with("bin/python3")), "{:?}", calls(&folder));
}

#[cfg(unix)]
#[test]
fn time_and_memory_are_bounded() {
    let folder = with_part("step-bounds");
    script(&folder, "bin/slow", "exec sleep 60");
    let bounds = [("LIGNE_STEP_SECONDS", "1"), ("LIGNE_STEP_MB", "512")];
    let started = std::time::Instant::now();
    let slow = run(&folder, &bounds, "draw part.step slow.svg --step-converter slow");
    slow.refused(
        "was stopped after 1 s; give a larger --step-tolerance, or more time with LIGNE_STEP_SECONDS",
    );
    assert!(started.elapsed().as_secs() < 30);
    assert!(!folder.names().contains(&"slow.svg".to_owned()));
    assert!(folder.names_in("cache/step").is_empty(), "{:?}", folder.names_in("cache/step"));
    if cfg!(target_os = "linux") {
        script(&folder, "bin/limit", "ulimit -v > \"$home/limit\"; cp \"$home/box.glb\" \"$2\"");
        run(&folder, &bounds, "draw part.step --step-converter limit").done();
        assert_eq!(folder.text("limit").trim(), (512 * 1024).to_string());
        script(&folder, "bin/killed", "kill -9 $$");
        let killed = run(&folder, &bounds, "draw part.step --step-converter killed");
        killed.refused("it may have needed more than 512 MB; give a larger --step-tolerance");
        script(&folder, "bin/full", "echo std::bad_alloc >&2; exit 1");
        let full = run(&folder, &bounds, "draw part.step --step-converter full");
        full.refused("exit status 1: std::bad_alloc; give a larger --step-tolerance, more memory");
    }
}

#[cfg(unix)]
#[test]
fn what_a_converter_does_wrong_is_reported() {
    let folder = with_part("step-wrong");
    for (name, body, what) in [
        (
            "bin/failing",
            "printf 'reading\\n(50 %%)\\t'; echo no geometry >&2; exit 3",
            "failed with exit status 3: no geometry; export",
        ),
        ("bin/idle", "true", "wrote no GLB; export the STEP file again"),
        ("bin/text", "echo solid > \"$2\"", "wrote a GLB that cannot be read"),
    ] {
        script(&folder, name, body);
        run(&folder, &[], &format!("draw part.step --step-converter {name}")).refused(what);
    }
    assert!(folder.names_in("cache/step").is_empty());
    folder.write("bin/plain", "no program");
    run(&folder, &[], "draw part.step --step-converter bin/plain").refused("bin/plain");
    folder.write("mesh.step", "solid of another format");
    run(&folder, &CONVERT, "draw mesh.step").refused("mesh.step: this is not a STEP file");
    run(&folder, &CONVERT, "draw gone.step").refused("gone.step: cannot be read");
    assert_eq!(calls(&folder).len(), 3);
}

/// A Python with cascadio: that of the variable `LIGNE_STEP_CONVERTER`, or `python3`.
fn cascadio() -> Option<String> {
    let python = std::env::var("LIGNE_STEP_CONVERTER").unwrap_or_else(|_| "python3".to_owned());
    let probe = Command::new(&python).args(["-c", "import cascadio"]).output();
    probe.is_ok_and(|output| output.status.success()).then_some(python)
}

#[test]
fn cascadio_keeps_units_names_and_colours() {
    let Some(python) = cascadio() else {
        eprintln!("skipped: Python has no cascadio (pip install cascadio)");
        return;
    };
    let folder = Folder::new("step-cascadio");
    folder.write("mm.step", &step(&[BLOCK, POST], false));
    folder.write("inch.step", &step(&[BLOCK, POST], true));
    let cache = text(folder.path("cache"));
    let variables = [("LIGNE_CACHE", &*cache), ("LIGNE_STEP_CONVERTER", &*python)];
    let run = |line: &str| folder.run_with(&variables, line).done().out.clone();
    let info = run("info mm.step");
    for what in [
        "40 x 30 x 60 mm, from (0, 0, 0) to (40, 30, 60)",
        "    block: 12 triangles",
        "    post: 12 triangles",
    ] {
        assert!(info.contains(what), "no `{what}` in {info}");
    }
    assert!(info.contains(": #ff0000") && info.contains(": #0000ff"), "{info}");
    assert!(run("info inch.step").contains("1016 x 762 x 1524 mm"));
    let svg = run("draw mm.step - --quiet --page A4 --scale 1:1 --view front --style toon --only block");
    let [width, height] = extent(&svg);
    assert!((width - 40.0).abs() < 0.05 && (height - 20.0).abs() < 0.05, "{width} x {height}");
    let toon = run("draw mm.step - --quiet --style toon");
    let fills = |part: &str, other: &str| {
        let mut of_part = toon.lines().filter(|line| {
            line.contains("tone-") && line.contains(&format!("data-part=\"{part}\"")) && !line.contains(other)
        });
        of_part.next().is_some()
    };
    assert!(fills("block", "data-part=\"post\"") && fills("post", "data-part=\"block\""), "{toon}");
}
