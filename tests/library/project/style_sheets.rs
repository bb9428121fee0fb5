//! Style sheets: built-in styles, `extends`, `--style_with_changes`, complete sheets, and error messages.

use std::path::{Path, PathBuf};

use ligne::colour::srgb::Colour;
use ligne::drawing::Length;
use ligne::lines::HiddenLines;
use ligne::strokes::{Ink, LayersBy, MarkOrder};
use ligne::style::{Style, StyleKey};

/// A folder of style sheets, removed when it is dropped.
struct SheetFolder(PathBuf);

impl SheetFolder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder = std::env::temp_dir().join(format!("ligne-style-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for (file, text) in files {
            std::fs::write(folder.join(file), text).unwrap();
        }
        Self(folder)
    }

    fn path(&self, file: &str) -> String {
        self.0.join(file).to_str().unwrap().to_owned()
    }

    /// The error when a sheet is loaded, without the path of the folder.
    fn error(&self, file: &str) -> String {
        let error = Style::load(&self.path(file)).unwrap_err();
        error.to_string().replace(&format!("{}/", self.0.display()), "")
    }
}

impl Drop for SheetFolder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The style `ink` with these `--style_with_changes` changes.
fn style_with_changes(changes: &[&str]) -> Result<Style, ligne::Error> {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Style::load_with("ink", &changes)
}

#[test]
fn every_built_in_style_loads_and_has_a_description() {
    let names: Vec<&str> = Style::names().collect();
    assert_eq!(
        names,
        [
            "blueprint",
            "comic",
            "comic-flats",
            "engraving",
            "flat",
            "gooch",
            "gradient",
            "ink",
            "noir",
            "patent",
            "pen",
            "pencil",
            "pencil-object",
            "pencil-plain",
            "plotter",
            "rim",
            "sketch",
            "stipple",
            "suggestive",
            "technical",
            "toon",
            "toon-highlight",
            "toon-three",
            "woodcut",
        ]
    );
    for name in names {
        Style::load(name).unwrap_or_else(|error| panic!("{error}"));
        assert!(Style::idea(name).unwrap().ends_with('.'), "{name}");
        assert!(Style::sheet_text(name).unwrap().starts_with("# "), "{name}");
    }
    assert_eq!(Style::preset("nothing"), None);
    assert_eq!(Style::default(), Style::preset("ink").unwrap());
    assert_eq!(Style::preset("technical").unwrap().lines.hidden, HiddenLines::Dashed);
    let layers = Style::preset("plotter").unwrap().stroke.layers;
    assert_eq!((layers.by, layers.order), (LayersBy::Pen, MarkOrder::Travel));
}

#[test]
fn keys_that_other_programs_use_can_be_set() {
    let style = style_with_changes(&[
        "lines.kinds=[\"contour\", \"crease\"]",
        "lines.crease_deg=30",
        "lines.hidden=dashed",
        "lines.enabled=0",
        "chain.smooth=0",
        "chain.simplify=0",
        "chain.tidy=0",
        "chain.fit=false",
        "seed=7",
    ])
    .unwrap();
    assert_eq!(style.lines.kinds.len(), 2);
    assert!((style.lines.crease_deg - 30.0).abs() < 1e-12);
    assert_eq!(style.lines.hidden, HiddenLines::Dashed);
    assert!(!style.lines.enabled);
    assert_eq!(style.chain.smooth, Length::px(0.0));
    assert!(!style.chain.fit);
    assert_eq!(style.seed, 7);
    assert!(!style_with_changes(&["chain.fit=0"]).unwrap().chain.fit);
    assert!(style_with_changes(&["chain.fit=0", "chain.fit=1"]).unwrap().chain.fit);
    assert!(style_with_changes(&["chain.fit = true"]).unwrap().chain.fit);
}

