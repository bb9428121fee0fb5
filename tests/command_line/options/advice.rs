//! Errors about style keys and options: suggestions, both spellings of "colour", and no internal type names.

use crate::folder::{RunResult, TestFolder};

/// Draws the cubes with one style key set.
fn draw_with_key(folder: &TestFolder, set: &str) -> RunResult {
    folder.run(&["draw", "cubes.obj", "a.svg", "--set", set])
}

#[test]
fn unknown_keys_get_suggestions_from_all_tables() {
    let folder = TestFolder::with_cubes("keys-suggested");
    for (set, wanted) in [
        ("crease_deg=30", "unknown key `crease_deg`; did you mean `lines.crease_deg`?"),
        ("crease-deg=30", "did you mean `lines.crease_deg`?"),
        ("creese_deg=30", "did you mean `lines.crease_deg`?"),
        ("width=3", "did you mean `pen.width`, `glass.width` or `motion.width`?"),
        ("hidden=dashed", "did you mean `lines.hidden`?"),
        ("silhouette.width=3", "did you mean `pen.silhouette.width`?"),
        ("hand.passes=3", "did you mean `pen.hand.passes`?"),
        ("pen.crease_deg=3", "did you mean `lines.crease_deg`?"),
        ("pen.wdith=3", "did you mean `width`?"),
        ("hatching.layers=3", "did you mean `layer`?"),
        ("lines.crease=3", "unknown key `crease`; did you mean `crease_deg`?"),
        ("lines.hidden=true", "`true` does not fit here; write one of none, dashed, solid"),
        ("lines.hidden=dot", "unknown value `dot`; known values: none, dashed, solid"),
        (
            "lines.kinds=contour",
            "write a list such as --set 'lines.kinds=[\"contour\", \"border\"]'; the words are contour, border, crease, material, \
             intersection, suggestive, ridge, valley, artist, isophote, image, wire, motion",
        ),
        ("lines.crease_deg=true", "`true` does not fit here; write a number from 0 to 180"),
        ("hatching.blacks=-1", "`-1` does not fit here; write a whole number of at least 0"),
        ("fills.steps=0.5", "`0.5` does not fit here; write a whole number from 1 to 1024"),
        ("pen=3", "`3` does not fit here; write a table"),
    ] {
        draw_with_key(&folder, set).expect_refusal(&format!("--set {set}: "));
        draw_with_key(&folder, set).expect_refusal(wanted);
    }
    folder.write("mine.toml", "[pen]\ncrease_deg = 20\n");
    folder
        .ligne("draw cubes.obj a.svg --style mine.toml")
        .expect_refusal("mine.toml: line 2: unknown key `crease_deg`; did you mean `lines.crease_deg`?");
    folder.write("mine.toml", "[lines]\nhidden = true\n");
    folder.ligne("draw cubes.obj a.svg --style mine.toml").expect_refusal(
        "mine.toml: line 2: `true` does not fit here; write one of none, dashed, solid\n 2 | hidden = true",
    );
    assert!(!folder.names().contains(&"a.svg".to_owned()));
}

#[test]
fn unknown_options_suggest_the_style_key() {
    let folder = TestFolder::with_cubes("keys-options");
    for (option, wanted) in [
        ("--hidden", "'--hidden' is a key of the style: --set lines.hidden=…"),
        ("--crease-deg", "--set lines.crease_deg=…"),
        ("--colour", "--set pen.colour=…"),
        ("--color=red", "--set pen.colour=…"),
        ("--pen.width", "--set pen.width=…"),
    ] {
        folder.run(&["draw", "cubes.obj", "a.svg", option]).expect_refusal(wanted);
        folder.run(&["animate", "cubes.obj", "a.svg", option]).expect_refusal(wanted);
    }
    // Commands without styles and unknown words get no such suggestion.
    let plain = |words: &[&str]| assert!(!folder.run(words).err.contains("key of the style"), "{words:?}");
    plain(&["info", "cubes.obj", "--hidden"]);
    plain(&["draw", "cubes.obj", "a.svg", "--veiw"]);
}

#[test]
fn american_spelling_is_accepted_everywhere() {
    let folder = TestFolder::with_cubes("keys-color");
    let svg =
        |words: &str| folder.ligne(&format!("draw cubes.obj - --quiet {words}")).expect_success().out.clone();
    let red = svg("--set pen.colour=#ff0000");
    assert!(red.contains("#ff0000") || red.contains("#f00"));
    assert_eq!(svg("--set pen.color=#ff0000"), red);
    folder.write("mine.toml", "extends = 'ink'\npen.color = '#ff0000'\n");
    assert_eq!(svg("--style mine.toml"), red);
    folder.write("ligne.toml", "[draw]\nset = { pen.color = '#ff0000' }\n");
    assert_eq!(svg(""), red);
    assert_eq!(svg("--no-config --set pen.color=#ff0000"), red);
    folder.write("ligne.toml", "[draw]\ncenter = '0,0,0'\npage = 'A5'\nscale = '10:1'\n");
    let centred = svg("");
    folder.write("ligne.toml", "");
    assert_eq!(svg("--center 0,0,0 --page A5 --scale 10:1"), centred);
    // Test cases and page files.
    folder.write("cases/a.toml", "model = '../cubes.obj'\nset = { pen.color = '#ff0000' }\n");
    folder.ligne("test cases --bless").expect_success();
    assert!(folder.text("cases/a.svg").contains("#ff0000") || folder.text("cases/a.svg").contains("#f00"));
    let page = "[page]\nkind = 'comic'\nsize = [80, 80]\nset = ['pen.color=#ff0000']\nlettering.color = '#00ff00'\n\
                [[page.panel]]\nmodel = { file = 'cubes.obj', color = '#0000ff' }\nsound = [{ text = 'Bang', color = '#123456' }]\n";
    folder.write("american.toml", page);
    folder.write("british.toml", &page.replace("color", "colour"));
    folder.ligne("page american.toml american.svg").expect_success();
    folder.ligne("page british.toml british.svg").expect_success();
    let text = |name: &str| folder.text(name).replace(name.trim_end_matches(".svg"), "");
    assert_eq!(text("american.svg"), text("british.svg"));
    folder.write("both.toml", "pen.color = '#ff0000'\npen.colour = '#00ff00'\n");
    folder
        .ligne("draw cubes.obj a.svg --style both.toml")
        .expect_refusal("`colour` is given twice; leave one out");
}

