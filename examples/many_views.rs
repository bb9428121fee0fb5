//! Six views of one mesh: pipeline stages called separately, so that the mesh is built only once.
//!
//! ```sh
//! cargo run --example many_views [-- FOLDER]
//! ```

use std::path::PathBuf;
use std::sync::Arc;

use ligne::drawing::{Drawing, Page, Unit};
use ligne::kurbo::Vec2;
use ligne::lines::{EdgeSearch, SharedSearches, Surface};
use ligne::mesh::Mesh;
use ligne::scene::NamedView;
use ligne::strokes::{self, InkContext};
use ligne::view::View;
use ligne::visibility::GapOcclusion;
use ligne::{Camera, Scene, Style, SvgOptions};
use ligne::{chains, lines, visibility};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let scene = Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/pump.glb"))?;
    let style = Style::load("technical", &["lines.hidden=none".to_owned()])?;

    // Shared by all views.
    let surface = Surface::new(Mesh::build(scene.to_soup()), &style.lines);
    let search = EdgeSearch::new(&surface);
    let known = SharedSearches { search: Some(&search), ..SharedSearches::default() };
    let parts: Vec<Arc<str>> = scene.parts.iter().map(|part| part.name.as_str().into()).collect();
    let materials: Vec<_> = scene.materials.iter().map(|m| (m.name.as_str().into(), m.colour)).collect();
    let hidden = style.lines.hidden;
    let context = InkContext {
        unit: Unit::Px,
        parts: &parts,
        materials: &materials,
        hidden,
        behind_glass: style.glass.width,
        seed: style.seed,
        painted: false,
        depths: [0.0, 1.0],
        names: &[],
        parting: None,
        frame: None,
    };
    let page = Page { width: 600.0, height: 600.0, unit: Unit::Px, background: style.background };

    let six = [
        NamedView::Front,
        NamedView::Back,
        NamedView::Left,
        NamedView::Right,
        NamedView::Top,
        NamedView::Bottom,
    ];
    for named in six {
        let camera = Camera::named(named, scene.up).with_frame(page.width, page.height).fit(&scene);
        let surface = surface.clone().finer_for(&camera);
        let view = View::new(&surface.mesh, &camera);
        let feature_lines = lines::extract_with(&surface, known, &view, &style.lines);
        let map = visibility::build(&surface.mesh, &view, &feature_lines, &style.lines);
        let whole = (&surface.mesh, surface.pieces.as_slice());
        let ahead = GapOcclusion::new(whole, &view, &feature_lines, &map.visible_contours, Vec2::ZERO);
        let chains = chains::link_with_occlusion(&ahead, &map, &style.chain, page.unit, style.lines.hidden);
        let layers = strokes::ink(&chains, &context, &style.stroke);

        let drawing = Drawing::new(format!("pump, {}", named.name()), page, layers);
        let file = folder.join(format!("pump-{}.svg", named.name()));
        std::fs::write(&file, drawing.to_svg(&SvgOptions::default()))?;
        println!("{}: {} chains", file.display(), chains.len());
    }
    Ok(())
}
