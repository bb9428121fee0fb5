//! Time of a new view of a prepared model: camera moved, drawing as SVG bytes in memory.
//!
//! ```sh
//! cargo bench --bench redraw [-- WORD…]
//! ```
//!
//! Medians over 60 views around the model, on all threads, after a few warm-up views. Words select the rows
//! whose names contain one of them. Missing shared models are skipped.

#[path = "../tests/library/support/readers/shared_folder.rs"]
#[expect(dead_code, reason = "tests ask it more")]
mod models;
#[path = "../tests/library/support/scenes/solids.rs"]
#[expect(dead_code, reason = "tests draw more of them")]
mod solids;

use std::hint::black_box;
use std::time::Instant;

use glam::DAffine3;
use ligne::drawing::{Page, Unit};
use ligne::pipeline::Renderer;
use ligne::scene::Geometry;
use ligne::{Camera, Scene, Style, SvgOptions};

/// Number of measured views, and of warm-up views before them.
const VIEWS: u32 = 60;
const WARM: u32 = 3;

/// Side length of the page, px.
const SIDE: f64 = 1000.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let shared = |name: &str| models::find(name).map(Scene::open).transpose();
    let torus = solids::torus(200, 100, 1.0, 0.35);
    let scenes = [
        ("torus, 40 thousand", Some(scene(torus))),
        ("knot_50k", shared("cad/knot_50k.glb")?),
        ("bunny", shared("organic/stanford-bunny.obj")?),
        ("knot_100k", shared("cad/knot_100k.glb")?),
    ];
    let styles = [
        ("ink", Style::load("ink")?),
        ("ink along edges", Style::load("ink")?.set("lines.contours", "mesh")?.clone()),
        ("two tones", Style::load("toon")?),
        ("pencil", Style::load("pencil")?),
    ];
    println!("Medians over {VIEWS} views in ms, on {} threads.", rayon::current_num_threads());
    println!("{:<20} {:<16} {:>8} {:>8} {:>8} {:>9}", "model", "style", "least", "median", "most", "bytes");
    for (name, scene) in scenes.iter().filter_map(|(name, scene)| Some((name, scene.as_ref()?))) {
        for (style_name, style) in &styles {
            let row = format!("{name} {style_name}");
            if words.is_empty() || words.iter().any(|word| row.contains(word.as_str())) {
                let (times, bytes) = redraw(scene, style)?;
                let [least, median, most] = [0, times.len() / 2, times.len() - 1].map(|k| times[k] * 1e3);
                println!("{name:<20} {style_name:<16} {least:>8.1} {median:>8.1} {most:>8.1} {bytes:>9}");
            }
        }
    }
    Ok(())
}

/// Time of each view, seconds, ascending, and the number of bytes of the last.
fn redraw(scene: &Scene, style: &Style) -> Result<(Vec<f64>, usize), ligne::Error> {
    let prepared = Renderer::new(scene, style);
    let page = Page { width: SIDE, height: SIDE, unit: Unit::Px, background: None };
    let mut times = Vec::new();
    let mut bytes = 0;
    for view in 0..WARM + VIEWS {
        let turn = 360.0 * f64::from(view) / f64::from(VIEWS);
        let camera = Camera::azimuth_elevation(turn, 25.0, scene.up).with_frame(SIDE, SIDE).fit(scene);
        let start = Instant::now();
        let (drawing, _) = prepared.draw(&camera, page)?;
        let svg = black_box(drawing.to_svg(&SvgOptions::default()));
        if view >= WARM {
            times.push(start.elapsed().as_secs_f64());
        }
        bytes = svg.len();
    }
    times.sort_by(f64::total_cmp);
    Ok((times, bytes))
}

fn scene(solid: solids::Solid) -> Scene {
    let geometry = Geometry { positions: solid.positions, triangles: solid.triangles, ..Geometry::default() };
    let mut scene = Scene::default();
    let geometry = scene.add_geometry(geometry);
    scene.add_part(String::new(), geometry, DAffine3::IDENTITY);
    scene
}
