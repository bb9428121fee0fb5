//! Tests of `ligne draw` on one model, through the whole pipeline: drawings, reports and messages.

use crate::folder::TestFolder;
use serde_json::Value;

/// An attribute of the root element, empty if it is missing.
fn root_attribute(svg: &str, attribute: &str) -> String {
    let document = usvg::roxmltree::Document::parse(svg).expect("valid XML");
    document.root_element().attribute(attribute).unwrap_or_default().to_owned()
}

/// A JSON report in the folder.
fn read_report(folder: &TestFolder, name: &str) -> Value {
    serde_json::from_str(&folder.text(name)).expect("a report in JSON")
}

#[test]
fn default_output_is_an_svg_in_the_current_folder() {
    let folder = TestFolder::with_cubes("default");
    let run = folder.ligne("draw cubes.obj");
    assert_eq!(run.expect_success().out, "");
    let line = run.err.trim_end();
    assert!(line.starts_with("cubes.svg: 1000 x 1000 px, ") && line.ends_with(" s, 24 triangles"), "{run:?}");
    assert_eq!(line.lines().count(), 1, "{run:?}");
    assert_eq!(root_attribute(&folder.text("cubes.svg"), "viewBox"), "0 0 1000 1000");
    assert_eq!(folder.names(), ["cubes.obj", "cubes.svg"]);
}

#[test]
fn quiet_prints_nothing() {
    let folder = TestFolder::with_cubes("quiet");
    let run = folder.ligne("draw cubes.obj a.svg --quiet");
    assert_eq!((run.expect_success().out.as_str(), run.err.as_str()), ("", ""));
}

#[test]
fn standard_output_gets_the_same_bytes_as_a_file() {
    let folder = TestFolder::with_cubes("stdout");
    let run = folder.ligne("draw cubes.obj - -o a.svg -o a.png");
    assert_eq!(run.expect_success().out, folder.text("a.svg"));
    assert!(folder.read("a.png").starts_with(b"\x89PNG"));
    assert_eq!(run.err.lines().count(), 3, "{run:?}");
    assert!(run.err.starts_with("standard output: 1000 x 1000 px, "), "{run:?}");
}

#[test]
fn drawings_are_identical_for_any_thread_count() {
    let folder = TestFolder::with_cubes("threads");
    folder.ligne("draw cubes.obj one.svg --threads 1").expect_success();
    folder.ligne("draw cubes.obj two.svg --threads 2").expect_success();
    folder.ligne("draw cubes.obj any.svg").expect_success();
    assert_eq!(folder.text("one.svg"), folder.text("two.svg"));
    assert_eq!(folder.text("one.svg"), folder.text("any.svg"));
}

#[test]
fn page_drawings_are_in_millimetres() {
    let folder = TestFolder::with_cubes("page");
    let run = folder.ligne("draw cubes.obj a.svg --page A4 --landscape");
    assert!(run.expect_success().err.starts_with("a.svg: 297 x 210 mm, "), "{run:?}");
    let svg = folder.text("a.svg");
    assert_eq!(root_attribute(&svg, "viewBox"), "0 0 297 210");
    assert_eq!(
        (root_attribute(&svg, "width"), root_attribute(&svg, "height")),
        ("297mm".to_owned(), "210mm".to_owned())
    );
}

/// Left, top, right and bottom of all lines of a drawing, in user units.
fn line_bounds(svg: &str) -> [f64; 4] {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).expect("a drawing");
    let lines = tree.node_by_id("lines").expect("lines");
    let bounds = lines.abs_bounding_box();
    let scale: f64 =
        root_attribute(svg, "viewBox").split(' ').nth(2).and_then(|w| w.parse().ok()).expect("a width");
    let scale = scale / f64::from(tree.size().width());
    [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()].map(|v| f64::from(v) * scale)
}

