//! A `Renderer` draws the same for several views, for one view, and when it consumes the scene.

use std::borrow::Cow;

use std::path::PathBuf;

use ligne::drawing::{Drawing, Page, Unit};
use ligne::pipeline::Renderer;
use ligne::{Camera, Scene, Style};

fn model(name: &str) -> Scene {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
    Scene::open(path).expect("a model of the examples")
}

fn view(scene: &Scene, turn: f64) -> Camera {
    Camera::azimuth_elevation(turn, 30.0, scene.up).with_frame(240.0, 240.0).fit(scene)
}

fn draw(prepared: &Renderer, camera: &Camera) -> Drawing {
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
    prepared.draw(camera, page).expect("a camera that can draw").0
}

/// Covers a light fixed to the world, whose shadows all views share, and a light fixed to the camera.
#[test]
fn shared_shadows_equal_those_of_single_views() {
    let castle = model("castle.obj");
    let fixed = "light.sources=[{ kind = \"directional\", direction = [1, 2, 1] }]";
    let moving = "light.sources=[{ kind = \"directional\", direction = [1, 2, 1], space = \"camera\" }]";
    for light in [fixed, moving] {
        // With mesh contours no view refines round surfaces, so all views share one mesh.
        let sets = [light, "fills.cast_shadows=true", "lines.contours=mesh"].map(str::to_owned);
        let style = Style::load_with("toon", &sets).expect("a style");
        let shared = Renderer::new(&castle, &style);
        let drawn = [0.0, 130.0, 250.0].map(|turn| {
            let camera = view(&castle, turn);
            let drawing = draw(&shared, &camera);
            assert!(drawing == draw(&Renderer::new(&castle, &style), &camera), "{light} {turn}");
            drawing
        });
        assert!(drawn[0] != drawn[1]);
    }
}

/// The trees of `lines.edge_tree` are built by the second view. They apply to contours in the first style, to tones
/// in the others. With two lights, with highlights and with many levels the tree of tones is not used.
#[test]
fn views_with_trees_equal_those_without() {
    let two_lights = "light.sources=[{ kind = \"directional\", direction = [1, 2, 1] }, \
                      { kind = \"directional\", direction = [-1, 0, 1] }]";
    for (name, style, set) in [
        ("bear.ply", "ink", "light.wrap=0"),
        ("bear.ply", "toon", "light.wrap=0.3"),
        ("bear.ply", "pencil", "fills.cast_shadows=true"),
        ("castle.obj", "comic", "fills.cast_shadows=true"),
        ("bear.ply", "toon", two_lights),
        ("bear.ply", "gradient", "light.wrap=0"),
    ] {
        let scene = model(name);
        let [plain, with_tree] = [false, true].map(|tree| {
            let sets = ["lines.contours=mesh", set, &format!("lines.edge_tree={tree}")].map(str::to_owned);
            Style::load_with(style, &sets).expect("a style")
        });
        let [plain, with_tree] = [&plain, &with_tree].map(|style| Renderer::new(&scene, style));
        for turn in [0.0, 130.0] {
            let camera = view(&scene, turn);
            assert!(draw(&plain, &camera) == draw(&with_tree, &camera), "{name} {style} {turn}");
        }
    }
}

/// A `Renderer` that consumes its scene draws the same as one that borrows it, for styles that use parts,
/// materials and textures.
#[test]
fn consumed_scenes_give_the_same_drawing_as_kept_ones() {
    for (name, style, sets) in [
        ("castle.obj", "ink", [].as_slice()),
        ("castle.obj", "comic", &["fills.cast_shadows=true"]),
        ("picnic.obj", "toon", &["fills.texture=image"]),
        ("trellis.obj", "toon", &[]),
        ("jar.obj", "technical", &[]),
        ("jar.obj", "pencil", &[]),
        ("bear.ply", "stipple", &[]),
    ] {
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let (scene, style) = (model(name), Style::load_with(style, &sets).expect("a style"));
        let camera = view(&scene, 40.0);
        let kept = draw(&Renderer::for_camera(Cow::Borrowed(&scene), &style, &camera, Unit::Px), &camera);
        assert!(
            draw(&Renderer::for_camera(Cow::Owned(scene), &style, &camera, Unit::Px), &camera) == kept,
            "{name}"
        );
    }
}
