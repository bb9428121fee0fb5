//! STEP models: converter choice, cache and limits, and the sizes, names and colours of the results.

use std::path::PathBuf;
use std::process::Command;

use super::step_file::{StepBox, converted_glb, step_assembly};
use crate::folder::{RunResult, TestFolder};

/// A box of 40 x 30 x 20 mm, red.
const BLOCK: StepBox = StepBox { name: "block", size: [40.0, 30.0, 20.0], colour: [1.0, 0.0, 0.0] };
/// A box of 10 x 10 x 60 mm, blue.
const POST: StepBox = StepBox { name: "post", size: [10.0, 10.0, 60.0], colour: [0.0, 0.0, 1.0] };

/// A folder with `part.step_assembly`, and a converter `bin/convert` that returns the same 40 x 30 x 20 mm box
/// for every input. The converter appends its name and the tolerance of each call to `converter_calls`.
fn folder_with_step_part(name: &str) -> TestFolder {
    let folder = TestFolder::new(name);
    folder.write("part.step", &step_assembly(&[BLOCK, POST], false));
    // glTF has y up: 40 mm along x, 20 mm up, 30 mm towards the viewer.
    std::fs::write(folder.path("box.glb"), converted_glb("block", [0.04, 0.02, 0.03])).expect("a model");
    write_script(&folder, "bin/convert", "cp \"$home/box.glb\" \"$2\"");
    folder
}

