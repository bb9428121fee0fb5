//! Style keys of light and fills: parsed values, keys that replace others, tone pictures, and error messages.

use std::path::PathBuf;

use ligne::colour::colour_factor::ColourFactor;
use ligne::colour::srgb::Colour;
use ligne::drawing::Length;
use ligne::light::lights::light_options::{SourceKind, Space};
use ligne::light::tones::tone_options::{Colours, ToneScale};
use ligne::regions::Seams;
use ligne::style::Style;

/// A temporary folder, removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("ligne-fills-{}-{name}", std::process::id()));
        std::fs::create_dir_all(folder.join("tones")).unwrap();
        Self(folder)
    }

    fn write(&self, file: &str, bytes: &[u8]) -> String {
        let path = self.0.join(file);
        std::fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().to_owned()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn load_with_changes(style: &str, changes: &[&str]) -> Result<Style, ligne::Error> {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Style::load_with(style, &changes)
}

fn png(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(pixels).unwrap();
    bytes
}

fn grey(value: u8) -> Colour {
    Colour::rgb(value, value, value)
}

#[test]
fn light_and_fill_keys_set_their_options() {
    let style = load_with_changes(
        "ink",
        &[
            "fills.enabled=1",
            "fills.thresholds=[0.3, 0.7]",
            "fills.palette=[\"#000\", \"#888\", \"#fff\"]",
            "light.from_model=false",
            "light.sources=[{ kind = \"directional\", direction = [0, 0, 1], space = \"camera\", color = \"#fff\", brightness = 1 }]",
        ],
    )
    .unwrap();
    assert!(style.region.enabled && !Style::default().region.enabled);
    assert_eq!(style.tones.scale, ToneScale::Thresholds(vec![0.3, 0.7]));
    assert_eq!(style.tones.colours, Colours::Palette(vec![grey(0), grey(0x88), grey(255)]));
    assert!(!style.light.from_model);
    assert_eq!(style.light.sources[0].space, Space::Camera);
    assert!(matches!(style.light.sources[0].kind, SourceKind::Directional { .. }));
    let style = load_with_changes(
        "ink",
        &["fills.seams=exact", "fills.crumb=1mm", "fills.shadow=#808080", "fills.cast_shadows=1"],
    )
    .unwrap();
    assert_eq!((style.region.seams, style.region.crumb), (Seams::Exact, Length::mm(1.0)));
    assert_eq!(style.tones.shadow, ColourFactor::from(grey(128)));
    assert!(style.tones.cast_shadows);
}

#[test]
fn built_in_styles_have_their_fill_options() {
    let of = |name: &str| Style::preset(name).unwrap();
    for name in ["toon", "toon-highlight", "noir", "rim", "gradient", "flat", "gooch", "comic-flats"] {
        assert!(of(name).region.enabled, "{name}");
        assert!(of(name).stroke == Style::default().stroke, "{name} inks as `ink`");
    }
    for name in ["ink", "plotter", "suggestive", "technical"] {
        assert!(!of(name).region.enabled, "{name}");
    }
    assert_eq!(of("gradient").tones.scale, ToneScale::Steps(128));
    assert_eq!(of("flat").tones.scale, ToneScale::Thresholds(Vec::new()));
    assert!(matches!(of("gooch").tones.colours, Colours::Gooch(_)));
    assert!(of("comic-flats").tones.cast_shadows && of("toon-highlight").tones.highlight.enabled);
}

#[test]
fn a_new_tone_scale_or_colouring_replaces_the_old_one() {
    let style = load_with_changes("gradient", &["fills.thresholds=[0.4]"]).unwrap();
    assert_eq!(style.tones.scale, ToneScale::Thresholds(vec![0.4]));
    let style = load_with_changes("toon", &["fills.steps=9"]).unwrap();
    assert_eq!(style.tones.scale, ToneScale::Steps(9));
    let style = load_with_changes("gooch", &["fills.palette=[\"#000\", \"#fff\"]"]).unwrap();
    assert_eq!(style.tones.colours, Colours::Palette(vec![grey(0), grey(255)]));
    assert_eq!(style.tones.scale, ToneScale::Steps(24));
    let ramp = "fills.ramp=[\"#000\", \"#fff\"]";
    let style = load_with_changes("gradient", &[ramp, "fills.palette=[\"#888\"]"]).unwrap();
    assert_eq!(style.tones.colours, Colours::Palette(vec![grey(0x88)]));
    let style =
        load_with_changes("gradient", &["fills.gooch.enabled=true", "fills.gooch.warm=#fff"]).unwrap();
    assert!(matches!(style.tones.colours, Colours::Gooch(gooch) if gooch.warm == grey(255)));
    let style =
        load_with_changes("toon", &["fills.palette=[\"#888\"]", "fills.gooch.enabled=false"]).unwrap();
    assert_eq!(style.tones.colours, Colours::Palette(vec![grey(0x88)]));
}

#[test]
fn tone_pictures_are_found_relative_to_the_sheet() {
    let folder = Folder::new("strip");
    folder.write("tones/strip.png", &png(8, 1, &[40, 40, 40, 40, 40, 40, 200, 255]));
    folder.write("tones/table.png", &png(2, 2, &[0, 100, 100, 200]));
    folder.write("tones/strip.toml", b"fills.ramp = \"strip.png\"");
    let sheet = folder.write("a.toml", b"extends = \"tones/strip.toml\"\nfills.enabled = true\n");
    let ToneScale::Ramp(strip) = Style::load(&sheet).unwrap().tones.scale else { panic!() };
    assert_eq!(strip.levels, [0.75, 0.875]);
    assert_eq!(strip.colours, [grey(40), grey(200), grey(255)]);

    let sheet = folder.write("b.toml", b"[[fills.material]]\nname = \"a*\"\ntable = \"tones/table.png\"\n");
    let materials = Style::load(&sheet).unwrap().tones.materials;
    let Some(ToneScale::Table(table)) = &materials[0].scale else { panic!() };
    assert_eq!((table.tone(0, 0), table.tone(1, 0), table.tone(1, 1)), (0, 1, 2));
}

#[test]
fn material_rules_of_extended_sheets_accumulate() {
    let folder = Folder::new("materials");
    folder.write("a.toml", b"[[fills.material]]\nname = \"a\"\nsteps = 3\n");
    let sheet =
        folder.write("b.toml", b"extends = \"a.toml\"\n[[fills.material]]\nname = \"a\"\nshadow = 0.1\n");
    let style = Style::load(&sheet).unwrap();
    let (own, _) = style.tones.for_material("a");
    assert_eq!((own.scale, own.shadow), (ToneScale::Steps(3), ColourFactor([0.1; 3])));
    assert_eq!(style.tones.for_material("b").0.scale, ToneScale::Thresholds(vec![0.5]));
}

#[test]
fn fill_and_light_errors_name_line_and_fix() {
    let folder = Folder::new("errors");
    for (text, wanted) in [
        ("[fills]\nthreshold = [0.5]\n", "line 2: unknown key `threshold`; did you mean `thresholds`?"),
        ("fills.thresholds = [0.7, 0.5]\n", "line 1: thresholds are rising numbers above 0; write"),
        ("fills.steps = 0\n", "line 1: 0 is not a number of tones; write a whole number"),
        ("fills.palette = []\n", "line 1: a palette has a colour for each tone"),
        ("fills.palette = [\"#12\"]\n", "line 1: `#12` is not a colour"),
        ("fills.table = [[\"#000\"], []]\n", "line 1: the table needs rows"),
        ("fills.highlight.exponent = 0\n", "line 1: 0 is not the exponent"),
        ("fills.lit = 9\n", "line 1: 9 is not a colour factor"),
        ("[[fills.material]]\nshadow = 1\n", "`name` is missing; add name = …"),
        ("light.sources = [{ kind = \"point\" }]\n", "line 1: a point light needs a `position`"),
        ("light.oclusion = 1\n", "did you mean `occlusion`?"),
    ] {
        let sheet = folder.write("bad.toml", text.as_bytes());
        let error = Style::load(&sheet).unwrap_err().to_string();
        assert!(error.contains(wanted), "{text}: {error}");
    }
    let sheet = folder.write("lost.toml", b"fills.ramp = \"tones/lost.png\"");
    let error = Style::load(&sheet).unwrap_err().to_string();
    assert!(error.contains("tones/lost.png: cannot read the picture of tones"), "{error}");
    folder.write("tones/lost.png", b"GIF89a");
    let error = Style::load(&sheet).unwrap_err().to_string();
    assert!(error.contains("neither PNG, JPEG nor WebP"), "{error}");
}
