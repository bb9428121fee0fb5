//! Golden drawings: small drawings compared with approved SVG files.
//!
//! After an intended change, review the differences and renew the files with
//! `LIGNE_BLESS=1 cargo test --lib assert_golden`. That is refused where `CI` is set.

use std::path::Path;

use crate::library::support::pipeline::scene;
use crate::library::support::scenes::solids::{cuboid, sphere, torus};
use glam::DVec3;
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use ligne::testing::assert_drawing;

fn assert_golden(name: &str, scene: &Scene, style: &str) {
    let mut camera = Camera::three_quarter();
    (camera.width, camera.height) = (300.0, 300.0);
    let drawing = render(scene, &camera.fit(scene), &Style::preset(style).unwrap()).unwrap();
    assert_drawing!(drawing, name, folder = "tests/golden");
}

#[test]
fn cubes_match_their_approved_drawings() {
    let large = cuboid(DVec3::splat(-1.0), DVec3::ONE);
    let small = cuboid(DVec3::new(0.4, 0.2, 0.6), DVec3::new(1.7, 1.4, 1.9));
    assert_golden("cubes", &scene([large.clone(), small.clone()]), "ink");
    assert_golden("cubes-technical", &scene([large, small]), "technical");
}

#[test]
fn ball_in_ring_matches_its_approved_drawing() {
    assert_golden("ball-in-ring", &scene([torus(48, 24, 1.0, 0.3), sphere(16, 0.8)]), "ink");
}

fn example(name: &str) -> Scene {
    Scene::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)).unwrap()
}

#[test]
fn gear_matches_its_approved_drawing() {
    assert_golden("gear", &example("gear.obj"), "ink");
}

#[test]
fn teapot_in_two_tones_matches_its_approved_drawing() {
    assert_golden("teapot-toon", &example("teapot.obj"), "toon");
}

#[test]
fn knot_with_cast_shadows_matches_its_approved_drawing() {
    assert_golden("knot-comic-flats", &example("knot.ply"), "comic-flats");
}

#[test]
fn teapot_in_pencil_matches_its_approved_drawing() {
    assert_golden("teapot-pencil-plain", &example("teapot.obj"), "pencil-plain");
}

#[test]
fn patent_and_comic_cubes_match_their_approved_drawings() {
    let cubes =
        || [cuboid(DVec3::ZERO, DVec3::ONE), cuboid(DVec3::new(1.2, 0.0, 0.3), DVec3::new(1.7, 0.6, 0.8))];
    assert_golden("cubes-patent", &scene(cubes()), "patent");
    assert_golden("cubes-comic", &scene(cubes()), "comic");
}
