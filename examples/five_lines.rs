//! From model to drawing in five lines.
//!
//! ```sh
//! cargo run --example five_lines [-- MODEL [OUT.svg]]
//! ```

use std::path::PathBuf;

use ligne::{Camera, Scene, Style, SvgOptions, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let castle = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/castle.obj");
    let model = words.next().unwrap_or_else(|| castle.to_owned());
    let out = words.next().map_or_else(|| std::env::temp_dir().join("five_lines.svg"), PathBuf::from);

    let scene = Scene::open(model)?;
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let style = Style::load("ink")?;
    let drawing = render(&scene, &camera, &style)?;
    std::fs::write(&out, drawing.to_svg(&SvgOptions::default()))?;

    println!("{}: {} layers", out.display(), drawing.layers.len());
    Ok(())
}
