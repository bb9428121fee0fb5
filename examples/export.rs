//! Export of one drawing: precision, ids, groups for hotspots, and PNG.
//!
//! ```sh
//! cargo run --example export [-- FOLDER]
//! ```

use std::path::PathBuf;

use ligne::export::{Grouping, PngOptions, Resolution};
use ligne::{Camera, Scene, Style, SvgOptions, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let scene = Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/pump.glb"))?;
    let camera = Camera::three_quarter_of(scene.up).with_frame(800.0, 600.0).fit(&scene);
    let drawing = render(&scene, &camera, &Style::default())?;

    // A drawing is a 2-D document. Marks store the kind of line or area they come from.
    for layer in &drawing.layers {
        let from_motor = |name: &str| name.starts_with("motor");
        let parts = layer.marks.iter().filter_map(|mark| mark.provenance.part.as_deref());
        let motor = parts.filter(|name| from_motor(name)).count();
        println!("layer {}: {} marks, {motor} of them of the motor", layer.kind.id(), layer.marks.len());
    }

    let plain = SvgOptions::default();
    let small = SvgOptions::default().with_precision(0);
    // A prefix keeps ids unique if several drawings are inlined in one page. A group per part allows
    // hotspots.
    let spots = SvgOptions::default().with_id_prefix("pump-").grouped_by(Grouping::Part);
    for (name, options) in [("plain", plain), ("small", small), ("spots", spots)] {
        let file = folder.join(format!("export-{name}.svg"));
        let svg = drawing.to_svg(&options);
        println!("{}: {} bytes", file.display(), svg.len());
        std::fs::write(file, svg)?;
    }

    // PNG is rasterised from the same SVG, at any resolution.
    let file = folder.join("export.png");
    let png = drawing.to_png(&PngOptions::of_resolution(Resolution::Width(1600)))?;
    println!("{}: {} bytes", file.display(), png.len());
    std::fs::write(file, png)?;
    Ok(())
}