#[test]
fn scale_gives_exact_lengths_on_paper() {
    let folder = TestFolder::with_cubes("scale");
    folder.ligne("draw cubes.obj a.svg --page 100x100mm --scale 10:1 --view front").expect_success();
    let [left, top, right, bottom] = line_bounds(&folder.text("a.svg"));
    assert!((right - left - 20.0).abs() < 0.01, "the base is 2 mm wide, on paper 20: {left} {right}");
    assert!((bottom - top - 35.0).abs() < 0.01, "the whole is 3.5 mm high, on paper 35: {top} {bottom}");
    assert!((left + right - 100.0).abs() < 0.02 && (top + bottom - 100.0).abs() < 0.02, "centred");
    let run = folder.ligne("draw cubes.obj b.svg --page 100x100mm --scale 100:1 --view front");
    assert!(
        run.expect_success().err.contains("larger than the page at this scale; 22.86:1 would fit"),
        "{run:?}"
    );
}

#[test]
fn the_model_fills_the_frame_with_a_margin() {
    let folder = TestFolder::with_cubes("frame");
    for options in ["", "--view iso", "--azimuth -100 --elevation 60", "--fov 60", "--ortho", "--up z"] {
        folder
            .ligne(&format!("draw cubes.obj a.svg {options} --set chain.smooth=0 --set chain.fit=false"))
            .expect_success();
        let [left, top, right, bottom] = line_bounds(&folder.text("a.svg"));
        let free = [left, top, 1000.0 - right, 1000.0 - bottom];
        let least = free.into_iter().fold(f64::INFINITY, f64::min);
        assert!((least - 50.0).abs() < 0.1, "{options}: {free:?}");
        assert!((free[0] - free[2]).abs() < 0.1 && (free[1] - free[3]).abs() < 0.1, "{options}: {free:?}");
    }
}

#[test]
fn margins_keep_lines_off_the_page_edge() {
    let folder = TestFolder::with_cubes("margin");
    folder.ligne("draw cubes.obj a.svg --page 100x80mm --margin 2cm --view front").expect_success();
    let [left, top, right, bottom] = line_bounds(&folder.text("a.svg"));
    assert!(left > 20.0 && top > 20.0 && right < 80.0 && bottom < 60.0, "{left} {top} {right} {bottom}");
    assert!(bottom - top > 38.0, "{top} {bottom}");
}

#[test]
fn camera_records_set_size_and_projection() {
    let folder = TestFolder::with_cubes("camera");
    folder.write(
        "camera.json",
        r#"{"type":"orthographic","eye":[0,0,9],"target":[0,0,0],"up":[0,1,0],"ortho_height":10,
            "width_px":600,"height_px":400}"#,
    );
    let run = folder.ligne("draw cubes.obj a.svg --camera camera.json");
    assert!(run.expect_success().err.starts_with("a.svg: 600 x 400 px, "), "{run:?}");
    // 40 px per unit, with the origin in the centre.
    let [left, top, right, bottom] = line_bounds(&folder.text("a.svg"));
    let expected = [260.0, 100.0, 340.0, 240.0];
    let apart = [left, top, right, bottom].into_iter().zip(expected).map(|(a, b)| (a - b).abs());
    assert!(apart.into_iter().all(|d| d < 0.02), "{left} {top} {right} {bottom}");
    folder.write("wrong.json", "{\"type\":\"perspective\"}");
    folder.ligne("draw cubes.obj b.svg --camera wrong.json").expect_refusal("wrong.json: key eye: ");
    folder.ligne("draw cubes.obj b.svg --camera Front").expect_refusal("there is no camera `Front`");
    assert_eq!(folder.names(), ["a.svg", "camera.json", "cubes.obj", "wrong.json"]);
}

#[test]
fn only_and_hide_select_parts_by_name() {
    let folder = TestFolder::with_cubes("parts");
    let only = folder.ligne("draw cubes.obj only.svg --only kn*");
    assert!(only.expect_success().err.ends_with("12 triangles\n"), "{only:?}");
    folder.ligne("draw cubes.obj hidden.svg --hide base").expect_success();
    assert_eq!(folder.text("only.svg"), folder.text("hidden.svg"));
    assert!(
        folder.text("only.svg").contains("data-part=\"knob\"") && !folder.text("only.svg").contains("base")
    );
    folder.ligne("draw cubes.obj none.svg --only nothing").expect_refusal("the parts are base, knob");
}

