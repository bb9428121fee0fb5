//! Style keys on the command line: `ligne styles --keys`, complete sheets, completions and missing units.

use std::fs;
use std::path::Path;

use crate::folder::TestFolder;

#[test]
fn keys_are_listed_with_type_default_and_values() {
    let folder = TestFolder::new("keys-list");
    let list = |glob: &str| folder.run(&["styles", "--keys", glob]).expect_success().out.clone();
    assert_eq!(
        list("lines.crease_deg"),
        "lines.crease_deg  number  40  Edges whose faces turn by more than this are creases (0 to 180 deg)\n"
    );
    assert!(list("hidden").contains("lines.hidden "), "any part of a key");
    assert!(list("lines.hidden").contains("(none, dashed, solid)"));
    let pens = list("pen.*.width");
    let lines: Vec<&str> = pens.lines().collect();
    assert_eq!(lines.len(), 17, "{pens}");
    assert!(lines[0].starts_with("pen.contour.width ") && lines[0].contains(" as pen "), "{pens}");
    // All rows align their columns.
    let column = |line: &&str| line.find("length");
    assert!(lines.iter().all(|line| column(line) == column(&lines[0])), "{pens}");
    let all = folder.ligne("styles --keys").expect_success().out.clone();
    for key in [
        "extends ",
        "light.sources[].kind ",
        "hatching.layer[].lpi ",
        "fills.material[].name ",
        "rule[].when.part ",
    ] {
        assert!(all.lines().any(|line| line.starts_with(key)), "{key}");
    }
    assert_eq!(list("pen.color"), list("pen.colour"));
    folder
        .ligne("styles --keys creese_deg")
        .expect_refusal("no style key matches `creese_deg`; did you mean `lines.crease_deg`?");
    folder.ligne("styles ink --keys").expect_refusal("cannot be used with");
    folder.ligne("styles --json").expect_refusal("--keys");
}

#[test]
fn keys_are_listed_as_json() {
    let folder = TestFolder::new("keys-json");
    let json = folder.ligne("styles --keys --json").expect_success().out.clone();
    let keys: Vec<serde_json::Value> = serde_json::from_str(&json).unwrap();
    assert!(keys.len() > 700, "{}", keys.len());
    let find = |path: &str| keys.iter().find(|key| key["key"] == path).unwrap_or_else(|| panic!("{path}"));
    let fields = ["key", "type", "values", "range", "default", "inherits", "unit", "settable", "help"];
    assert!(keys.iter().all(|key| fields.iter().all(|field| key.get(field).is_some())));
    let hidden = find("lines.hidden");
    assert_eq!((&hidden["default"], &hidden["type"]), (&"none".into(), &"choice".into()));
    assert_eq!(hidden["values"], serde_json::json!(["none", "dashed", "solid"]));
    let width = find("pen.contour.width");
    assert_eq!(
        (&width["inherits"], &width["unit"], &width["default"]),
        (&"pen.width".into(), &"px".into(), &().into())
    );
    assert_eq!(find("lines.crease_deg")["default"], 40);
    assert_eq!(find("fills.shadow")["default"], serde_json::json!([0.7, 0.66, 0.78]));
    assert_eq!(find("rule[].when.part")["settable"], false);
}

#[test]
fn a_complete_style_sheet_draws_the_same() {
    let folder = TestFolder::with_cubes("keys-all");
    for style in ["ink", "pencil", "gooch"] {
        let sheet = folder.run(&["styles", style, "--all"]).expect_success().out.clone();
        folder.write("all.toml", &sheet);
        let draw = |style: &str| {
            folder.run(&["draw", "cubes.obj", "-", "--quiet", "--style", style]).expect_success().out.clone()
        };
        assert_eq!(draw("all.toml"), draw(style), "{style}");
        assert!(sheet.contains("\n[lines.inside]\n") && sheet.contains("crease_deg = 40"), "{sheet}");
    }
    folder.write("mine.toml", "extends = 'ink'\nlines.crease_deg = 12\n");
    folder
        .ligne("styles mine.toml --all")
        .expect_success()
        .expect_output("crease_deg = 12  # Edges whose faces");
    folder.ligne("styles inkk --all").expect_refusal("there is no style `inkk`; did you mean `ink`?");
}

#[test]
fn style_key_reference_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reference/style-keys.md");
    let page =
        TestFolder::new("keys-reference").ligne("styles --keys --reference").expect_success().out.clone();
    let written = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == page,
        "docs/reference/style-keys.md is not current; renew it: ligne styles --keys --reference > docs/reference/style-keys.md"
    );
    let words = page.split_whitespace().count();
    assert!(words < 7000, "{words} words");
    // The page contains every key. One line covers the keys of all single pens.
    for key in
        ["`pen.swell.taper_to`", "`pen.silhouette`", "`light.sources[].falloff`", "`hatching.layer[].lpi`"]
    {
        assert!(page.contains(key), "{key}");
    }
}

