//! The same input gives the same bytes, whatever the number of threads.

use crate::support::dice::Dice;
use crate::support::models;
use crate::support::scenes::{SCENES, random_camera, random_scene};
use ligne::export::SvgOptions;
use ligne::render::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

fn svg(scene: &Scene, camera: &Camera, style: &Style, threads: usize) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let options = SvgOptions::default().with_precision(8);
    pool.install(|| render(scene, camera, style).unwrap().to_svg(&options))
}

fn same_bytes(scene: &Scene, camera: &Camera, style: &Style, what: &str) {
    let one = svg(scene, camera, style, 1);
    assert!(one.contains("<path"), "{what}: nothing drawn");
    for threads in [1, 2, 4] {
        assert!(one == svg(scene, camera, style, threads), "{what}: {threads} threads draw differently");
    }
}

#[test]
fn threads_do_not_change_a_drawing() {
    for name in ["ink", "technical"] {
        let style = Style::preset(name).unwrap();
        for kind in SCENES {
            let mut dice = Dice::new(21);
            let (scene, camera) = (random_scene(kind, &mut dice), random_camera("perspective", &mut dice));
            same_bytes(&scene, &camera, &style, &format!("{kind} in {name}"));
        }
    }
}

#[test]
fn threads_do_not_change_drawings_of_models() {
    let style = Style::preset("technical").unwrap();
    for name in ["edge/self-intersecting.obj", "edge/soup.stl", "organic/suzanne.obj", "scene/Duck.glb"] {
        if let Some(path) = models::find(name) {
            let scene = Scene::open(&path).unwrap();
            same_bytes(&scene, &Camera::three_quarter().fit(&scene), &style, name);
        }
    }
}
