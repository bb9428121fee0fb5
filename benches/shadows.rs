//! Times of cast shadows: their borders, and shadow queries of points. Also the time of sky visibility.
//!
//! ```sh
//! cargo bench --bench shadows [-- MODEL…]
//! ```

#[path = "../tests/library/support/readers/shared_folder.rs"]
#[expect(dead_code, reason = "tests ask it more")]
mod models;

use std::path::PathBuf;
use std::time::Instant;

use glam::DVec3;
use ligne::internals::light::Caster;
use ligne::internals::light::ambient_visibility;
use ligne::internals::mesh::{FaceId, Mesh};
use ligne::internals::shadows::Shadows;
use ligne::scene::Scene;

const SHARED: [&str; 7] = [
    "cad/drive.glb",
    "mechanical/2CylinderEngine.glb",
    "organic/stanford-bunny.obj",
    "organic/armadillo.obj",
    "organic/airliner.obj",
    "organic/dragon-202k.ply",
    "organic/dragon-871k.ply",
];

fn main() {
    let given: Vec<PathBuf> =
        std::env::args().skip(1).filter(|a| !a.starts_with("--")).map(PathBuf::from).collect();
    println!(
        "{:<24} {:>8}  {:<12} {:>8} {:>8} {:>8} {:>9}",
        "model", "faces", "light", "segments", "points", "lines ms", "100k pts"
    );
    let own = |name: &str| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/")).join(name);
    let shared = SHARED.iter().filter(|_| given.is_empty()).filter_map(|name| models::find(name));
    let own = ["castle.obj", "bear.ply"].map(own).into_iter().filter(|_| given.is_empty());
    for path in own.chain(shared).chain(given.iter().cloned()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match Scene::open(&path) {
            Ok(scene) => rows(&name, &Mesh::of(&scene)),
            Err(error) => println!("{name}: {error}"),
        }
    }
}

fn rows(name: &str, mesh: &Mesh) {
    let diagonal = ligne::internals::diagonal(mesh);
    let lights = [
        ("directional", Caster::Directional { towards: DVec3::new(0.5, 0.7, 0.6) }),
        ("point", Caster::Point { position: DVec3::new(0.5, 0.7, 0.6) * diagonal }),
        ("six views", Caster::Point { position: DVec3::new(0.21, 0.28, 0.23) * diagonal }),
    ];
    let faces = mesh.triangles.len() as u32;
    let asked: Vec<(u32, DVec3)> = (0..100_000_u32)
        .map(|k| {
            let face = k.wrapping_mul(2_654_435_761) % faces;
            let [a, b, c] = mesh.corners(FaceId(face));
            (face, (a + b + c) / 3.0)
        })
        .collect();
    for reach in [f64::INFINITY, diagonal / 10.0] {
        let started = Instant::now();
        let sky = ambient_visibility(mesh, &[], |_| reach);
        let took = started.elapsed();
        let mean = sky.iter().sum::<f64>() / sky.len().max(1) as f64;
        let vertices = sky.len();
        println!(
            "{name:<24} {faces:>8}  sky of {vertices} vertices up to {reach:.3}: mean {mean:.3}, {:.0} ms",
            took.as_secs_f64() * 1e3
        );
    }
    for (kind, light) in lights {
        let started = Instant::now();
        let shadows = Shadows::new(mesh, &[light]);
        let made = started.elapsed();
        let started = Instant::now();
        let masks = shadows.shadowed(mesh, &asked);
        let answered = started.elapsed();
        assert_eq!(masks.len(), asked.len());
        println!(
            "{name:<24} {faces:>8}  {kind:<12} {:>8} {:>8} {:>8.0} {:>9.0}",
            shadows.lines.segments.len(),
            shadows.lines.points.len(),
            made.as_secs_f64() * 1e3,
            answered.as_secs_f64() * 1e3,
        );
    }
}