#[test]
fn completions_offer_style_keys_for_set() {
    let folder = TestFolder::new("keys-completions");
    for shell in ["bash", "zsh", "fish"] {
        let script = folder.run(&["completions", shell]).expect_success().out.clone();
        for key in ["lines.crease_deg=", "pen.silhouette.hand.passes=", "fills.thresholds="] {
            assert!(script.contains(key), "{shell}: {key}");
        }
        assert!(!script.contains("rule[].pen.width="), "{shell}");
    }
    // In bash, a completed key is not followed by a space.
    let script = folder.ligne("completions bash").out;
    assert!(script.contains("--set)\n                    compopt -o nospace"));
    folder.write("ligne.bash", &script);
    let call = "source ligne.bash; COMP_WORDS=(ligne draw a.obj --set lines.cr); COMP_CWORD=4; \
                _ligne ligne lines.cr --set; echo \"${COMPREPLY[@]}\"";
    let bash = std::process::Command::new("bash").args(["-c", call]).current_dir(folder.path("")).output();
    if let Ok(output) = bash {
        assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "lines.crease_deg=");
    }
    // The help does not list style keys.
    assert!(!folder.ligne("draw --help").expect_success().out.contains("pen.silhouette.hand"));
}

#[test]
fn bare_lengths_on_a_page_in_mm_raise_one_warning() {
    let folder = TestFolder::with_cubes("keys-units");
    let warnings = |words: &str| -> Vec<String> {
        let run = folder.ligne(&format!("draw cubes.obj a.svg {words}"));
        let lines =
            run.expect_success().err.lines().filter(|line| line.contains(" is px")).map(ToOwned::to_owned);
        lines.collect()
    };
    let one = warnings("--page A4 --set pen.width=0.35");
    assert_eq!(one.len(), 1, "{one:?}");
    assert!(
        one[0].ends_with("pen.width: 0.35 is px, which is 0.093 mm here; write 0.35mm, or 0.35px to keep it"),
        "{one:?}"
    );
    let two = warnings("--page A4 --set pen.width=0.35 --set pen.contour.width=1 --set pen.dash=[3,2]");
    assert_eq!(two.len(), 1, "{two:?}");
    assert!(two[0].ends_with("; so are pen.contour.width and 1 more"), "{two:?}");
    // No warning for drawings in px, for values with a unit, for numbers that are not lengths, or for 0.
    for words in [
        "--set pen.width=0.35",
        "--page A4 --set pen.width=0.35mm",
        "--page A4 --set pen.width=0.35px",
        "--page A4 --set pen.opacity=0.35",
        "--page A4 --set pen.halo=0",
        "--page A4 --style pencil",
        "--page A4 --style sketch --set pen.hand.passes=3",
    ] {
        assert_eq!(warnings(words), [""; 0], "{words}");
    }
    // User sheets raise the warning. Numbers equal to those of a built-in style do not.
    folder.write("mine.toml", "extends = 'ink'\n[pen.contour]\nwidth = 0.5\n");
    assert!(warnings("--page A4 --style mine.toml")[0].contains("pen.contour.width: 0.5 is px"));
    for name in ["ink", "pencil", "comic"] {
        for all in ["", "--all"] {
            let copy = folder.ligne(&format!("styles {name} {all}")).expect_success().out.clone();
            folder.write("copy.toml", &copy);
            assert_eq!(warnings("--page A4 --style copy.toml"), [""; 0], "{name} {all}");
        }
    }
    // With `--strict` the warning is an error. It is raised once per call.
    // Settings in `ligne.toml` and in page files raise it, too.
    folder
        .ligne("draw cubes.obj b.svg --page A4 --set pen.width=0.35 --strict")
        .expect_refusal("pen.width: 0.35 is px");
    let many = folder
        .ligne("draw cubes.obj cubes.obj --out-dir out --view front,top --page A4 --set pen.width=0.35");
    let many_warnings = many.err.matches(" is px").count();
    assert!(many_warnings <= 1, "{many:?}");
    folder.write("ligne.toml", "[draw]\nset = { pen.width = 0.35 }\n");
    assert_eq!(warnings("--page A4").len(), 1);
    folder.write("ligne.toml", "");
    let page = "[page]\nkind = 'comic'\nsize = [80, 80]\nlayout = '1 | 1'\nset = ['pen.width=0.35']\n\
                [[page.panel]]\nmodel = 'cubes.obj'\n[[page.panel]]\nmodel = 'cubes.obj'\n";
    folder.write("page.toml", page);
    let run = folder.ligne("page page.toml page.svg");
    assert_eq!(run.expect_success().err.matches("pen.width: 0.35 is px").count(), 1, "{run:?}");
    folder.write("sheet.toml", "[page]\nkind = 'sheet'\nmodel = 'cubes.obj'\nset = ['pen.width=0.35']\n");
    let run = folder.ligne("page sheet.toml sheet.svg");
    assert_eq!(run.expect_success().err.matches("pen.width: 0.35 is px").count(), 1, "{run:?}");
    folder.write("sheet.toml", "[page]\nkind = 'sheet'\nmodel = 'cubes.obj'\n");
    assert!(!folder.ligne("page sheet.toml sheet.svg").expect_success().err.contains(" is px"));
}

#[test]
fn a_batch_raises_the_unit_warning_once() {
    let folder = TestFolder::with_cubes("keys-units-many");
    folder.write("other.obj", crate::folder::CUBES);
    let words = "draw cubes.obj other.obj --out-dir out --page A4 --set pen.width=0.35";
    let run = folder.ligne(words);
    assert_eq!(run.expect_success().err.matches("pen.width: 0.35 is px").count(), 1, "{run:?}");
    folder.ligne(&format!("{words} --strict")).expect_refusal("pen.width: 0.35 is px");
}
