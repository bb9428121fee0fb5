//! Six views of one model, prepared once, with progress messages.
//!
//! ```sh
//! cargo run --example many_views [-- FOLDER]
//! ```

use std::path::PathBuf;

use ligne::drawing::Page;
use ligne::pipeline::Renderer;
use ligne::scene::NamedView::{Back, Bottom, Front, Left, Right, Top};
use ligne::{Camera, Scene, Style, SvgOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let scene = Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/pump.glb"))?;
    let style = Style::load("technical")?;

    // Welds the mesh and finds creases and smooth areas, for all views. The function could also cancel.
    let renderer = Renderer::new(&scene, &style).with_progress(|step| {
        eprintln!("  {step:?}");
        true
    });
    for view in [Front, Back, Left, Right, Top, Bottom] {
        let camera = Camera::named(view, scene.up).with_frame(600.0, 600.0).fit(&scene);
        let (drawing, report) = renderer.draw(&camera, Page::px(600.0, 600.0))?;
        let file = folder.join(format!("pump-{}.svg", view.name()));
        std::fs::write(&file, drawing.to_svg(&SvgOptions::default()))?;
        println!("{}: {} chains", file.display(), report.counts.chains);
    }
    Ok(())
}