#[test]
fn set_accepts_values_without_quotes() {
    let style = style_with_changes(&["pen.width=0.35mm", "pen.colour=#f00", "page.background=none"]).unwrap();
    assert_eq!(style.stroke.pen.width, Length::mm(0.35));
    assert_eq!(style.stroke.pen.colour, Ink::Fixed(Colour::rgb(255, 0, 0)));
    assert_eq!(style.background, None);
    let style = style_with_changes(&["pen.colour={ shade = 0.4 }"]).unwrap();
    assert_eq!(style.stroke.pen.colour, Ink::Shade(0.4));
}

#[test]
fn setting_one_key_keeps_the_others() {
    let style = style_with_changes(&["pen.silhouette.width=5"]).unwrap();
    let before = Style::default();
    assert_eq!(style.lines, before.lines);
    assert_eq!(style.stroke.rules.len(), before.stroke.rules.len());
    let widest = style.stroke.rules.iter().filter_map(|rule| rule.pen.width).map(|w| w.value);
    assert!((widest.fold(0.0, f64::max) - 5.0).abs() < 1e-12);
}

#[test]
fn sheets_extend_sheets_and_their_rules_accumulate() {
    let sheets = SheetFolder::new(
        "extend",
        &[
            (
                "a.toml",
                "extends = \"ink\"\n[lines]\ncrease_deg = 20\n[[rule]]\nwhen = { part = \"b*\" }\npen = { width = 3 }\n",
            ),
            (
                "b.toml",
                "extends = \"a.toml\"\n[lines]\nhidden = \"solid\"\n[[rule]]\npen = { opacity = 0.5 }\n",
            ),
        ],
    );
    let style = Style::load(&sheets.path("b.toml")).unwrap();
    assert!((style.lines.crease_deg - 20.0).abs() < 1e-12);
    assert_eq!(style.lines.hidden, HiddenLines::Solid);
    assert_eq!(style.stroke.rules.len(), Style::default().stroke.rules.len() + 2);
    assert_eq!(style.stroke.rules.last().unwrap().pen.opacity, Some(0.5));
}

#[test]
fn a_sheet_that_extends_itself_is_refused() {
    let sheets = SheetFolder::new(
        "cycle",
        &[("a.toml", "seed = 1\nextends = \"b.toml\"\n"), ("b.toml", "extends = \"a.toml\"\n")],
    );
    let error = sheets.error("a.toml");
    assert!(error.starts_with("b.toml: line 1: `extends = \"a.toml\"` leads back"), "{error}");
    let lost = SheetFolder::new("lost", &[("a.toml", "\nextends = \"inck\"\n")]);
    let error = lost.error("a.toml");
    assert_eq!(error, "a.toml: line 2: there is no style `inck`; did you mean `ink`?");
}

