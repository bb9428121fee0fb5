//! Time of a view of a prepared model, as a multiple of a depth raster of the same model.
//!
//! ```sh
//! cargo bench --bench fills [-- MODEL…]
//! ```
//!
//! A *redraw* is all work for one view of a [`Renderer`] scene: projection, lines, tone borders, visibility,
//! regions, chains, ink. The *floor* is one depth raster of its faces with 1024 x 1024 pixels. Ratios can be
//! compared between machines, times cannot.

#[path = "../tests/library/support/readers/shared_folder.rs"]
#[expect(dead_code, reason = "tests ask it more")]
mod models;
#[path = "../tests/library/support/scenes/solids.rs"]
#[expect(dead_code, reason = "tests draw more of them")]
mod solids;

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use glam::{DAffine3, DVec3};
use libm::{atan2, cos, sin};
use ligne::drawing::{Page, Unit};
use ligne::internals::mesh::Mesh;
use ligne::internals::view::View;
use ligne::internals::view::{FaceBuffer, PixelGrid};
use ligne::pipeline::Renderer;
use ligne::scene::Geometry;
use ligne::{Camera, Scene, Style};
use rayon::ThreadPool;
use solids::Solid;

const SHARED: [&str; 2] = ["cad/knot_50k.glb", "organic/stanford-bunny.obj"];

/// Rounds per measurement: at least `MIN_ROUNDS`, then more until `MAX_TIME_PER_MODEL` has passed, at most
/// `MAX_ROUNDS`.
const MIN_ROUNDS: usize = 3;
const MAX_ROUNDS: usize = 40;
const MAX_TIME_PER_MODEL: Duration = Duration::from_secs(2);

/// Side length of the raster, pixels.
const SIDE: f64 = 1024.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given: Vec<PathBuf> =
        std::env::args().skip(1).filter(|word| !word.starts_with("--")).map(PathBuf::from).collect();
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let pools = [1, all].map(|threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build());
    let [one, all] = pools;
    let pools = [one?, all?];
    let styles = [
        ("ink", Style::load("ink")?),
        ("fills", Style::load("toon")?.set("lines.enabled", false)?.clone()),
        ("toon", Style::load("toon")?),
    ];

    println!("Least times in ms, and in floors (x): lines alone, fills alone, lines and fills.");
    print!("{:<20} {:>8} {:>4} {:>8}", "model", "faces", "thr", "floor");
    styles.iter().for_each(|(name, _)| print!("  {name:>8} {:>7}", "x"));
    println!();
    if given.is_empty() {
        let torus = solids::torus(200, 100, 1.0, 0.4);
        rows("torus", &scene(torus), &styles, &pools);
        // A model that hides large parts of itself.
        rows("knot", &scene(knot(400, 50)), &styles, &pools);
    }
    let shared = SHARED.iter().filter(|_| given.is_empty()).filter_map(|name| models::find(name));
    for path in shared.chain(given.iter().cloned()) {
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        rows(&name, &Scene::open(Path::new(&path))?, &styles, &pools);
    }
    Ok(())
}

/// Round tube along a trefoil, made by bending a torus.
fn knot(along: usize, around: usize) -> Solid {
    let axis = |t: f64| {
        let radius = 2.0 + 0.95 * cos(3.0 * t);
        DVec3::new(radius * cos(2.0 * t), radius * sin(2.0 * t), 0.95 * sin(3.0 * t))
    };
    solids::torus(along, around, 1.0, 0.46).moved(|p| {
        // The angle around the z axis of the torus is the parameter along the knot.
        let t = atan2(p.y, p.x);
        let (out, up) = (p.truncate().length() - 1.0, p.z);
        let way = (axis(t + 1e-5) - axis(t - 1e-5)).normalize();
        let middle = DVec3::new(2.0 * cos(2.0 * t), 2.0 * sin(2.0 * t), 0.0);
        let u = (axis(t) - middle).reject_from_normalized(way).normalize();
        axis(t) + out * u + up * u.cross(way)
    })
}

fn scene(solid: Solid) -> Scene {
    let geometry = Geometry { positions: solid.positions, triangles: solid.triangles, ..Geometry::default() };
    let mut scene = Scene::default();
    let geometry = scene.add_geometry(geometry);
    scene.add_part("model".to_owned(), geometry, DAffine3::IDENTITY);
    scene
}

fn rows(name: &str, scene: &Scene, styles: &[(&str, Style)], pools: &[ThreadPool]) {
    let camera = Camera::three_quarter_of(scene.up).with_frame(SIDE, SIDE).fit(scene);
    let page = Page { width: SIDE, height: SIDE, unit: Unit::Px, background: None };
    let mesh = Mesh::of(scene);
    let view = View::new(&mesh, &camera);
    for pool in pools {
        let floor = pool.install(|| least_ms(|| FaceBuffer::new(&PixelGrid::new(&mesh, &view))));
        let threads = pool.current_num_threads();
        print!("{name:<20} {:>8} {threads:>4} {floor:>8.2}", mesh.triangles.len());
        for (_, style) in styles {
            let prepared = Renderer::new(scene, style);
            let redraw = pool.install(|| least_ms(|| prepared.draw(&camera, page).unwrap()));
            print!("  {redraw:>8.1} {:>7.1}", redraw / floor);
        }
        println!();
    }
}

/// Shortest of several runs after a warm-up, ms.
fn least_ms<T>(mut run: impl FnMut() -> T) -> f64 {
    black_box(run());
    let started = Instant::now();
    let mut least = f64::INFINITY;
    for round in 0..MAX_ROUNDS {
        if round >= MIN_ROUNDS && started.elapsed() > MAX_TIME_PER_MODEL {
            break;
        }
        let start = Instant::now();
        black_box(run());
        least = least.min(start.elapsed().as_secs_f64() * 1e3);
    }
    least
}
