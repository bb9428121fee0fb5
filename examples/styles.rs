//! Three ways to make a style: changes of a built-in style, options set in code, and a style sheet.
//!
//! ```sh
//! cargo run --example styles [-- FOLDER]
//! ```

use std::path::PathBuf;

use ligne::colour::srgb::Colour;
use ligne::drawing::Length;
use ligne::lines::{HiddenLines, LineKind};
use ligne::{Camera, Scene, Style, SvgOptions, render};

const BLUEPRINT: &str = r##"
# Blueprint: white lines on blue, finer inside.
extends = "ink"

[page]
background = "#1f4e8c"

[pen]
colour = "#ffffff"

[[rule]]
when = { kinds = ["crease"] }
pen = { width = 0.6, opacity = 0.7 }
"##;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let scene = Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/bracket.stl"))?;
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);

    // The same as `--style technical --set lines.crease_deg=20` on the command line.
    let changed = Style::load("technical", &["lines.crease_deg=20".to_owned()])?;

    // Each stage has a struct of options with public fields. A style combines them.
    let mut coded = Style { background: Some(Colour::rgb(0xfb, 0xf5, 0xe6)), ..Style::default() };
    coded.lines.hidden = HiddenLines::Solid;
    coded.lines.kinds = vec![LineKind::Contour, LineKind::Crease];
    coded.chain.smooth = Length::px(1.0);

    // A style sheet is TOML, and can also define pens. Errors show the line.
    let sheet = Style::from_toml(BLUEPRINT)?;
    if let Err(error) = Style::from_toml("[lines]\ncrease_dg = 20\n") {
        println!("{error}");
    }

    for (name, style) in [("changed", changed), ("coded", coded), ("blueprint", sheet)] {
        let picture = folder.join(format!("styles-{name}.svg"));
        std::fs::write(&picture, render(&scene, &camera, &style)?.to_svg(&SvgOptions::default()))?;
        println!("{}", picture.display());
    }
    Ok(())
}
