//! Times of the search for intersections, on generated solids and on scans.

#[path = "../tests/library/support/readers/shared_folder.rs"]
#[expect(dead_code, reason = "tests ask it more")]
mod models;
#[path = "../tests/library/support/scenes/solids.rs"]
#[expect(dead_code, reason = "tests draw more of them")]
mod solids;

use divan::Bencher;
use glam::DVec3;
use ligne::Scene;
use ligne::internals::mesh::Mesh;
use ligne::internals::mesh::{IntersectionInput, intersections};
use solids::Solid;

fn main() {
    divan::main();
}

/// Whether each triangle faces a distant camera. About half of a closed surface does.
fn facing(solid: &Solid) -> Vec<bool> {
    let eye = DVec3::new(0.4, 0.5, 0.77);
    solid
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| solid.positions[v as usize]);
            (b - a).cross(c - a).dot(eye) > 0.0
        })
        .collect()
}

/// Shared model as a solid; none if it is missing.
fn scan(name: &str) -> Option<Solid> {
    let scene = Scene::open(models::find(name)?).ok()?;
    let Mesh { positions, triangles, .. } = Mesh::of(&scene);
    Some(Solid { positions, triangles })
}

fn search(bencher: Bencher, solid: &Solid, active: &[bool]) {
    let input =
        IntersectionInput { positions: &solid.positions, triangles: &solid.triangles, active, bodies: &[] };
    bencher.counter(divan::counter::ItemsCount::new(solid.triangles.len())).bench(|| intersections(&input));
}

const SCANS: [&str; 3] = ["organic/stanford-bunny.obj", "organic/dragon-202k.ply", "organic/dragon-871k.ply"];

#[divan::bench(args = SCANS, sample_count = 15)]
fn scan_all_faces(bencher: Bencher, name: &str) {
    if let Some(solid) = scan(name) {
        search(bencher, &solid, &[]);
    }
}

#[divan::bench(args = SCANS, sample_count = 15)]
fn scan_facing_half(bencher: Bencher, name: &str) {
    if let Some(solid) = scan(name) {
        search(bencher, &solid, &facing(&solid));
    }
}

#[divan::bench(args = [50, 158, 500], sample_count = 15)]
fn two_tori(bencher: Bencher, rings: usize) {
    let mut scene = solids::torus(rings, rings, 1.0, 0.3);
    scene.add(solids::torus(rings, rings, 1.0, 0.3).moved(|p| DVec3::new(p.x + 0.7, p.z, p.y)));
    search(bencher, &scene, &[]);
}

#[divan::bench(args = [30, 100, 300], sample_count = 15)]
fn boxes_in_a_row(bencher: Bencher, side: usize) {
    let mut scene = Solid::default();
    for i in 0..side {
        for j in 0..side {
            let low = DVec3::new(i as f64, j as f64, 0.0);
            let height = 1.0 + ((i * 7 + j * 13) % 17) as f64;
            scene.add(solids::cuboid(low, low + DVec3::new(0.7, 0.8, height)));
        }
    }
    search(bencher, &scene, &[]);
}
