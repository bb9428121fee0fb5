//! Cost of hatching relative to drawing and to visibility.
//!
//! ```sh
//! cargo bench --bench hatching [-- MODEL…]
//! ```
//!
//! For each model: the time of drawings in hatched styles as a multiple of a drawing in ink, and the time of
//! the hatching stage as a multiple of the visibility stage. Ratios can be compared between machines, times
//! cannot.

#[path = "../tests/library/support/readers/shared_folder.rs"]
#[expect(dead_code, reason = "tests ask it more")]
mod models;

use std::path::PathBuf;
use std::time::Instant;

use ligne::drawing::Page;
use ligne::pipeline::{Renderer, Report};
use ligne::{Camera, Scene, Style};

/// Rounds per measurement. The shortest time counts.
const ROUNDS: usize = 7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given: Vec<PathBuf> =
        std::env::args().skip(1).filter(|word| !word.starts_with("--")).map(PathBuf::from).collect();
    let own =
        ["teapot.obj", "castle.obj", "pump.glb"].map(|name| PathBuf::from("examples/models").join(name));
    let shared = ["organic/stanford-bunny.obj", "mechanical/rocker-arm.obj"];
    let all: Vec<PathBuf> = if given.is_empty() {
        own.into_iter().chain(shared.iter().filter_map(|name| models::find(name))).collect()
    } else {
        given
    };
    println!(
        "{:<22} {:>8} {:>8} {:>10} {:>10} {:>12}",
        "model", "style", "strokes", "x ink", "hatch ms", "x visibility"
    );
    for path in all {
        let scene = Scene::open(&path)?;
        let camera = Camera::three_quarter_of(scene.up).fit(&scene);
        let page = Page::px(camera.width, camera.height);
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let (ink, _) = least(&scene, &camera, page, &Style::load("ink")?);
        for style in ["pencil", "pen", "engraving", "patent", "comic"] {
            let sheet = Style::load(style)?;
            let (whole, report) = least(&scene, &camera, page, &sheet);
            let strokes = ligne::internals::hatch_strokes(&Renderer::new(&scene, &sheet), &camera);
            let stages = report.stages_ms;
            println!(
                "{name:<22} {style:>8} {strokes:>8} {:>9.1}x {:>10.1} {:>11.2}x",
                whole / ink,
                stages.hatching,
                stages.hatching / stages.visibility,
            );
        }
    }
    Ok(())
}

/// Shortest time of a drawing, ms, and its report.
fn least(scene: &Scene, camera: &Camera, page: Page, style: &Style) -> (f64, Report) {
    let mut best: Option<(f64, Report)> = None;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let (_, report) = Renderer::new(scene, style).draw(camera, page).unwrap();
        let time = start.elapsed().as_secs_f64() * 1e3;
        if best.as_ref().is_none_or(|(least, _)| time < *least) {
            best = Some((time, report));
        }
    }
    best.unwrap_or_default()
}
