//! The same input gives the same bytes, whatever the number of threads.

#[path = "common/mod.rs"]
mod common;
#[path = "support/dice.rs"]
mod dice;
#[path = "support/models.rs"]
mod models;
#[path = "support/pipeline.rs"]
mod pipeline;
#[path = "support/scenes.rs"]
mod scenes;
#[path = "support/solids.rs"]
mod solids;

use common::Folder;
use dice::Dice;
use ligne::export::SvgOptions;
use ligne::render::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use scenes::{SCENES, random_camera, random_scene};

fn svg(scene: &Scene, camera: &Camera, style: &Style, threads: usize) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let options = SvgOptions { precision: Some(8), ..SvgOptions::default() };
    pool.install(|| render(scene, camera, style).to_svg(&options))
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

#[test]
fn threads_do_not_change_what_the_program_writes() {
    let folder = Folder::with_cubes("threads");
    for (threads, out) in [("1", "one.svg"), ("2", "two.svg"), ("2", "again.svg")] {
        folder
            .ligne(&format!("draw cubes.obj {out} --threads {threads} --set lines.hidden=\"dashed\""))
            .done();
    }
    let one = folder.read("one.svg");
    assert!(one == folder.read("two.svg") && one == folder.read("again.svg"));
}
