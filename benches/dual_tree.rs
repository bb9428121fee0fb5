//! Number of edges that the dual-space tree tests, and the time of a search.
//!
//! Source of the table: figure 3 of Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with
//! improved quality by exploiting graphics hardware", IVCNZ 2001.
//!
//! ```sh
//! cargo bench --bench dual_tree [-- MODEL…]
//! ```

#[path = "../tests/library/support/readers/shared_folder.rs"]
#[expect(dead_code, reason = "tests ask it more")]
mod models;
#[path = "../tests/library/support/scenes/round_solids.rs"]
#[expect(dead_code, reason = "tests draw more of them")]
mod round_solids;
#[path = "../tests/library/support/scenes/solids.rs"]
#[expect(dead_code, reason = "tests draw more of them")]
mod solids;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use glam::{DAffine3, DVec3};

use ligne::Style;
use ligne::internals::lines::{EdgeSearch, edge_lines, edge_lines_among};
use ligne::internals::mesh::Mesh;
use ligne::internals::mesh::ToneTree;
use ligne::internals::view::View;
use ligne::pipeline::{LineKind, Surface};
use ligne::scene::{Camera, Geometry, Projection, Scene};
use rayon::prelude::*;
use solids::Solid;

const SHARED: [&str; 8] = [
    "cad/gear.stl",
    "cad/drive.glb",
    "mechanical/rocker-arm.obj",
    "mechanical/2CylinderEngine.glb",
    "organic/stanford-bunny.obj",
    "organic/armadillo.obj",
    "organic/dragon-202k.ply",
    "organic/dragon-871k.ply",
];

fn main() {
    let given: Vec<PathBuf> =
        std::env::args().skip(1).filter(|a| !a.starts_with("--")).map(PathBuf::from).collect();
    println!(
        "Means over 26 views; P = perspective, O = orthographic. Asked: edges whose faces are compared. Pays: views \
         after which the tree has saved the time that it took to make."
    );
    println!(
        "{:<26} {:>8} {:>7} {:>7}   {:>7} {:>6} {:>8} {:>8}  {:>8} {:>8} {:>6} {:>6}",
        "model",
        "edges",
        "cubes",
        "fixed",
        "asked",
        "%",
        "contours",
        "boxes",
        "plain ms",
        "tree ms",
        "made",
        "pays"
    );
    if given.is_empty() {
        for level in 3..=8 {
            row(&format!("icosphere {level}"), &scene(round_solids::icosphere(level)));
        }
        for rings in [30, 100, 300] {
            row(&format!("torus {rings}²"), &scene(solids::torus(rings, rings, 1.0, 0.3)));
        }
    }
    let shared = SHARED.iter().filter(|_| given.is_empty()).filter_map(|name| models::find(name));
    for path in shared.chain(given.iter().cloned()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match Scene::open(&path) {
            Ok(scene) => row(&name, &scene),
            Err(error) => println!("{name}: {error}"),
        }
    }
    tones();
}

fn scene(solid: Solid) -> Scene {
    let geometry = Geometry { positions: solid.positions, triangles: solid.triangles, ..Geometry::default() };
    let mut scene = Scene::default();
    let geometry = scene.add_geometry(geometry);
    scene.add_part(String::new(), geometry, DAffine3::IDENTITY);
    scene
}

/// Directions to the faces, edges and corners of a cube.
fn directions() -> Vec<DVec3> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.iter().flat_map(|x| steps.map(|y| (*x, y)));
    all.flat_map(|(x, y)| steps.map(|z| DVec3::new(x, y, z))).filter(|d| *d != DVec3::ZERO).collect()
}

/// Shortest time of five calls.
fn timed<T>(mut call: impl FnMut() -> T) -> (T, Duration) {
    let mut best = Duration::MAX;
    for _ in 0..4 {
        let started = Instant::now();
        drop(call());
        best = best.min(started.elapsed());
    }
    let started = Instant::now();
    let made = call();
    (made, best.min(started.elapsed()))
}

