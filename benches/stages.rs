//! Times of each geometric stage on generated meshes: a sphere, rough terrain, a city.

use divan::{Bencher, black_box};
use glam::{DAffine3, DVec3};
use ligne::drawing::{Drawing, Unit};
use ligne::pipeline::{Chain, FeatureLines, Mesh, Surface, View, ViewMap};
use ligne::scene::Geometry;
use ligne::{Camera, Scene, Style, SvgOptions, render};

#[allow(dead_code)]
#[path = "../examples/make_stress/scenes.rs"]
mod scenes;

/// 120,000 triangles each.
const SCENES: [&str; 3] = ["sphere", "terrain", "city"];

fn main() {
    divan::main();
}

fn scene(name: &str) -> Scene {
    let made = match name {
        "sphere" => scenes::sphere(100),
        "terrain" => scenes::terrain(245),
        _ => scenes::city(100),
    };
    let geometry = Geometry {
        positions: made.points.into_iter().map(DVec3::from_array).collect(),
        triangles: made.faces,
        ..Geometry::default()
    };
    let mut scene = Scene::default();
    let geometry = scene.add_geometry(geometry);
    scene.add_part(name.to_owned(), geometry, DAffine3::IDENTITY);
    scene
}

/// Scene with all intermediate results of a drawing.
struct Made {
    scene: Scene,
    camera: Camera,
    style: Style,
    surface: Surface,
    view: View,
    lines: FeatureLines,
}

fn made(name: &str) -> Made {
    let scene = scene(name);
    let camera = Camera::three_quarter().fit(&scene);
    let style = Style::preset("ink").unwrap_or_default();
    let surface = Surface::of(Mesh::of(&scene), &style).finer_for(&camera, 0.15);
    let view = View::of(&surface, &camera);
    let lines = FeatureLines::of(&surface, &view, &style);
    Made { scene, camera, style, surface, view, lines }
}

impl Made {
    fn view_map(&self) -> ViewMap {
        ViewMap::of(&self.surface, &self.view, &self.lines, &self.style)
    }

    fn drawing(&self) -> Drawing {
        render(&self.scene, &self.camera, &self.style).unwrap()
    }
}

#[divan::bench(args = SCENES)]
fn fit(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| Camera::three_quarter().fit(black_box(&made.scene)));
}

#[divan::bench(args = SCENES)]
fn mesh(bencher: Bencher, name: &str) {
    let scene = scene(name);
    bencher.bench(|| Mesh::of(black_box(&scene)));
}

#[divan::bench(args = SCENES)]
fn surface(bencher: Bencher, name: &str) {
    let (mesh, style) = (Mesh::of(&scene(name)), Style::default());
    bencher.with_inputs(|| mesh.clone()).bench_values(|mesh| Surface::of(mesh, &style));
}

#[divan::bench(args = SCENES)]
fn view(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| View::of(black_box(&made.surface), &made.camera));
}

#[divan::bench(args = SCENES)]
fn suggestive_contours(bencher: Bencher, name: &str) {
    let made = made(name);
    let mut style = Style::default();
    style.set("lines.kinds", "['suggestive']").unwrap();
    bencher.bench(|| FeatureLines::of(black_box(&made.surface), &made.view, &style));
}

#[divan::bench(args = SCENES)]
fn all_lines(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| FeatureLines::of(black_box(&made.surface), &made.view, &made.style));
}

#[divan::bench(args = SCENES)]
fn visibility(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| black_box(&made).view_map());
}

#[divan::bench(args = SCENES)]
fn chains(bencher: Bencher, name: &str) {
    let (map, style) = (made(name).view_map(), Style::default());
    bencher.bench(|| Chain::link(black_box(&map), &style, Unit::Px));
}

#[divan::bench(args = SCENES)]
fn svg(bencher: Bencher, name: &str) {
    let drawing = made(name).drawing();
    bencher.bench(|| black_box(&drawing).to_svg(&SvgOptions::default()));
}

#[divan::bench(args = SCENES)]
fn pdf(bencher: Bencher, name: &str) {
    let drawing = made(name).drawing();
    bencher.bench(|| black_box(&drawing).to_pdf());
}

#[divan::bench(args = SCENES)]
fn whole(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| black_box(&made).drawing());
}