/// Writes an executable shell script. It logs the call to `converter_calls`, then runs `body`.
fn write_script(folder: &TestFolder, name: &str, body: &str) {
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
fn path_text(path: PathBuf) -> String {
    path.to_string_lossy().into_owned()
}

/// Runs `ligne` with further variables. Its cache is in the folder, and `PATH` holds `bin` only.
fn run(folder: &TestFolder, variables: &[(&str, &str)], line: &str) -> RunResult {
    let (cache, path) = (path_text(folder.path("cache")), path_text(folder.path("bin")));
    let all = [&[("LIGNE_CACHE", &*cache), ("PATH", &*path)], variables].concat();
    folder.run_with(&all, line)
}

const CONVERTER_VARIABLE: [(&str, &str); 1] = [("LIGNE_STEP_CONVERTER", "bin/convert")];

/// The logged converter calls, in order.
fn converter_calls(folder: &TestFolder) -> Vec<String> {
    std::fs::read_to_string(folder.path("calls")).unwrap_or_default().lines().map(str::to_owned).collect()
}

/// Width and height of the bounding box around all paths of an SVG drawing.
fn ink_size(svg: &str) -> [f64; 2] {
    use ligne::kurbo::Shape as _;
    let paths = svg.split(" d=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let boxes = paths.filter_map(|data| Some(ligne::kurbo::BezPath::from_svg(data).ok()?.bounding_box()));
    let all = boxes.reduce(|a, b| a.union(b)).expect("ink");
    [all.width(), all.height()]
}

#[cfg(unix)]
#[test]
fn step_models_are_drawn_to_scale_with_product_names() {
    let folder = folder_with_step_part("step-scale");
    for (view, [width, height]) in [("front", [40.0, 20.0]), ("top", [40.0, 30.0]), ("right", [30.0, 20.0])] {
        let line = format!("draw part.step - --quiet --page A4 --scale 1:1 --view {view}");
        let svg = run(&folder, &CONVERTER_VARIABLE, &line).expect_success().out.clone();
        let [wide, high] = ink_size(&svg);
        assert!((wide - width).abs() < 0.05 && (high - height).abs() < 0.05, "{view}: {wide} x {high}");
        assert!(svg.contains("data-part=\"block\"") && !svg.contains("0:1:1:3"), "{svg}");
    }
    let info = run(&folder, &CONVERTER_VARIABLE, "info part.step").expect_success().out.clone();
    assert!(info.contains("STEP, z up") && info.contains("40 x 30 x 20 mm, from (0, -30, 0)"), "{info}");
    run(&folder, &CONVERTER_VARIABLE, "draw part.step --only bolt").expect_refusal("the parts are block");
    let other = folder.path("bin/convert");
    std::fs::rename(folder.path("part.step"), folder.path("Part.STP")).expect("another ending");
    let line = format!("draw Part.STP part.svg --step-converter {}", other.display());
    run(&folder, &[], &line).expect_success().expect_output("part.svg: 1000 x 1000 px");
}

#[cfg(unix)]
#[test]
fn step_conversions_are_cached_by_content_tolerance_and_converter() {
    let folder = folder_with_step_part("step-cache");
    let draw = |line: &str| {
        run(&folder, &CONVERTER_VARIABLE, &format!("draw {line} - --quiet")).expect_success().out.clone()
    };
    let first = draw("part.step");
    assert_eq!(converter_calls(&folder), ["bin/convert 0.1"]);
    // The cache key uses the content, not the file name or time.
    folder.write("copy.stp", &folder.text("part.step"));
    assert_eq!(draw("copy.stp"), first.replace("<title>part<", "<title>copy<"));
    assert_eq!(draw("part.step --step-tolerance 0.1mm"), first);
    assert_eq!(converter_calls(&folder).len(), 1);
    draw("part.step --step-tolerance 0.02mm");
    assert_eq!(converter_calls(&folder)[1..], ["bin/convert 0.02"]);
    folder.write("copy.stp", &folder.text("part.step").replace("post", "pole"));
    draw("copy.stp");
    assert_eq!(converter_calls(&folder).len(), 3);
    write_script(&folder, "bin/other", "cp \"$home/box.glb\" \"$2\"");
    draw("part.step --step-converter other");
    assert_eq!(converter_calls(&folder)[3..], ["bin/other 0.1"]);
    // A changed converter runs again.
    write_script(&folder, "bin/other", "cp \"$home/box.glb\" \"$2\"; exit 0");
    draw("part.step --step-converter other");
    assert_eq!(converter_calls(&folder).len(), 5);
    // Damaged entries are replaced, and the cache folder holds nothing else.
    let entries = folder.names_in("cache/step");
    assert!(entries.len() == 5 && entries.iter().all(|name| name.ends_with(".step-glb")), "{entries:?}");
    for name in &entries {
        let mut bytes = folder.read(&format!("cache/step/{name}"));
        bytes.truncate(bytes.len() / 2);
        std::fs::write(folder.path("cache/step").join(name), bytes).expect("half an entry");
    }
    assert_eq!(draw("part.step"), first);
    assert_eq!(converter_calls(&folder).len(), 6);
    assert_eq!(draw("part.step"), first);
    assert_eq!(converter_calls(&folder).len(), 6);
}

#[cfg(unix)]
#[test]
fn every_command_that_reads_models_reads_step() {
    let folder = folder_with_step_part("step-commands");
    let done = |line: &str| run(&folder, &CONVERTER_VARIABLE, line).expect_success().err.clone();
    done("animate part.step turn.svg --turntable 3 --size 100");
    done("lod part.step");
    done("draw part.step few.svg --faces 10");
    done("draw part.step --out-dir many --view front,top");
    assert_eq!(folder.names_in("many"), ["part-front.svg", "part-top.svg"]);
    folder.write("new.step", &folder.text("part.step").replace("post", "pole"));
    assert_eq!(run(&folder, &CONVERTER_VARIABLE, "diff part.step new.step").status, Some(0));
    let page = "[page]\nkind = 'sheet'\nsize = 'A4'\nmodel = 'part.step'\nscale = '1:1'\nviews = ['front']\n";
    folder.write("page.toml", page);
    done("page page.toml page.svg");
    assert!(folder.text("page.svg").contains("data-part=\"block\""));
    folder.write("cases/sheet.toml", "page-file = '../page.toml'\n");
    folder.write("cases/part.toml", "model = '../part.step'\nstep-tolerance = '0.3mm'\n");
    done("test cases --bless");
    assert!(
        converter_calls(&folder).contains(&"bin/convert 0.3".to_owned()),
        "{:?}",
        converter_calls(&folder)
    );
    done("test cases");
}

#[cfg(unix)]
#[test]
fn step_converter_option_overrides_variable_and_config_file() {
    let folder = folder_with_step_part("step-order");
    for name in ["option", "file"] {
        write_script(&folder, &format!("bin/{name}"), "cp \"$home/box.glb\" \"$2\"");
    }
    folder.write("ligne.toml", "[draw]\nstep-converter = 'bin/file'\nstep-tolerance = '0.5mm'\n");
    run(&folder, &[], "draw part.step").expect_success();
    run(&folder, &[], "info part.step").expect_success();
    assert_eq!(converter_calls(&folder), ["bin/file 0.5"], "info reads the same keys, and the cache");
    run(&folder, &CONVERTER_VARIABLE, "draw part.step").expect_success();
    run(&folder, &CONVERTER_VARIABLE, "draw part.step --step-converter option --step-tolerance 1")
        .expect_success();
    assert_eq!(converter_calls(&folder)[1..], ["bin/convert 0.5", "bin/option 1"]);
    folder.write("ligne.toml", "[draw]\nstep-tolerance = 'fine'\n");
    run(&folder, &CONVERTER_VARIABLE, "draw part.step")
        .expect_refusal("write a length from 0.0001mm to 1000mm");
    run(&folder, &CONVERTER_VARIABLE, "draw part.step --no-config --step-tolerance 0")
        .expect_refusal("write a length");
    run(&folder, &[], "draw part.step --no-config --step-converter gone")
        .expect_refusal("there is no program `gone`");
}

#[cfg(unix)]
#[test]
fn step_converters_are_tried_in_order_and_a_missing_one_is_reported() {
    let folder = folder_with_step_part("step-search");
    let refused = run(&folder, &[], "draw part.step");
    refused.expect_refusal("part.step: STEP is read through a converter, and none was found; install one with `pip install cascadio`");
    assert!(!folder.names().contains(&"part.svg".to_owned()));
    // A Python or Node converter gets script arguments first, then the model and the result.
    write_script(&folder, "bin/python3", "exit 91");
    run(&folder, &[], "draw part.step").expect_refusal("`pip install cascadio`");
    run(&folder, &[], "draw part.step --step-converter cascadio").expect_refusal("cascadio (");
    write_script(&folder, "bin/node", "cp \"$home/box.glb\" \"$5\"");
    run(&folder, &[], "draw part.step").expect_success();
    let asked: Vec<String> = converter_calls(&folder)
        .iter()
        .map(|call| call.split(' ').next().unwrap_or_default().to_owned())
        .collect();
    assert_eq!(asked, ["bin/python3", "bin/python3", "bin/python3", "bin/node"]);
    write_script(&folder, "bin/python3", "cp \"$home/box.glb\" \"$4\"");
    run(&folder, &[], "draw part.step --step-tolerance 1mm").expect_success();
    assert!(
        converter_calls(&folder)[4..].iter().all(|call| call.starts_with("bin/python3")),
        "{:?}",
        converter_calls(&folder)
    );
}

#[cfg(unix)]
#[test]
fn step_converters_have_time_and_memory_limits() {
    let folder = folder_with_step_part("step-bounds");
    write_script(&folder, "bin/slow", "exec sleep 60");
    let bounds = [("LIGNE_STEP_SECONDS", "1"), ("LIGNE_STEP_MB", "512")];
    let started = std::time::Instant::now();
    let slow = run(&folder, &bounds, "draw part.step slow.svg --step-converter slow");
    slow.expect_refusal(
        "was stopped after 1 s; give a larger --step-tolerance, or more time with LIGNE_STEP_SECONDS",
    );
    assert!(started.elapsed().as_secs() < 30);
    assert!(!folder.names().contains(&"slow.svg".to_owned()));
    assert!(folder.names_in("cache/step").is_empty(), "{:?}", folder.names_in("cache/step"));
    if cfg!(target_os = "linux") {
        write_script(&folder, "bin/limit", "ulimit -v > \"$home/limit\"; cp \"$home/box.glb\" \"$2\"");
        run(&folder, &bounds, "draw part.step --step-converter limit").expect_success();
        assert_eq!(folder.text("limit").trim(), (512 * 1024).to_string());
        write_script(&folder, "bin/killed", "kill -9 $$");
        let killed = run(&folder, &bounds, "draw part.step --step-converter killed");
        killed.expect_refusal("it may have needed more than 512 MB; give a larger --step-tolerance");
        write_script(&folder, "bin/full", "echo std::bad_alloc >&2; exit 1");
        let full = run(&folder, &bounds, "draw part.step --step-converter full");
        full.expect_refusal("exit status 1: std::bad_alloc; give a larger --step-tolerance, more memory");
    }
}

#[cfg(unix)]
#[test]
fn step_converter_failures_are_reported() {
    let folder = folder_with_step_part("step-wrong");
    for (name, body, what) in [
        (
            "bin/failing",
            "printf 'reading\\n(50 %%)\\t'; echo no geometry >&2; exit 3",
            "failed with exit status 3: no geometry; export",
        ),
        ("bin/idle", "true", "wrote no GLB; export the STEP file again"),
        ("bin/text", "echo solid > \"$2\"", "wrote a GLB that cannot be read"),
    ] {
        write_script(&folder, name, body);
        run(&folder, &[], &format!("draw part.step --step-converter {name}")).expect_refusal(what);
    }
    assert!(folder.names_in("cache/step").is_empty());
    folder.write("bin/plain", "no program");
    run(&folder, &[], "draw part.step --step-converter bin/plain").expect_refusal("bin/plain");
    folder.write("mesh.step", "solid of another format");
    run(&folder, &CONVERTER_VARIABLE, "draw mesh.step").expect_refusal("mesh.step: this is not a STEP file");
    run(&folder, &CONVERTER_VARIABLE, "draw gone.step").expect_refusal("gone.step: cannot be read");
    assert_eq!(converter_calls(&folder).len(), 3);
}

/// A Python with cascadio: that of the variable `LIGNE_STEP_CONVERTER`, or `python3`.
fn python_with_cascadio() -> Option<String> {
    let python = std::env::var("LIGNE_STEP_CONVERTER").unwrap_or_else(|_| "python3".to_owned());
    let probe = Command::new(&python).args(["-c", "import cascadio"]).output();
    probe.is_ok_and(|output| output.status.success()).then_some(python)
}

#[test]
fn cascadio_keeps_units_names_and_colours() {
    let Some(python) = python_with_cascadio() else {
        eprintln!("skipped: Python has no cascadio (pip install cascadio)");
        return;
    };
    let folder = TestFolder::new("step-cascadio");
    folder.write("mm.step", &step_assembly(&[BLOCK, POST], false));
    folder.write("inch.step", &step_assembly(&[BLOCK, POST], true));
    let cache = path_text(folder.path("cache"));
    let variables = [("LIGNE_CACHE", &*cache), ("LIGNE_STEP_CONVERTER", &*python)];
    let run = |line: &str| folder.run_with(&variables, line).expect_success().out.clone();
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
    let [width, height] = ink_size(&svg);
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