fn row(name: &str, scene: &Scene) {
    let mut style = Style::default();
    style.set("lines.contours", "mesh").expect("a key");
    style.set("lines.kinds", "['contour', 'border', 'crease', 'material']").expect("a key");
    let surface = Surface::of(Mesh::of(scene), &style);
    let edges = ligne::internals::edges(&surface.mesh).len();
    let started = Instant::now();
    let search = EdgeSearch::new(&surface);
    let made = started.elapsed();
    for perspective in [true, false] {
        let (mut asked, mut contours, mut boxes) = (0, 0, 0);
        let (mut plain_time, mut tree_time) = (Duration::ZERO, Duration::ZERO);
        for direction in directions() {
            let camera = Camera { eye: direction, target: DVec3::ZERO, ..Camera::three_quarter() };
            let camera = if direction.cross(camera.up).length() < 0.1 {
                Camera { up: DVec3::new(0.3, 0.5, 0.8), ..camera }
            } else {
                camera
            };
            let parallel = Projection::Orthographic { height: 1.0 };
            let camera = if perspective { camera } else { camera.with_projection(parallel) }.fit(scene);
            let view = View::of(&surface, &camera);
            let (plain, time) = timed(|| edge_lines(&surface, &view, &style));
            plain_time += time;
            let (by_tree, time) = timed(|| {
                let among = search.candidates(&surface.mesh, &view).items;
                edge_lines_among(&among, &surface, &view, &style)
            });
            tree_time += time;
            assert!(plain == by_tree, "the tree finds other lines than the plain scan");
            let found = search.tree().candidates(ligne::internals::frame(&view).homogeneous_eye());
            asked += found.items.len();
            boxes += found.boxes;
            contours += plain.iter().filter(|s| s.kind == LineKind::Contour).count();
        }
        let count = directions().len();
        // Number of views after which the tree has saved its construction time.
        let saved = (plain_time.as_secs_f64() - tree_time.as_secs_f64()) / count as f64;
        let pays =
            if saved > 0.0 { format!("{:.0}", (made.as_secs_f64() / saved).ceil()) } else { "-".into() };
        let share = 100.0 * (asked / count) as f64 / search.tree().len().max(1) as f64;
        println!(
            "{:<26} {edges:>8} {:>7} {:>7}   {:>7} {share:>6.2} {:>8} {:>8}  {:>8.3} {:>8.3} {:>6.0} {pays:>6}",
            format!("{name}, {}", if perspective { "P" } else { "O" }),
            search.tree().cubes(),
            search.fixed().len(),
            asked / count,
            contours / count,
            boxes / count,
            plain_time.as_secs_f64() * 1e3 / count as f64,
            tree_time.as_secs_f64() * 1e3 / count as f64,
            made.as_secs_f64() * 1e3,
        );
    }
}

/// Triangles with the tone border L·n = 0.3 on spheres, for one light per view direction.
fn tones() {
    println!("\nTriangles that may hold a tone border:");
    println!(
        "{:<26} {:>8} {:>7} {:>6} {:>8}  {:>8} {:>8}",
        "sphere", "faces", "asked", "%", "parted", "plain ms", "tree ms"
    );
    for level in 4..=8 {
        let ball = round_solids::icosphere(level);
        let normals: Vec<[DVec3; 3]> =
            ball.triangles.iter().map(|t| t.map(|v| ball.positions[v as usize])).collect();
        let tree = ToneTree::new(&normals);
        let parts = |normals: &[DVec3; 3], light: DVec3| {
            let bright = normals.map(|n| n.dot(light) >= 0.3);
            bright[0] != bright[1] || bright[1] != bright[2]
        };
        let (mut asked, mut parted) = (0, 0);
        let (mut plain_time, mut tree_time) = (Duration::ZERO, Duration::ZERO);
        for light in directions() {
            let light = light.normalize();
            let (plain, time) = timed(|| -> Vec<u32> {
                let faces = 0..normals.len() as u32;
                faces
                    .into_par_iter()
                    .with_min_len(1 << 14)
                    .filter(|f| parts(&normals[*f as usize], light))
                    .collect()
            });
            plain_time += time;
            let (by_tree, time) = timed(|| -> Vec<u32> {
                let mut faces = tree.candidates(light, 0.3).items;
                faces.retain(|f| parts(&normals[*f as usize], light));
                faces
            });
            tree_time += time;
            assert!(plain == by_tree, "the tree finds other triangles than the plain scan");
            asked += tree.candidates(light, 0.3).items.len();
            parted += plain.len();
        }
        let count = directions().len();
        println!(
            "{:<26} {:>8} {:>7} {:>6.2} {:>8}  {:>8.3} {:>8.3}",
            format!("icosphere {level}"),
            normals.len(),
            asked / count,
            100.0 * (asked / count) as f64 / normals.len() as f64,
            parted / count,
            plain_time.as_secs_f64() * 1e3 / count as f64,
            tree_time.as_secs_f64() * 1e3 / count as f64,
        );
    }
}
