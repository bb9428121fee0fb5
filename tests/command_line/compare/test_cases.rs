//! `ligne test`: approved drawings, detected changes, tolerances, and JUnit and HTML reports.

use crate::folder::{RunResult, TestFolder};
use usvg::roxmltree::{Document, Node};

const CASE_TOML: &str = "model = '../cubes.obj'\nazimuth = 30\nsize = 300\n";

/// A folder with two approved cases, `cases/ink` and `cases/deep/toon`.
fn folder_with_approved_cases(name: &str) -> TestFolder {
    let folder = TestFolder::new(name);
    folder.write("cubes.mtl", "newmtl red\nKd 0.8 0.1 0.1\nnewmtl blue\nKd 0.1 0.1 0.8\n");
    folder.write("cubes.obj", &cubes_with_materials("blue"));
    folder.write("cases/ink.toml", CASE_TOML);
    folder.write("cases/deep/toon.toml", "model = '../../cubes.obj'\nstyle = 'toon'\nsize = 200\n");
    folder.ligne("test cases --bless").expect_success();
    folder
}

/// The cubes as OBJ, with a red base and a knob of the given material.
fn cubes_with_materials(knob: &str) -> String {
    let text = crate::folder::CUBES.replacen("o base", "mtllib cubes.mtl\no base\nusemtl red", 1);
    text.replacen("o knob", &format!("o knob\nusemtl {knob}"), 1)
}

/// Checks that some drawings differ without errors, and returns standard output.
fn expect_differences(run: &RunResult) -> &str {
    assert_eq!((run.status, run.err.as_str()), (Some(1), ""), "{run:?}");
    &run.out
}

#[test]
fn blessed_drawings_pass() {
    let folder = TestFolder::with_cubes("test-bless");
    folder.write("cases/ink.toml", CASE_TOML);
    let run = folder.ligne("test cases");
    let out = expect_differences(&run);
    assert!(
        out.starts_with("new      ink: cases/ink.svg is not approved yet\n1 case: 0 passed, 1 is new\n"),
        "{out}"
    );
    assert!(out.contains("--bless"), "{out}");
    assert_eq!(folder.names_in("cases"), ["ink.toml"]);
    let blessed = folder.ligne("test cases --bless");
    assert!(blessed.expect_success().out.starts_with("blessed  ink: "), "{blessed:?}");
    assert_eq!(folder.names_in("cases"), ["ink.svg", "ink.toml"]);
    folder.ligne("draw cubes.obj wanted.svg --azimuth 30 --size 300").expect_success();
    assert_eq!(folder.text("cases/ink.svg"), folder.text("wanted.svg"));
    assert_eq!(folder.ligne("test cases").expect_success().out, "passed   ink\n1 case: 1 passed\n");
    assert_eq!(folder.ligne("test cases --quiet").expect_success().out, "");
    assert_eq!(folder.ligne("test cases/ink.toml").expect_success().out, "passed   ink\n1 case: 1 passed\n");
    // Drawings that pass are not rewritten.
    let touched = folder.text("cases/ink.svg") + "<!-- mine -->";
    folder.write("cases/ink.svg", &touched);
    assert_eq!(folder.ligne("test cases --bless").expect_success().out, "passed   ink\n1 case: 1 passed\n");
    assert_eq!(folder.text("cases/ink.svg"), touched);
}

#[test]
fn bless_is_refused_in_ci() {
    let folder = folder_with_approved_cases("test-ci");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 60\n"));
    let before = folder.text("cases/ink.svg");
    let run = folder.run_with(&[("CI", "true")], "test cases --bless");
    run.expect_refusal("error: --bless: drawings cannot be approved in CI");
    assert_eq!(folder.text("cases/ink.svg"), before);
    expect_differences(&folder.run_with(&[("CI", "true")], "test cases"));
    folder.run_with(&[("CI", "")], "test cases --bless").expect_success();
    assert_ne!(folder.text("cases/ink.svg"), before);
}

#[test]
fn a_camera_turn_of_a_fifth_of_a_degree_is_detected() {
    let folder = folder_with_approved_cases("test-camera");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 30.2\n"));
    let run = folder.ligne("test cases");
    let out = expect_differences(&run);
    assert!(out.contains("passed   deep/toon\ndiffers  ink: "), "{out}");
    assert!(out.contains("base") && out.contains("knob"), "{out}");
    assert!(out.contains("2 cases: 1 passed, 1 differs\n"), "{out}");
    // The tolerance of a case applies to that case.
    folder.write("cases/ink.toml", &(CASE_TOML.replace("= 30\n", "= 30.2\n") + "tolerance = '5px'\n"));
    folder.ligne("test cases").expect_success();
    folder.write(
        "cases/ink.toml",
        &(CASE_TOML.replace("= 30\n", "= 30.2\n") + "tolerance = { default = 5, contour = '0.01px' }\n"),
    );
    expect_differences(&folder.ligne("test cases"));
}

