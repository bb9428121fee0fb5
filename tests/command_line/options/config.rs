//! `ligne.toml` and environment variables: same bytes as options, precedence, and positions of errors.

use crate::folder::{RunResult, TestFolder};

/// Checks that keys in `ligne.toml` and options on the command line give the same bytes.
fn assert_config_equals_options(name: &str, config: &str, typed: &str) {
    let folder = TestFolder::with_cubes(name);
    folder.ligne(&format!("draw cubes.obj typed.svg {typed}")).expect_success();
    folder.write("ligne.toml", config);
    folder.ligne("draw cubes.obj configured.svg").expect_success();
    assert_eq!(folder.text("typed.svg"), folder.text("configured.svg"), "{config}");
    folder.ligne("draw cubes.obj plain.svg --no-config").expect_success();
    assert_ne!(folder.text("typed.svg"), folder.text("plain.svg"), "{config}: nothing to configure");
}

#[test]
fn config_keys_equal_command_line_options() {
    let pairs = [
        ("style = 'technical'", "--style technical"),
        ("view = 'iso'", "--view iso"),
        ("azimuth = -30\nelevation = 10.5", "--azimuth=-30 --elevation 10.5"),
        ("fov = 60.0", "--fov 60"),
        ("ortho = true", "--ortho"),
        ("up = 'z'", "--up z"),
        ("only = 'kn*'", "--only kn*"),
        ("hide = ['nothing', 'base']", "--hide base"),
        ("size = 300", "--size 300"),
        ("size = '300x200'", "--size 300x200"),
        (
            "page = 'A5'\nlandscape = true\nmargin = '5mm'\nscale = '4:1'",
            "--page A5 --landscape --margin 5mm --scale 4:1",
        ),
        ("background = '#eee'", "--background #eee"),
        ("precision = 0", "--precision 0"),
        ("group = 'part'\nid-prefix = 'a-'", "--group part --id-prefix a-"),
        (
            "set = { pen.width = 3, \"lines.hidden\" = 'dashed' }",
            "--set pen.width=3 --set lines.hidden=dashed",
        ),
        ("set = ['pen.width=3', 'lines.hidden=dashed']", "--set pen.width=3 --set lines.hidden=dashed"),
        (
            "[draw.set]\npen.width = 3\nlines.kinds = [\n 'contour',\n]",
            "--set pen.width=3 --set lines.kinds=['contour']",
        ),
        ("style = 'sketch'\nseed = 7", "--style sketch --seed 7"),
    ];
    for (i, (keys, typed)) in pairs.iter().enumerate() {
        assert_config_equals_options(&format!("config-same-{i}"), &format!("[draw]\n{keys}\n"), typed);
    }
}

/// The SVG text of the cubes, drawn with these variables and options.
fn draw_cubes(folder: &TestFolder, variables: &[(&str, &str)], words: &str) -> String {
    folder.run_with(variables, &format!("draw cubes.obj {words} - --quiet")).expect_success().out.clone()
}

#[test]
fn options_override_variables_and_variables_override_the_file() {
    let folder = TestFolder::with_cubes("config-order");
    let style = |name: &str| draw_cubes(&folder, &[], &format!("--no-config --style {name}"));
    let (ink, technical, plotter, patent) =
        (style("ink"), style("technical"), style("plotter"), style("patent"));
    folder.write("ligne.toml", "[draw]\nstyle = 'technical'\n");
    let variable = [("LIGNE_STYLE", "plotter")];
    assert_eq!(draw_cubes(&folder, &[], ""), technical);
    assert_eq!(draw_cubes(&folder, &variable, ""), plotter);
    assert_eq!(draw_cubes(&folder, &variable, "--style patent"), patent);
    assert_eq!(draw_cubes(&folder, &variable, "--no-config"), plotter);
    assert_eq!(draw_cubes(&folder, &[("LIGNE_STYLE", "")], "--no-config"), ink);
    assert_eq!(draw_cubes(&folder, &[("LIGNE_THREADS", "1")], "--style ink"), ink);
    let wrong = folder.run_with(&[("LIGNE_THREADS", "many")], "draw cubes.obj a.svg");
    wrong.expect_refusal("LIGNE_THREADS: `many` does not fit here");
    folder
        .run_with(&[("LIGNE_STYLE", "inc")], "draw cubes.obj a.svg")
        .expect_refusal("LIGNE_STYLE: there is no style `inc`");
    // A variable that an option overrides is not validated.
    folder.run_with(&[("LIGNE_THREADS", "many")], "draw cubes.obj a.svg --threads 1").expect_success();
}