#[test]
fn errors_show_line_caret_and_the_nearest_key() {
    for (text, wanted) in [
        (
            "# mine\n[lines]\ncrease_dg = 20\n",
            "bad.toml: line 3: unknown key `crease_dg`; did you mean `crease_deg`?\n 3 | crease_dg = 20\n   | ^^^^^^^^^",
        ),
        (
            "[pen.contour]\ncolur = \"#fff\"\n",
            "bad.toml: line 2: unknown key `colur`; did you mean `colour`?\n 2 | colur = \"#fff\"\n   | ^^^^^",
        ),
        (
            "lines.hidden = \"dased\"\n",
            "bad.toml: line 1: unknown value `dased`; did you mean `dashed`?\n 1 | lines.hidden = \"dased\"\n   |                ^^^^^^^",
        ),
        (
            "[pen]\nwidth = -1\n",
            "bad.toml: line 2: `-1` is not a length; it must be finite and at least 0\n 2 | width = -1\n   |         ^^",
        ),
        (
            "[pen.hidden]\ndash = [1, \"2 ells\"]\n",
            "bad.toml: line 2: `2 ells` is not a length; write a number of px or a string with a unit, such as \"0.35mm\"\n 2 | dash = [1, \"2 ells\"]\n   |            ^^^^^^^^",
        ),
        (
            "lines.crease_deg = 200\n",
            "bad.toml: line 1: 200 is not the angle of a crease; write degrees from 0 to 180\n 1 | lines.crease_deg = 200\n   |                    ^^^",
        ),
        (
            "[pen]\ncolour = { shde = 0.5 }\n",
            "bad.toml: line 2: unknown key `shde`; did you mean `shade`?\n 2 | colour = { shde = 0.5 }\n   |            ^^^^",
        ),
        (
            "[[rule]]\nwhen = { kinds = [\"creese\"] }\n",
            "bad.toml: line 2: unknown value `creese`; did you mean `crease`?\n 2 | when = { kinds = [\"creese\"] }\n   |                   ^^^^^^^^",
        ),
        (
            "chain.fit = \"yes\"\n",
            "bad.toml: line 1: `\"yes\"` does not fit here; write true or false\n 1 | chain.fit = \"yes\"\n   |             ^^^^^",
        ),
    ] {
        let sheets = SheetFolder::new("errors", &[("bad.toml", text)]);
        assert_eq!(sheets.error("bad.toml"), wanted);
    }
    let sheets = SheetFolder::new("errors", &[("bad.toml", "[lines\n")]);
    let error = sheets.error("bad.toml");
    assert!(error.starts_with("bad.toml: line 1: ") && error.contains("\n 1 | [lines\n"), "{error}");
}

#[test]
fn values_out_of_range_are_refused() {
    for change in [
        "pen.width=nan",
        "pen.width=inf",
        "pen.width=-0.1mm",
        "pen.opacity=1.5",
        "lines.crease_deg=-1",
        "lines.crease_deg=nan",
        "pen.colour={ shade = 2 }",
        "pen.dash=[0, 0]",
        "pen.swell.taper_to=1.5",
        "pen.swell.lit=-1",
        "pen.hand.passes=0",
        "pen.hand.passes=9",
        "pen.hand.tremor=-1",
        "pen.brush={}",
        "pen.brush=broom",
        "pen.brush={ path = \"M0 0L1 1\", image = \"a.png\" }",
        "pen.brush={ path = \"M0 0L9 0\" }",
        "pen.brush={ path = \"hello\" }",
        "chain.smooth=-1",
        "seed=-1",
        "chain.fit=2",
        "lines.kinds=contour",
        "page.grain=2",
        "hatching.coverage=[0.2, 0.5]",
        "hatching.coverage=[1.2, 0]",
        "hatching.thresholds=[0.5, 0.4]",
        "hatching.layer=[{ spacing = 0 }]",
        "hatching.layer=[{ lpi = 0.5 }]",
        "hatching.layer=[{ uneven = 2 }]",
        "hatching.layer=[{ direction = 'north' }]",
        "hatching.layer=[{ hatch = 1 }]",
    ] {
        assert!(style_with_changes(&[change]).is_err(), "{change}");
    }
}

#[test]
fn errors_in_set_quote_the_change() {
    let error = style_with_changes(&["chain.fti=0"]).unwrap_err().to_string();
    assert_eq!(
        error,
        "--set chain.fti=0: unknown key `fti`; did you mean `fit`?\n   --set chain.fti=0\n               ^^^"
    );
    let error = style_with_changes(&["lines.hidden=dot"]).unwrap_err().to_string();
    assert!(error.contains("unknown value `dot`; known values: none, dashed, solid"), "{error}");
    for change in ["", "pen.width", "=1", "a b=1", "pen..width=1", "pen.width=1\nseed=2", "extends=ink"] {
        let error = style_with_changes(&[change]).unwrap_err().to_string();
        assert!(error.starts_with("--set "), "{change}: {error}");
    }
    let error = style_with_changes(&["watercolour.enabled=false"]).unwrap_err().to_string();
    assert!(
        error.contains("unknown key `watercolour`; known keys: extends, seed, page, lines, chain"),
        "{error}"
    );
}

