//! Drawings are stable when the camera turns by 0.1 degrees: 98 % of the ink follows the motion of the
//! surface.

use crate::library::support::readers::shared_folder;
use std::path::Path;

use crate::library::support::measures::camera_turns::{
    Stability, compare_cameras, prepare_surface, turn_camera,
};
use ligne::lines::LineOptions;
use ligne::scene::{Camera, Scene};

/// Minimum share of the ink that stays, in percent.
const MIN_STABLE_INK_PERCENT: f64 = 98.0;

fn stability(path: &Path, azimuths: &[f64], degrees: f64) -> Stability {
    let scene = Scene::open(path).unwrap();
    let options = LineOptions::default();
    let surface = prepare_surface(&scene, &options);
    let mut all = Stability::default();
    for azimuth in azimuths {
        let camera = Camera::azimuth_elevation(*azimuth, 22.0, scene.up).fit(&scene);
        all.add(compare_cameras(&surface, &options, [&camera, &turn_camera(&camera, &scene, degrees)]));
    }
    println!("{}: {:.3} % stays, {} lines pop", path.display(), all.stable_percent(), all.pops.len());
    for pop in &all.pops {
        println!("    {pop}");
    }
    all
}

fn example(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)
}

#[test]
fn example_drawings_are_stable_under_small_camera_turns() {
    for name in ["knot.ply", "teapot.obj", "gear.obj", "bracket.stl", "pump.glb", "castle.obj"] {
        let share = stability(&example(name), &[35.0, 215.0], 0.1).stable_percent();
        assert!(share >= MIN_STABLE_INK_PERCENT, "{name}: {share} % stays");
    }
}

#[test]
fn shared_model_drawings_are_stable_under_small_camera_turns() {
    for name in ["organic/spot.obj", "organic/suzanne.obj", "mechanical/rocker-arm.obj"] {
        if let Some(path) = shared_folder::find(name) {
            let share = stability(&path, &[35.0, 125.0], 0.1).stable_percent();
            assert!(share >= MIN_STABLE_INK_PERCENT, "{name}: {share} % stays");
        }
    }
}

#[test]
fn an_unchanged_camera_draws_the_same() {
    let still = stability(&example("knot.ply"), &[35.0], 0.0);
    assert!(still.length > 1000.0 && still.stable_percent() == 100.0);
}