#[test]
fn config_tolerance_applies_unless_the_case_sets_one() {
    let folder = folder_with_approved_cases("test-project");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 30.2\n"));
    // Drawing defaults in `ligne.toml` do not apply to cases.
    folder.write(
        "ligne.toml",
        "[draw]\nstyle = 'technical'\nazimuth = 5\n[diff]\ntolerance = { lines = '5px' }\n",
    );
    folder.ligne("test cases").expect_success();
    expect_differences(&folder.ligne("test cases --no-config"));
    expect_differences(&folder.ligne("--no-config test cases"));
    folder.write(
        "cases/ink.toml",
        &(CASE_TOML.replace("= 30\n", "= 30.2\n") + "tolerance = { lines = '0.1px' }\n"),
    );
    expect_differences(&folder.ligne("test cases"));
    folder.write("ligne.toml", "[diff]\ntolerance = { lines = 'wide' }\n");
    folder.ligne("test cases").expect_refusal("ligne.toml: line 2: `wide` is not a tolerance");
    folder.write("ligne.toml", "[diff]\ntolerence = 1\n");
    folder
        .ligne("test cases")
        .expect_refusal("ligne.toml: line 2: unknown key `tolerence`; did you mean `tolerance`?");
}

#[test]
fn an_added_or_removed_part_is_named() {
    let folder = folder_with_approved_cases("test-part");
    folder.write(
        "cases/ink.toml",
        &(CASE_TOML.to_owned() + "hide = 'knob'\ncamera = '../camera.json'\n").replace("azimuth = 30\n", ""),
    );
    folder.write("camera.json", CAMERA_JSON);
    folder.ligne("test cases --bless").expect_success();
    let whole = folder.text("cases/ink.toml").replace("hide = 'knob'\n", "");
    folder.write("cases/ink.toml", &whole);
    let run = folder.ligne("test cases");
    let out = expect_differences(&run);
    let lines: Vec<&str> = out.lines().filter(|line| line.starts_with("         ")).collect();
    assert!(lines.iter().any(|line| line.contains("knob")), "{out}");
    folder.ligne("test cases --bless").expect_success();
    folder.write("cases/ink.toml", &(whole + "hide = 'knob'\n"));
    let run = folder.ligne("test cases");
    let out = expect_differences(&run);
    assert!(out.lines().any(|line| line.starts_with("         ") && line.contains("knob")), "{out}");
}

/// A camera that frames both cubes, even when one is hidden.
const CAMERA_JSON: &str = r#"{"type":"perspective","eye":[6,5,9],"target":[0,0.75,0],"up":[0,1,0],"fov_y_deg":35,
    "width_px":300,"height_px":300}"#;

#[test]
fn a_changed_colour_is_detected() {
    let folder = folder_with_approved_cases("test-colour");
    folder.write("cubes.mtl", "newmtl red\nKd 0.8 0.1 0.1\nnewmtl blue\nKd 0.1 0.7 0.8\n");
    let run = folder.ligne("test cases");
    let out = expect_differences(&run);
    assert!(out.contains("differs  deep/toon: ") && out.contains("passed   ink\n"), "{out}");
    let lines: Vec<&str> = out.lines().filter(|line| line.starts_with("         ")).collect();
    assert!(!lines.is_empty() && lines.iter().all(|line| line.contains("knob")), "{out}");
}

