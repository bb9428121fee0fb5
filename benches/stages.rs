//! Times of each geometric stage on generated meshes: a sphere, rough terrain, a city.

use divan::{Bencher, black_box};
use glam::{DAffine3, DVec3};
use ligne::drawing::Drawing;
use ligne::export::SvgOptions;
use ligne::lines::zero_sets::interior;
use ligne::lines::{self, FeatureLines, InsideOptions, LineKind, LineOptions, Surface};
use ligne::mesh::{Edges, Mesh, MeshMetrics};
use ligne::pipeline;
use ligne::scene::{Camera, Geometry, NamedView, Part, Scene, UpAxis};
use ligne::style::Style;
use ligne::surface::{HardEdges, SmoothNormals};
use ligne::view::{Frame, View};
use ligne::visibility::overlap::coincident_lines;
use ligne::visibility::{self, ViewMap};

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
    let part = Part { name: name.to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
    Scene { geometries: vec![geometry], parts: vec![part], ..Scene::default() }
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
    let surface = Surface::new(Mesh::build(scene.to_soup()), &style.lines).finer_for(&camera);
    let view = View::new(&surface.mesh, &camera);
    let lines = lines::extract(&surface, &view, &style.lines);
    Made { scene, camera, style, surface, view, lines }
}

impl Made {
    fn view_map(&self) -> ViewMap {
        visibility::build(&self.surface.mesh, &self.view, &self.lines, &self.style.lines)
    }

    fn drawing(&self) -> Drawing {
        pipeline::render(&self.scene, &self.camera, &self.style).unwrap()
    }
}

#[divan::bench(args = SCENES)]
fn fit(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| Camera::three_quarter().fit(black_box(&made.scene)));
}

#[divan::bench(args = SCENES)]
fn flatten(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| black_box(&made.scene).to_soup());
}

#[divan::bench(args = SCENES)]
fn edges(bencher: Bencher, name: &str) {
    let soup = scene(name).to_soup();
    bencher.bench(|| Edges::build(soup.positions.len(), black_box(&soup.triangles)));
}

#[divan::bench(args = SCENES)]
fn mesh(bencher: Bencher, name: &str) {
    let scene = scene(name);
    bencher.with_inputs(|| scene.to_soup()).bench_values(Mesh::build);
}

#[divan::bench(args = SCENES)]
fn view(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| View::new(black_box(&made.surface.mesh), &made.camera));
}

#[divan::bench(args = SCENES)]
fn hard_edges(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| HardEdges::find(black_box(&made.surface.mesh), made.style.lines.crease_deg));
}

#[divan::bench(args = SCENES)]
fn edge_lines(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| lines::edges::edge_lines::find(black_box(&made.surface), &made.view, &made.style.lines));
}

#[divan::bench(args = SCENES)]
fn curvature(bencher: Bencher, name: &str) {
    let made = made(name);
    let smooth = SmoothNormals::rounded(&made.surface.mesh);
    bencher.bench(|| interior::curvature(black_box(&made.surface.mesh), &smooth, &InsideOptions::default()));
}

#[divan::bench(args = SCENES)]
fn suggestive_contours(bencher: Bencher, name: &str) {
    let made = made(name);
    let smooth = SmoothNormals::rounded(&made.surface.mesh);
    let options = LineOptions { kinds: vec![LineKind::Suggestive], ..LineOptions::default() };
    let curvature = interior::curvature(&made.surface.mesh, &smooth, &options.inside);
    bencher.bench(|| {
        let mut lines = FeatureLines::default();
        interior::find(black_box(&made.surface.mesh), &made.view, &smooth, &curvature, &options, &mut lines);
        lines
    });
}

#[divan::bench(args = SCENES)]
fn all_lines(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| lines::extract(black_box(&made.surface), &made.view, &made.style.lines));
}

#[divan::bench(args = SCENES)]
fn visibility(bencher: Bencher, name: &str) {
    let made = made(name);
    bencher.bench(|| black_box(&made).view_map());
}

/// The input map has no overlaps left, so this measures the search without the removal.
#[divan::bench(args = SCENES)]
fn doubles(bencher: Bencher, name: &str) {
    let map = made(name).view_map();
    let camera = Camera::named(NamedView::Front, UpAxis::Y).with_frame(1000.0, 1000.0);
    let frame = Frame::new(&camera, DVec3::ZERO);
    bencher
        .with_inputs(|| map.clone())
        .bench_refs(|map| coincident_lines::remove_coincident(map, 0.02, &frame, &MeshMetrics::default()));
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