#[test]
fn group_id_prefix_and_precision_options_apply() {
    let folder = TestFolder::with_cubes("groups");
    folder.ligne("draw cubes.obj a.svg --group part --id-prefix fig1- --precision 0").expect_success();
    let svg = folder.text("a.svg");
    assert!(svg.contains("id=\"fig1-part-base\"") && svg.contains("<title>knob</title>"), "{svg}");
    let document = usvg::roxmltree::Document::parse(&svg).expect("valid XML");
    let paths = document.descendants().filter_map(|node| node.attribute("d"));
    assert!(paths.into_iter().all(|d| !d.contains('.')), "{svg}");
}

#[test]
fn the_report_has_stages_and_counts() {
    let folder = TestFolder::with_cubes("report");
    folder.ligne("draw cubes.obj a.svg -o a.png --report r.json").expect_success();
    let report = read_report(&folder, "r.json");
    assert_eq!(report["counts"]["triangles"], 24);
    assert_eq!(report["counts"]["vertices"], 16);
    assert_eq!(report["counts"]["edges"], 36);
    let bytes = (folder.read("a.svg").len() + folder.read("a.png").len()) as u64;
    assert_eq!(report["counts"]["bytes_out"], bytes);
    assert!(report["counts"]["paths"].as_u64() > Some(0), "{report}");
    let stages = report["stages_ms"].as_object().expect("stages");
    assert_eq!(stages.len(), 10);
    assert!(stages.values().all(|ms| ms.as_f64() >= Some(0.0)), "{report}");
    assert!(report["stages_ms"]["load"].as_f64() > Some(0.0), "{report}");
    assert_eq!(report["warnings"], serde_json::json!([]));
}

#[test]
fn report_dash_prints_to_standard_output() {
    let folder = TestFolder::with_cubes("report-printed");
    let run = folder.ligne("draw cubes.obj a.svg --report -");
    let report: Value = serde_json::from_str(&run.expect_success().out).expect("a report in JSON");
    assert_eq!(report["counts"]["triangles"], 24);
    assert_eq!(folder.names(), ["a.svg", "cubes.obj"]);
    folder.ligne("draw cubes.obj - --report -").expect_refusal("standard output is named twice");
}

#[test]
fn stage_option_draws_intermediate_results() {
    let folder = TestFolder::with_cubes("stage");
    for stage in ["lines", "viewmap", "chains"] {
        folder.run(&["draw", "cubes.obj", &format!("{stage}.svg"), "--stage", stage]).expect_success();
        root_attribute(&folder.text(&format!("{stage}.svg")), "viewBox");
    }
}

#[test]
fn maps_writes_all_images_to_a_folder_or_none() {
    let folder = TestFolder::with_cubes("maps");
    folder
        .ligne("draw cubes.obj a.svg --size 90x60 --maps maps --set lines.image.samples=2")
        .expect_success();
    folder.ligne("draw cubes.obj b.svg --size 90x60 --maps maps").expect_success();
    for name in ["normal", "depth", "edges", "parts"] {
        let bytes = folder.read(&format!("maps/{name}.png"));
        assert!(bytes.starts_with(b"\x89PNG"), "{name}");
        // Width and height in the PNG header.
        assert_eq!(bytes[16..24], [0, 0, 0, 180, 0, 0, 0, 120], "{name}");
    }
    assert_eq!(folder.text("a.svg"), folder.text("b.svg"));
    for (line, word) in [
        ("draw cubes.obj c.svg --maps a.svg", "not a folder"),
        ("draw cubes.obj c.svg --maps none/maps", "there is no folder none"),
        ("draw cubes.obj maps/depth.png --maps maps", "named twice"),
    ] {
        let run = folder.ligne(line);
        run.expect_status(2).expect_output(word);
    }
    assert_eq!(folder.names(), ["a.svg", "b.svg", "cubes.obj", "maps"]);
}

#[test]
fn warnings_are_reported_and_strict_makes_them_errors() {
    let folder = TestFolder::with_cubes("warnings");
    // A repeated face is dropped with a warning.
    folder.write("doubled.obj", &format!("{}f 13 14 15 16\n", crate::folder::CUBES));
    let run = folder.ligne("draw doubled.obj a.svg --report r.json");
    assert!(run.expect_success().err.starts_with("warning: doubled.obj: "), "{run:?}");
    assert!(!read_report(&folder, "r.json")["warnings"].as_array().expect("a list").is_empty());
    folder.write("kept.svg", "mine");
    let strict = folder.ligne("draw doubled.obj kept.svg --strict");
    strict.expect_refusal("error: doubled.obj: ");
    assert_eq!(folder.text("kept.svg"), "mine");
    assert_eq!(folder.ligne("draw doubled.obj b.svg --quiet").expect_success().err, "");
    let info = folder.ligne("info doubled.obj");
    assert!(info.expect_success().out.contains("warning"), "{info:?}");
}