#[test]
fn broken_cases_fail_and_prevent_blessing() {
    let folder = folder_with_approved_cases("test-broken");
    let before = folder.text("cases/ink.svg");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 60\n"));
    let faults = [
        (
            "model = '../cubes.obj'\nazimut = 3\n",
            "broken.toml: line 2: unknown key `azimut`; did you mean `azimuth`?",
        ),
        ("model = '../cubes.obj'\nview = 'iso'\nazimuth = 3\n", "`view` and `azimuth` exclude each other"),
        ("model = '../none.obj'\n", "none.obj: "),
        ("model = 3\n", "broken.toml: line 1: a number does not fit here; write a path"),
        ("size = 3\n", "broken.toml: there is no `model`"),
        (
            "model = '../cubes.obj'\nscale = '1:2'\n",
            "broken.toml: line 2: `scale` means nothing without `page`",
        ),
        ("model = '../cubes.obj'\ndrawing = 'ink.svg'\n", "the case `ink` uses the same drawing"),
        (
            "model = '../cubes.obj'\ndrawing = 'a.png'\n",
            "broken.toml: line 2: cases/a.png is not an SVG file",
        ),
        ("model = '../cubes.obj'\ntolerance = 'wide'\n", "broken.toml: line 2: `wide` is not a tolerance"),
        ("model = '../cubes.obj'\nstyle = 'none.toml'\n", "line 2: cases/none.toml: cannot read"),
        ("model = '../cubes.obj'\nonly = 'none'\n", "the parts are base, knob"),
        ("model = '../doubled.obj'\nstrict = true\n", "doubled.obj: "),
        ("model = \n", "broken.toml: line 1: "),
    ];
    folder.write("doubled.obj", &format!("{}f 13 14 15 16\n", crate::folder::CUBES));
    for (text, wanted) in faults {
        folder.write("cases/broken.toml", text);
        let run = folder.ligne("test cases --bless");
        assert_eq!(run.status, Some(2), "{run:?}");
        let out = &run.out;
        assert!(out.contains("error    broken: ") && out.contains(wanted), "no `{wanted}` in {out}");
        assert!(out.contains(" cannot be drawn\nNo drawing was approved"), "{out}");
        assert_eq!(folder.text("cases/ink.svg"), before);
    }
    folder.write("cases/broken.toml", "model = '../cubes.obj'\n");
    folder.write("cases/broken.svg", "no drawing");
    let run = folder.ligne("test cases");
    assert!(run.status == Some(2) && run.out.contains("cases/broken.svg: "), "{run:?}");
}

#[test]
fn wrong_test_arguments_are_refused() {
    let folder = folder_with_approved_cases("test-calls");
    folder.write("empty/readme.txt", "nothing");
    folder.ligne("test empty").expect_refusal("error: empty: this folder contains no case");
    folder.ligne("test nowhere").expect_refusal("nowhere: there is no such folder");
    folder.ligne("test cases --only none").expect_refusal("no case has a matching name");
    folder.ligne("test cases --report none/a.html").expect_refusal("create the folder first");
    folder.ligne("test cases --report-all").expect_refusal("--html");
}

#[test]
fn only_selects_cases_and_unrelated_files_are_skipped() {
    let folder = folder_with_approved_cases("test-only");
    folder.write("cases/_sheets/mine.toml", "extends = 'ink'\n");
    folder.write("cases/.hidden.toml", "x");
    folder.write("cases/ligne.toml", "[draw]\nstyle = 'toon'\n");
    folder.write("cases/ink.toml", &(CASE_TOML.to_owned() + "style = '_sheets/mine.toml'\n"));
    let run = folder.ligne("test cases --threads 1");
    assert_eq!(run.expect_success().out, "passed   deep/toon\npassed   ink\n2 cases: 2 passed\n");
    assert_eq!(
        folder.ligne("test cases --only deep/*").expect_success().out,
        "passed   deep/toon\n1 case: 1 passed\n"
    );
    folder.write("cases/deep/old.svg", "<svg/>");
    let run = folder.ligne("test cases");
    assert!(
        run.expect_success().err.starts_with("warning: cases/deep/old.svg: no case uses this drawing"),
        "{run:?}"
    );
    // A case may name its drawing file.
    folder.write(
        "cases/deep/named.toml",
        "model = '../../cubes.obj'\nstyle = 'toon'\nsize = 200\ndrawing = 'old.svg'\n",
    );
    folder.write("cases/deep/old.svg", &folder.text("cases/deep/toon.svg"));
    assert_eq!(folder.ligne("test cases").expect_success().err, "");
}

/// Child elements with this name.
fn child_elements<'a>(node: Node<'a, 'a>, name: &str) -> Vec<Node<'a, 'a>> {
    node.children().filter(|child| child.has_tag_name(name)).collect()
}

