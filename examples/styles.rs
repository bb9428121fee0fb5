//! Three ways to make a style: keys set on a built-in style, a style sheet, and a function that picks pens.
//!
//! ```sh
//! cargo run --example styles [-- FOLDER]
//! ```

use std::path::PathBuf;

use ligne::drawing::Length;
use ligne::style::LineKind;
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
    let mut changed = Style::load("technical")?;
    changed.set("lines.crease_deg", 20)?;

    // A style sheet is TOML, and can also define pens. Errors show the line.
    let sheet = Style::from_toml(BLUEPRINT)?;
    if let Err(error) = Style::from_toml("[lines]\ncrease_dg = 20\n") {
        println!("{error}");
    }

    // A program can change the pen of each line: by kind, part, length, curvature, depth or light.
    let coded = Style::load("ink")?.with_pens(|line, pen| {
        let outline = line.kind == LineKind::Contour;
        pen.width = Length::px(if outline { 3.0 } else { 2.0 - 1.5 * line.depth });
    });

    for (name, style) in [("changed", changed), ("coded", coded), ("blueprint", sheet)] {
        let picture = folder.join(format!("styles-{name}.svg"));
        std::fs::write(&picture, render(&scene, &camera, &style)?.to_svg(&SvgOptions::default()))?;
        println!("{}", picture.display());
    }
    Ok(())
}