#[test]
fn errors_contain_no_internal_type_names() {
    let folder = TestFolder::with_cubes("keys-leaks");
    let leaks = [
        "struct ",
        "enum ",
        "usize",
        "u8",
        "u16",
        "u32",
        "u64",
        "i32",
        "i64",
        "f64",
        "sequence",
        "map,",
        "variant",
        "untagged",
        "floating point",
        "expected `",
    ];
    let clean = |run: &RunResult, text: &str| {
        assert_eq!(run.status, Some(2), "{text}: {run:?}");
        let message = run.err.lines().next().unwrap_or_default();
        let leak = leaks.iter().find(|leak| message.contains(*leak));
        assert!(leak.is_none(), "{text}: {}", run.err);
        assert!(message.len() < 400, "{text}: {}", run.err);
    };
    for value in ["3", "true", "'a'", "[1]", "{ a = 1 }", "-1.5"] {
        for key in [
            "lines",
            "lines.kinds",
            "lines.hidden",
            "lines.image.passes",
            "pen.contour",
            "pen.brush",
            "pen.brush.left",
            "seed",
            "hatching.blacks",
            "hatching.layer",
            "fills.material",
            "fills.shadow",
            "fills.texture_colours",
            "light.sources",
            "motion.lines",
            "motion.parts",
            "page.paper",
            "pen.dash",
            "rule",
            "glass.materials",
            "extends",
        ] {
            let text = format!("{key} = {value}\n");
            folder.write("mine.toml", &text);
            let run = folder.ligne("draw cubes.obj a.svg --style mine.toml --size 20");
            if run.status != Some(0) {
                clean(&run, &text);
            }
        }
        for (kind, keys) in [
            (
                "comic",
                "title size landscape bleed reading background layout gutter hand style set ink icc ink_limit spot lettering panel",
            ),
            (
                "sheet",
                "size model unit decimals decimal_comma style set projection scale views hidden title section detail exploded \
                       parts_list balloons dimensions points dimension notes",
            ),
        ] {
            for key in keys.split_whitespace() {
                let text = format!("[page]\nkind = '{kind}'\n{key} = {value}\n");
                folder.write("page.toml", &text);
                let run = folder.ligne("page page.toml page.svg");
                if run.status != Some(0) {
                    clean(&run, &text);
                }
            }
        }
        for key in [
            "style",
            "set",
            "view",
            "azimuth",
            "size",
            "threads",
            "precision",
            "quiet",
            "faces",
            "only",
            "camera",
        ] {
            let text = format!("[draw]\n{key} = {value}\n");
            folder.write("ligne.toml", &text);
            let run = folder.ligne("draw cubes.obj a.svg --size 20");
            if run.status != Some(0) {
                clean(&run, &text);
            }
            folder.write("ligne.toml", "");
        }
    }
    for (text, wanted) in [
        ("{", "c.json: line 1, column 1: the camera record is not JSON: "),
        ("[]", "c.json: the camera record is not a JSON object"),
        ("{\"type\": \"perspective\", \"eye\": 3}", "c.json: key eye: 3 is not a point; write three numbers"),
    ] {
        folder.write("c.json", text);
        let run = folder.ligne("draw cubes.obj a.svg --camera c.json");
        clean(&run, text);
        run.expect_refusal(wanted);
    }
    folder.write("levels.json", "{\"faces\": 3}");
    let levels = "animate cubes.obj a.gif --turntable 2 --size 20 --levels levels.json";
    folder.ligne(levels).expect_refusal("levels.json: this is not a list of face counts");
    folder.write("levels.json", "{\"faces\"");
    let run = folder.ligne(levels);
    clean(&run, "levels");
    run.expect_refusal("levels.json: line 1, column 8: this is not JSON: ");
    folder.write(
        "scene.gltf",
        "{\"asset\": {\"version\": \"2.0\"}, \"cameras\": [{\"type\": \"perspective\", \"perspective\": 3}]}",
    );
    let run = folder.ligne("draw scene.gltf a.svg");
    clean(&run, "gltf");
    run.expect_refusal("scene.gltf: JSON line 1 column ");
    assert_eq!(run.err.matches("line 1").count(), 1, "the position is given once: {run:?}");
    run.expect_refusal("`3` does not fit here; write a table");
}
