//! Strokes of a hatching: their length in each tone, in two densities.
//!
//! ```sh
//! cargo run --release --example hatching
//! ```

use std::collections::BTreeMap;

use kurbo::{PathEl, Shape};
use ligne::drawing::LayerKind;
use ligne::{Camera, Scene, Style, render};

fn main() -> Result<(), ligne::Error> {
    let scene = Scene::open("examples/models/teapot.obj")?;
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);

    // Pen and ink, and the same style with more ink in every tone.
    let pen = Style::load("pen")?;
    let mut darker = pen.clone();
    darker.set("hatching.coverage", "[0.44, 0.35, 0.26, 0]")?;
    for (name, style) in [("pen", pen), ("darker", darker)] {
        let drawing = render(&scene, &camera, &style)?;
        let mut tones: BTreeMap<u16, (usize, f64)> = BTreeMap::new();
        let layers = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Hatching);
        for mark in layers.flat_map(|layer| &layer.marks) {
            let strokes =
                mark.path.elements().iter().filter(|part| matches!(part, PathEl::MoveTo(_))).count();
            let (count, outline) = tones.entry(mark.provenance.tone.unwrap_or_default()).or_default();
            *count += strokes;
            *outline += mark.path.perimeter(0.01);
        }
        println!("{name}:");
        for (tone, (strokes, outline)) in tones {
            println!("  tone {tone}: {strokes} strokes, {outline:.0} px of outline");
        }
    }
    Ok(())
}
