//! Debug drawings of pipeline stages: every stage of every example model has classified marks, on any number
//! of threads.

use std::path::{Path, PathBuf};

use ligne::drawing::{Mark, Page, Unit};
use ligne::light;
use ligne::lines;
use ligne::mesh::Mesh;
use ligne::pipeline::{Stage, render_reported};
use ligne::view::View;
use ligne::{Camera, Drawing, Scene, Style, SvgOptions};

const MODELS: [&str; 7] =
    ["bear.ply", "bracket.stl", "castle.obj", "gear.obj", "knot.ply", "pump.glb", "teapot.obj"];

fn model(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)
}

fn seen(name: &str) -> (Scene, Camera) {
    let scene = Scene::open(model(name)).expect("an example model");
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    (scene, camera)
}

fn drawn(name: &str, style: &Style, stage: Stage) -> Drawing {
    let (scene, camera) = seen(name);
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
    render_reported(&scene, &camera, style, page, Some(stage)).unwrap().0
}

fn marks(drawing: &Drawing) -> impl Iterator<Item = &Mark> {
    drawing.layers.iter().flat_map(|layer| &layer.marks)
}

fn count(drawing: &Drawing, class: &str) -> usize {
    marks(drawing).filter(|mark| mark.provenance.classes.contains(&class)).count()
}

#[test]
fn every_stage_of_every_example_model_is_drawn() {
    let style = Style::load("suggestive", &[]).expect("a built-in style");
    for name in MODELS {
        for stage in Stage::ALL {
            let drawing = drawn(name, &style, stage);
            let what = format!("{name} {}", stage.name());
            assert!(marks(&drawing).count() > 0, "{what}");
            for mark in marks(&drawing) {
                assert!(!mark.provenance.classes.is_empty(), "{what}");
                assert!(mark.path.elements().len() > 1, "{what}");
            }
        }
    }
}

#[test]
fn stages_are_the_same_with_one_thread_and_with_two() {
    let style = Style::load("suggestive", &[]).expect("a built-in style");
    let with = |threads: usize, stage: Stage| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| drawn("bear.ply", &style, stage).to_svg(&SvgOptions::default()))
    };
    for stage in Stage::ALL {
        assert!(with(1, stage) == with(2, stage), "{}", stage.name());
    }
}

#[test]
fn field_has_both_sides_and_the_line_between() {
    let style = Style::default();
    let bear = drawn("bear.ply", &style, Stage::Field);
    assert_eq!(count(&bear, "zero-set"), 1);
    assert!(count(&bear, "facing") > 50 && count(&bear, "flat") == 0);
    let gear = drawn("gear.obj", &style, Stage::Field);
    assert!(count(&gear, "flat") > 0 && count(&gear, "zero-set") == 0);
    let svg = bear.to_svg(&SvgOptions::default());
    assert!(svg.contains("<title>n·v 0.8 to 1.0</title></path>"));
}

#[test]
fn surfaces_are_cut_where_contours_are_traced() {
    let (scene, camera) = seen("bear.ply");
    let options = &Style::default().lines;
    let surface = lines::Surface::new(Mesh::build(scene.to_soup()), options).finer_for(&camera);
    let view = View::new(&surface.mesh, &camera);
    let found = lines::extract(&surface, &view, options);
    let facing = lines::facing(&surface, &view);
    let cut = light::cut(&surface.mesh, &surface.smooth, &facing, &[0.0]);
    assert!(cut.points.len() > 100);
    // Bitwise equal, because regions cut from the surface must end exactly at the drawn contours.
    assert_eq!(cut.points, found.points[..cut.points.len()]);
    let first = surface.mesh.positions.len() as u32;
    let on_faces: std::collections::BTreeSet<[u32; 2]> =
        found.segments.iter().filter(|s| s.smooth).map(|s| s.ends).collect();
    for (_, ends) in cut.border(0) {
        assert!(ends.iter().all(|end| *end >= first) && on_faces.contains(&ends), "{ends:?}");
    }
}

#[test]
fn zeros_turn_back_and_have_witnesses() {
    let knot = drawn("knot.ply", &Style::default(), Stage::Zeros);
    assert!(count(&knot, "forward") > 0 && count(&knot, "backward") > 0);
    assert!(count(&knot, "witness") > 0);
}

#[test]
fn strengths_name_their_step() {
    let pump = drawn("pump.glb", &Style::default(), Stage::Strengths);
    let notes: Vec<&str> = marks(&pump).filter_map(|mark| mark.provenance.note.as_deref()).collect();
    assert!(notes.contains(&"crease that turns by 90 to 120 degrees"), "{notes:?}");
    let style = Style::load("suggestive", &[]).expect("a built-in style");
    assert!(count(&drawn("bear.ply", &style, Stage::Strengths), "suggestive") > 1);
}

#[test]
fn removed_has_nothing_where_nothing_is_tidied() {
    let pump = drawn("pump.glb", &Style::default(), Stage::Removed);
    let (removed, noted) =
        (count(&pump, "removed"), marks(&pump).filter(|m| m.provenance.note.is_some()).count());
    assert!(removed > 0);
    assert_eq!(removed, noted);
    let sets = ["chain.tidy=0".to_owned(), "lines.contours=mesh".to_owned()];
    let plain = Style::load("ink", &sets).expect("a built-in style");
    assert_eq!(count(&drawn("pump.glb", &plain, Stage::Removed), "removed"), 0);
}