#[test]
fn styles_can_be_listed_selected_and_changed() {
    let folder = TestFolder::with_cubes("styles");
    let list = folder.ligne("styles");
    for name in ["ink", "technical", "plotter"] {
        let line = list.expect_success().out.lines().find(|line| line.starts_with(name)).map(str::len);
        assert!(line > Some(name.len() + 10), "{name} has an idea: {list:?}");
        let sheet = folder.run(&["styles", name]);
        assert!(sheet.expect_success().out.starts_with('#'), "{sheet:?}");
        folder.write("own.toml", &sheet.out);
        folder.run(&["draw", "cubes.obj", "built-in.svg", "--style", name]).expect_success();
        folder.run(&["draw", "cubes.obj", "own.svg", "--style", "own.toml"]).expect_success();
        assert_eq!(folder.text("built-in.svg"), folder.text("own.svg"), "{name}");
    }
    folder.ligne("styles inc").expect_refusal("ink");
    folder.ligne("draw cubes.obj a.svg --style inc").expect_refusal("ink");
    folder.ligne("draw cubes.obj a.svg --set lines.crease=3").expect_refusal("crease_deg");
    folder.ligne("draw cubes.obj few.svg --set lines.kinds=[\"border\"]").expect_success();
    assert!(!folder.text("few.svg").contains("class=\"crease"));
}

#[test]
fn background_option_sets_or_removes_the_paper() {
    let folder = TestFolder::with_cubes("background");
    folder.ligne("draw cubes.obj none.svg --background none").expect_success();
    folder.ligne("draw cubes.obj red.svg --background #ff0000").expect_success();
    assert!(
        !folder.text("none.svg").contains("id=\"paper\"") && folder.text("red.svg").contains("fill=\"#f00\"")
    );
}

#[test]
fn png_pixel_size_follows_size_page_and_dpi() {
    let folder = TestFolder::with_cubes("png");
    let size = |name: &str| {
        let png = folder.read(name);
        let number = |at: usize| png.get(at..at + 4).map(|b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]));
        (number(16), number(20))
    };
    folder.ligne("draw cubes.obj a.png --size 320x200").expect_success();
    assert_eq!(size("a.png"), (Some(320), Some(200)));
    folder.ligne("draw cubes.obj b.png --size 320x200 --dpi 192").expect_success();
    assert_eq!(size("b.png"), (Some(640), Some(400)));
    folder.ligne("draw cubes.obj c.png --page 101.6x50.8mm --dpi 100").expect_success();
    assert_eq!(size("c.png"), (Some(400), Some(200)));
}

#[test]
fn pdf_is_written_by_file_extension() {
    let folder = TestFolder::with_cubes("pdf");
    let run = folder.ligne("draw cubes.obj sheet.PDF --page A5 --style technical");
    assert!(run.expect_success().err.starts_with("sheet.PDF: 148 x 210 mm, "), "{run:?}");
    let pdf = folder.read("sheet.PDF");
    assert!(pdf.starts_with(b"%PDF-1.7") && pdf.trim_ascii_end().ends_with(b"%%EOF"));
}

#[test]
fn info_lists_counts_parts_and_bounds() {
    let folder = TestFolder::with_cubes("info");
    let text = folder.ligne("info cubes.obj").expect_success().out.clone();
    assert!(text.starts_with("cubes.obj: OBJ, "), "{text}");
    assert!(
        text.contains("24 triangles, 16 vertices") && text.contains("    knob: 12 triangles\n"),
        "{text}"
    );
    assert!(text.contains("2 x 3.5 x 2, from (-1, -1, -1) to (1, 2.5, 1)"), "{text}");
    let json = folder.ligne("info cubes.obj --json").expect_success().out.clone();
    let info: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((&info["format"], &info["triangles"]), (&Value::from("OBJ"), &Value::from(24)));
    assert_eq!(info["parts"][1]["name"], "knob");
    assert_eq!(info["bounds"]["max"], serde_json::json!([1.0, 2.5, 1.0]));
}