#[test]
fn junit_reports_passes_failures_and_errors() {
    let folder = folder_with_approved_cases("test-junit");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 60\n"));
    folder.write("cases/new.toml", CASE_TOML);
    folder.write("cases/broken & <wrong>.toml", "model = '../none.obj'\n");
    let run = folder.ligne("test cases --junit results.xml");
    assert_eq!(run.status, Some(2), "{run:?}");
    let text = folder.text("results.xml");
    let document = Document::parse(&text).expect("XML");
    let suites = document.root_element();
    assert_eq!(suites.tag_name().name(), "testsuites");
    let suite = child_elements(suites, "testsuite")[0];
    let count = |name: &str| suite.attribute(name).unwrap_or_default().to_owned();
    assert_eq!(["tests", "failures", "errors", "skipped"].map(count), ["4", "2", "1", "0"]);
    let cases = child_elements(suite, "testcase");
    let name = |node: &Node| node.attribute("name").unwrap_or_default().to_owned();
    let names: Vec<String> = cases.iter().map(name).collect();
    assert_eq!(names, ["broken & <wrong>", "deep/toon", "ink", "new"]);
    let verdicts: Vec<_> = cases
        .iter()
        .map(|case| {
            let verdict = case.children().find(Node::is_element)?;
            Some((verdict.tag_name().name().to_owned(), verdict.attribute("type")?.to_owned()))
        })
        .collect();
    let verdict = |element: &str, kind: &str| Some((element.to_owned(), kind.to_owned()));
    assert_eq!(
        verdicts,
        [verdict("error", "error"), None, verdict("failure", "differs"), verdict("failure", "new")]
    );
    assert!(
        cases[0]
            .children()
            .find(Node::is_element)
            .and_then(|e| e.attribute("message"))
            .is_some_and(|m| m.contains("none.obj"))
    );
    assert!(cases.iter().all(|case| case.attribute("time").is_some_and(|t| t.parse::<f64>().is_ok())));
}

#[test]
fn html_report_shows_before_after_and_difference() {
    let folder = folder_with_approved_cases("test-page");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 60\n"));
    folder.write("cases/new.toml", CASE_TOML);
    expect_differences(&folder.ligne("test cases --report page.html"));
    let html = folder.text("page.html");
    let document =
        Document::parse(html.strip_prefix("<!DOCTYPE html>\n").expect("a doctype")).expect("well-formed");
    let sections: Vec<Node> = document.descendants().filter(|node| node.has_tag_name("section")).collect();
    let classes: Vec<_> = sections.iter().filter_map(|section| section.attribute("class")).collect();
    assert_eq!(classes, ["passed", "differs", "new"]);
    let captions = |section: &Node| -> Vec<String> {
        section.descendants().filter_map(|node| node.attribute("alt")).map(ToOwned::to_owned).collect()
    };
    assert!(captions(&sections[0]).is_empty());
    assert_eq!(captions(&sections[1]), ["before", "after", "difference"]);
    assert_eq!(captions(&sections[2]), ["after"]);
    for image in document.descendants().filter(|node| node.has_tag_name("img")) {
        let source = image.attribute("src").expect("a source");
        assert!(source.starts_with("data:image/svg+xml;base64,"), "{source}");
    }
    assert!(
        !html.contains("http:") && !html.contains("https:") && !html.contains("<script"),
        "asks for nothing"
    );
    expect_differences(&folder.ligne("test cases --report page.html --report-all"));
    let html = folder.text("page.html");
    let document =
        Document::parse(html.strip_prefix("<!DOCTYPE html>\n").expect("a doctype")).expect("well-formed");
    assert_eq!(document.descendants().filter(|node| node.has_tag_name("img")).count(), 6);
}

#[test]
fn failing_drawings_are_kept_until_they_pass() {
    let folder = folder_with_approved_cases("test-output");
    folder.write("cases/ink.toml", &CASE_TOML.replace("= 30\n", "= 60\n"));
    folder.write("cases/deep/new.toml", "model = '../../cubes.obj'\n");
    expect_differences(&folder.ligne("test cases --output out"));
    assert_eq!(folder.names_in("out"), ["deep", "ink.actual.svg", "ink.diff.svg"]);
    assert_eq!(folder.names_in("out/deep"), ["new.actual.svg"]);
    folder.ligne("draw cubes.obj wanted.svg --azimuth 60 --size 300").expect_success();
    assert_eq!(folder.text("out/ink.actual.svg"), folder.text("wanted.svg"));
    Document::parse(&folder.text("out/ink.diff.svg")).expect("XML");
    folder.ligne("test cases --bless --output out").expect_success();
    assert_eq!(folder.names_in("out"), ["deep"]);
    assert!(folder.names_in("out/deep").is_empty());
}