#[test]
fn options_replace_conflicting_config_keys() {
    let folder = TestFolder::with_cubes("config-displaced");
    let plain = |words: &str| draw_cubes(&folder, &[], &format!("--no-config {words}"));
    let pairs = [
        ("view = 'iso'", "--azimuth 10", "--azimuth 10"),
        ("azimuth = 80", "--view top", "--view top"),
        ("azimuth = 80\nfov = 50", "--elevation 5", "--azimuth 80 --fov 50 --elevation 5"),
        ("camera = 'c.json'", "--azimuth 10", "--azimuth 10"),
        ("page = 'A4'\nlandscape = true\nscale = '10:1'", "--size 300", "--size 300"),
        ("size = 300", "--page A6", "--page A6"),
        ("landscape = true", "--page A6", "--page A6 --landscape"),
        ("landscape = true", "--size 300", "--size 300"),
        ("page = 'A6'", "--landscape", "--page A6 --landscape"),
        ("ortho = true", "--fov 20", "--fov 20"),
        ("only = 'base'", "--only knob", "--only knob"),
        ("set = { pen.width = 3, seed = 4 }", "--set pen.width=1", "--set seed=4 --set pen.width=1"),
    ];
    folder.write("c.json", "{}");
    let wanted = pairs.map(|(_, _, meant)| plain(meant));
    for ((keys, typed, _), wanted) in pairs.iter().zip(wanted) {
        folder.write("ligne.toml", &format!("[draw]\n{keys}\n"));
        assert_eq!(draw_cubes(&folder, &[], typed), wanted, "{keys} with {typed}");
    }
}

#[test]
fn config_is_found_in_parent_folders_and_its_paths_are_relative_to_it() {
    let folder = TestFolder::with_cubes("config-upward");
    folder.write("styles/mine.toml", "extends = 'ink'\npen.width = 4\n");
    folder.write(
        "camera.json",
        r#"{"type":"orthographic","eye":[0,0,9],"target":[0,0,0],"up":[0,1,0],
        "ortho_height":10,"width_px":60,"height_px":40}"#,
    );
    folder.write(
        "brush.svg",
        "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 5C30 -1 60 -1 100 5C60 9 30 9 0 5Z'/></svg>",
    );
    folder.write("deep/er/cubes.obj", crate::folder::CUBES);
    let keys = "style = 'styles/mine.toml'\ncamera = 'camera.json'\nset = { pen.brush.file = 'brush.svg' }";
    folder.write("ligne.toml", &format!("[draw]\n{keys}\n"));
    folder.ligne("draw cubes.obj above.svg").expect_success();
    let below = |words: &[&str]| -> RunResult {
        let output =
            folder.command(words).current_dir(folder.path("deep/er")).output().expect("the program runs");
        RunResult::new(output)
    };
    below(&["draw", "cubes.obj", "below.svg"]).expect_success();
    assert_eq!(folder.text("above.svg"), folder.text("deep/er/below.svg"));
    assert!(folder.text("above.svg").contains("viewBox=\"0 0 60 40\""));
    assert!(folder.text("above.svg").contains("data-axis"), "a brush draws outlines");
    // Only the nearest file applies.
    folder.write("deep/ligne.toml", "");
    below(&["draw", "cubes.obj", "plain.svg"]).expect_success();
    assert!(folder.text("deep/er/plain.svg").contains("viewBox=\"0 0 1000 1000\""));
    folder.write("deep/ligne.toml", "[draw]\nstlye = 'ink'\n");
    below(&["draw", "cubes.obj", "no.svg"])
        .expect_refusal("../ligne.toml: line 2: unknown key `stlye`; did you mean `style`?");
}

