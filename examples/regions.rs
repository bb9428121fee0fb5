//! Colour regions of a drawing: part, material and tone of each, and its area.
//!
//! ```sh
//! cargo run --example regions [-- MODEL [PICTURE.svg]]
//! ```

use std::path::PathBuf;

use kurbo::Shape;
use ligne::drawing::{LayerKind, Mark, Paint};
use ligne::{Camera, Scene, Style, SvgOptions, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let own = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/castle.obj");
    let model = std::env::args().nth(1).map_or_else(|| PathBuf::from(own), PathBuf::from);
    let picture = std::env::args().nth(2).map(PathBuf::from);

    let scene = Scene::open(&model)?;
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    // Regions end exactly at their borders, so that their areas add up.
    let mut style = Style::load("toon")?;
    style.set("fills.seams", "exact")?;
    let drawing = render(&scene, &camera, &style)?;

    // Regions are marks in separate layers below the lines. If the style casts shadows, shaded regions are in
    // a second layer.
    let is_region = |kind: LayerKind| matches!(kind, LayerKind::Fills | LayerKind::Shadows);
    let layers = drawing.layers.iter().filter(|layer| is_region(layer.kind));
    let mut regions: Vec<(&Mark, f64)> =
        layers.flat_map(|layer| &layer.marks).map(|mark| (mark, mark.path.area().abs())).collect();
    regions.sort_by(|a, b| b.1.total_cmp(&a.1));

    println!("{:<24} {:<16} {:>4}  {:<9} {:>9}", "part", "material", "tone", "colour", "area px²");
    for (mark, area) in regions.iter().take(20) {
        let Paint::Fill(colour) = mark.paint else { continue };
        let name = |name: &Option<std::sync::Arc<str>>| name.as_deref().unwrap_or("-").to_owned();
        let about = &mark.provenance;
        let tone = about.tone.unwrap_or_default();
        let (part, material) = (name(&about.part), name(&about.material));
        println!("{part:<24} {material:<16} {tone:>4}  {:<9} {area:>9.1}", colour.hex());
    }

    let painted: f64 = regions.iter().map(|(_, area)| area).sum();
    let page = drawing.page.width * drawing.page.height;
    println!("{} regions, the largest above; {:.1} % of the page", regions.len(), painted / page * 100.0);

    if let Some(picture) = picture {
        std::fs::write(&picture, drawing.to_svg(&SvgOptions::default()))?;
        println!("{}", picture.display());
    }
    Ok(())
}