#[test]
fn hatching_layer_defaults_equal_those_of_the_key_table() {
    let mut sheet = String::from("[[hatching.layer]]\n");
    let keys: Vec<&StyleKey> =
        StyleKey::all().iter().filter(|key| key.prefix == "hatching.layer[]").collect();
    for key in &keys {
        if let Some(default) = key.default {
            sheet += &format!("{} = {default}\n", key.name);
        }
    }
    assert!(keys.len() > 20, "{}", keys.len());
    let style = Style::from_toml(&sheet).unwrap_or_else(|error| panic!("{sheet}\n{error}"));
    assert_eq!(style.hatch.layers, [ligne::hatching::HatchLayer::default()]);
}

#[test]
fn a_missing_sheet_is_reported_by_name() {
    let error = Style::load("nowhere/my.toml").unwrap_err().to_string();
    assert!(error.starts_with("nowhere/my.toml: cannot read the style sheet"), "{error}");
    let error = Style::load("watercolour").unwrap_err().to_string();
    assert!(error.contains("built-in styles: blueprint, comic, comic-flats"), "{error}");
}

#[test]
fn documented_style_sheets_load() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for page in ["how-to/styles.md", "explanation/fills.md", "explanation/hatching.md"] {
        // Blocks that write a file have its name after `toml`. The test of documented commands runs those.
        let text = std::fs::read_to_string(docs.join(page)).unwrap_or_default();
        let sheets = text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next());
        for text in sheets {
            Style::from_toml(text).unwrap_or_else(|error| panic!("{page}: {error}"));
        }
    }
}

#[test]
fn an_empty_sheet_has_the_built_in_defaults() {
    let sheets = SheetFolder::new("defaults", &[("empty.toml", "")]);
    let style = Style::load(&sheets.path("empty.toml")).unwrap();
    assert_eq!(style.stroke.pen, ligne::strokes::Pen::default());
    assert_eq!(style.lines, ligne::lines::LineOptions::default());
    assert_eq!(style.background, Some(Colour::WHITE));
    let all = Style::full_sheet(&sheets.path("empty.toml")).unwrap();
    assert!(all.lines().filter(|line| line.contains(" = ") && !line.starts_with('#')).count() > 100, "{all}");
    assert_eq!(Style::from_toml(&all).unwrap(), style);
}

#[test]
fn a_full_sheet_keeps_lists_of_tables_and_their_unset_keys() {
    let own = "extends = \"comic\"\n[pen.contour]\nbrush = { path = \"M0 0L10 1L0 2Z\", mode = \"repeat\" }\n[pen.crease]\n\
               colour = { shade = 0.4 }\nswell.taper = 3\n[[rule]]\nwhen = { part = \"b*\", hidden = true }\npen = { width = 2 }\n\
               [[fills.material]]\nname = \"glass*\"\nsteps = 3\nhighlight = { exponent = 60 }\n[[fills.material]]\nname = \"x\"\n\
               highlight = false\ngooch = { enabled = true, cool = \"#00f\" }\n[[fills.pattern]]\ntones = [0]\nkind = \"lines\"\n\
               [[hatching.material]]\nname = \"y\"\ncoverage = [0.5, 0]\n[[light.sources]]\nkind = \"point\"\nposition = [1, 2, 3]\n\
               [[motion.line]]\n[[motion.line]]\nwidth = 3\n[fills.highlight]\nnear = 2\n[glass]\nmaterials = [\"a\"]\n";
    let sheets = SheetFolder::new("full", &[("own.toml", own)]);
    let all = Style::full_sheet(&sheets.path("own.toml")).unwrap();
    let style = Style::load(&sheets.path("own.toml")).unwrap();
    assert_eq!(Style::from_toml(&all).unwrap_or_else(|error| panic!("{error}\n{all}")), style, "{all}");
}
