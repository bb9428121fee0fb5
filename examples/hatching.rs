//! Strokes of a hatching: how much of each tone they cover, and which ones a darker drawing keeps.
//!
//! ```sh
//! cargo run --release --example hatching
//! ```

use std::collections::BTreeMap;

use ligne::drawing::{Page, Unit};
use ligne::hatching::clip::line_clip::length;
use ligne::pipeline::Prepared;
use ligne::{Camera, Scene, Style};

fn main() -> Result<(), ligne::Error> {
    let scene = Scene::open("examples/models/teapot.obj")?;
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };

    // Pen and ink, and the same style with more ink in every tone.
    let pen = Style::load("pen", &[])?;
    let darker = Style::load("pen", &["hatching.coverage=[0.44, 0.35, 0.26, 0]".to_owned()])?;
    let mut kept: Vec<BTreeMap<u64, f64>> = Vec::new();
    for style in [&pen, &darker] {
        let prepared = Prepared::new(&scene, style);
        let Some((ground, layers)) = prepared.hatch_strokes(&camera, page) else { continue };

        // Each stroke stores the cell where it begins. A cell stores its tone bin.
        let mut area: BTreeMap<u16, f64> = BTreeMap::new();
        for cell in ground.cells.iter().filter(|cell| cell.facet != 0) {
            *area.entry(cell.look.bin).or_default() += cell.area;
        }
        let strokes = || layers.iter().flat_map(|layer| &layer.strokes);
        let total: f64 = strokes().map(|stroke| length(&stroke.points)).sum();
        println!("{} strokes, {total:.0} px long together", strokes().count());
        for (bin, area) in area {
            println!(
                "  bin {bin}: {area:>7.0} px2, {:.0} % to be covered",
                100.0 * style.hatch.coverage[usize::from(bin)]
            );
        }
        kept.push(strokes().map(|stroke| (stroke.id, length(&stroke.points))).collect());
    }
    if let [light, dark] = &kept[..] {
        let same = light.keys().filter(|id| dark.contains_key(id)).count();
        println!("the darker drawing keeps {same} of {} strokes", light.len());
    }
    Ok(())
}