#[test]
fn drawings_with_hidden_lines_are_identical_for_any_thread_count() {
    let folder = TestFolder::with_cubes("threads");
    for (threads, out) in [("1", "one.svg"), ("2", "two.svg"), ("2", "again.svg")] {
        folder
            .ligne(&format!("draw cubes.obj {out} --threads {threads} --set lines.hidden=\"dashed\""))
            .expect_success();
    }
    let one = folder.read("one.svg");
    assert!(one == folder.read("two.svg") && one == folder.read("again.svg"));
}

#[test]
fn an_unknown_stage_is_refused_with_the_list_of_stages() {
    let folder = TestFolder::with_cubes("stage");
    let run = folder.ligne("draw cubes.obj --stage fields");
    run.expect_refusal("'fields'");
    for stage in ["field", "zeros", "lines", "viewmap", "strengths", "chains", "removed"] {
        assert!(run.err.contains(stage), "{run:?}");
        let file = format!("{stage}.svg");
        folder.run(&["draw", "cubes.obj", &file, "--stage", stage]).expect_success();
        assert!(folder.text(&file).contains("<path"), "{file}");
    }
    assert!(folder.ligne("draw --help").out.contains("docs/dev/stages.md"));
}

#[test]
fn time_and_animation_weights_select_the_pose() {
    let folder = TestFolder::new("moments");
    let crane = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");
    let drawn = |name: &str, more: &[&str]| {
        folder
            .run(&[&["draw", crane, name, "--camera", "camera", "--size", "200"], more].concat())
            .expect_success();
        folder.text(name)
    };
    let stored = drawn("stored.svg", &[]);
    let lifted = drawn("lifted.svg", &["--animation", "lift", "--time", "1.5"]);
    assert_ne!(stored, lifted);
    assert_eq!(lifted, drawn("same.svg", &["--time", "1.5"]));
    assert_eq!(drawn("first.svg", &["--animation", "lift"]), drawn("zero.svg", &["--time", "0"]));
    let beyond =
        folder.run(&["draw", crane, "beyond.svg", "--time", "9", "--camera", "camera", "--size", "200"]);
    assert!(beyond.expect_success().err.contains("the animation `lift` ends before 9 s"), "{beyond:?}");
    assert_eq!(folder.text("beyond.svg"), drawn("end.svg", &["--time", "4"]));
    folder
        .run(&["draw", crane, "no.svg", "--animation", "walk"])
        .expect_refusal("no animation `walk`; its animations are lift");
    folder.run(&["draw", crane, "no.svg", "--time", "soon"]).expect_refusal("a number of seconds");
    // Weight 1 gives the animated pose, weight 0 the stored pose, and 0.5 neither.
    let weighed =
        |weight: &str| drawn("weighed.svg", &["--animation", &format!("lift:{weight}"), "--time", "1.5"]);
    assert_eq!(weighed("1"), lifted);
    assert_eq!(weighed("0"), stored);
    assert_eq!(weighed("0@1..1@2"), weighed("0.5"));
    assert!(![&stored, &lifted].contains(&&weighed("0.5")));
    assert_eq!(weighed("0..1"), weighed("0.375"));
    assert_eq!(lifted, drawn("again.svg", &["--time", "5.5", "--repeat"]));
    folder
        .run(&["draw", crane, "no.svg", "--animation", "lift:much"])
        .expect_refusal("`much` is not a weight");
    folder
        .run(&["draw", crane, "no.svg", "--animation", "lift,walk:2"])
        .expect_refusal("no animation `walk`");
    let pump = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/pump.glb");
    folder.run(&["draw", pump, "no.svg", "--time", "1"]).expect_refusal("the model has no animations");
    assert!(!folder.names().contains(&"no.svg".to_owned()));
    let info = folder.run(&["info", crane]).expect_success().out.clone();
    assert!(info.contains("lift: 4 s, 1 key a second"), "{info}");
}