#[test]
fn config_errors_show_file_line_and_caret() {
    let folder = TestFolder::with_cubes("config-faults");
    folder.write("sheet.toml", "pen.width = 'wide'\n");
    let faults = [
        ("[drow]\n", "line 1: unknown key `drow`; did you mean `draw`?"),
        ("draw = 3\n", "line 1: a number does not fit here; write a table"),
        (
            "[draw]\nstyle = 'ink'\nazimut = 3\n",
            "line 3: unknown key `azimut`; did you mean `azimuth`?\n 3 | azimut = 3\n   | ^^^^^^",
        ),
        (
            "[draw]\nelevation = 91\n",
            "line 2: `91` does not fit here; write degrees from -90 to 90\n 2 | elevation = 91\n   |             ^^",
        ),
        ("[draw]\nview = 'izo'\n", "line 2: unknown value `izo`; did you mean `iso`?"),
        ("[draw]\nstyle = 'technicl'\n", "line 2: there is no style `technicl`; did you mean `technical`?"),
        ("[draw]\nstyle = 'none.toml'\n", "line 2: none.toml: cannot read the style sheet"),
        ("[draw]\northo = 'yes'\n", "line 2: text does not fit here; write true or false"),
        ("[draw]\nhide = [3]\n", "line 2: a number does not fit here; write text, or a list of texts"),
        ("[draw]\nsize = [3, 4]\n", "line 2: a list does not fit here; write text or a number"),
        ("[draw]\nset = { pen.wdith = 3 }\n", "line 2: unknown key `wdith`; did you mean `width`?"),
        ("[draw]\nset = 'pen.width'\n", "line 2: there is no `=`; write KEY=VALUE"),
        (
            "[draw]\nview = 'iso'\nazimuth = 3\n",
            "line 3: `view` and `azimuth` exclude each other; leave one out",
        ),
        ("[draw]\nthreads = 0\n", "line 2: `0` does not fit here"),
        ("[draw]\nreport = 'a.json'\n", "line 2: unknown key `report`"),
        ("[draw]\nview = \n", "line 2: "),
    ];
    for (text, wanted) in faults {
        folder.write("ligne.toml", text);
        let run = folder.ligne("draw cubes.obj a.svg");
        run.expect_refusal(&format!("ligne.toml: {wanted}"));
    }
    // Errors inside a style sheet name the style sheet.
    folder.write("ligne.toml", "[draw]\nstyle = 'sheet.toml'\n");
    folder.ligne("draw cubes.obj a.svg").expect_refusal("error: sheet.toml: line 1: ");
    folder.ligne("draw cubes.obj a.svg --no-config").expect_success();
    // Help and `ligne info` work with a broken file.
    folder.ligne("draw --help").expect_success();
    folder.ligne("info cubes.obj").expect_success();
}

#[test]
fn diff_reads_tolerance_and_draw_options_from_the_config() {
    let folder = TestFolder::with_cubes("config-diff");
    folder.ligne("draw cubes.obj a.svg --azimuth 30 --size 300").expect_success();
    folder.ligne("draw cubes.obj b.svg --azimuth 30.2 --size 300").expect_success();
    let status = |words: &str| folder.ligne(&format!("diff {words}")).status;
    assert_eq!(status("a.svg b.svg"), Some(1));
    folder.write("ligne.toml", "[diff]\ntolerance = { default = '0.01px', lines = 5 }\n");
    assert_eq!(status("a.svg b.svg"), Some(0));
    assert_eq!(status("a.svg b.svg --no-config"), Some(1));
    assert_eq!(status("a.svg b.svg --tolerance 0.1px"), Some(1));
    // `[draw]` sets how the model is drawn for the comparison. `quiet` does not hide the findings.
    let draw = "[draw]\nquiet = true\nazimuth = 30\nsize = 300\n";
    folder.write("ligne.toml", draw);
    assert_eq!(status("a.svg cubes.obj"), Some(0));
    assert_eq!(status("b.svg cubes.obj"), Some(1));
    assert!(folder.ligne("diff b.svg cubes.obj").out.contains("knob"));
    assert_eq!(status("b.svg cubes.obj --azimuth 30.2"), Some(0));
    folder.write("ligne.toml", &format!("{draw}\n[diff]\ntolerance = 'wide'\n"));
    folder.ligne("diff a.svg b.svg").expect_refusal("ligne.toml: line 7: `wide` is not a tolerance");
}

#[test]
fn the_manual_page_has_all_sections() {
    let folder = TestFolder::new("config-man");
    let page = folder.ligne("man").expect_success().out.replace("\\-", "-");
    for wanted in [
        ".TH LIGNE 1",
        ".SH NAME",
        ".SH ENVIRONMENT",
        "LIGNE_STYLE",
        "LIGNE_THREADS",
        ".SH FILES",
        "ligne.toml",
        ".SH \"EXIT STATUS\"",
        ".SH EXAMPLES",
        "ligne-draw(1)",
        "--no-config",
    ] {
        assert!(page.contains(wanted), "{wanted} in {page}");
    }
    let draw = folder.ligne("man draw").expect_success().out.replace("\\-", "-");
    assert!(
        draw.contains(".TH LIGNE-DRAW 1") && draw.contains("--elevation") && draw.contains("LIGNE_STYLE")
    );
    assert!(!folder.ligne("man info").expect_success().out.contains("LIGNE_STYLE"));
    folder.ligne("man drow").expect_refusal("did you mean `draw`?");
}
