//! Debug drawings of pipeline stages: every stage of every example model has classified marks, on any number
//! of threads.

use std::path::{Path, PathBuf};

use ligne::drawing::{Mark, Page, Unit};
use ligne::light;
use ligne::lines;
use ligne::mesh::Mesh;
use ligne::pipeline::{Renderer, Stage};
use ligne::view::View;
use ligne::{Camera, Drawing, Scene, Style, SvgOptions};

use crate::library::support::pipeline::REFINEMENT_TOLERANCE_PX;

const MODELS: [&str; 7] =
    ["bear.ply", "bracket.stl", "castle.obj", "gear.obj", "knot.ply", "pump.glb", "teapot.obj"];

fn model(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)
}

fn open_with_camera(name: &str) -> (Scene, Camera) {
    let scene = Scene::open(model(name)).expect("an example model");
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    (scene, camera)
}

fn drawn(name: &str, style: &Style, stage: Stage) -> Drawing {
    let (scene, camera) = open_with_camera(name);
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
    Renderer::new(&scene, style).draw_stage(&camera, page, Some(stage)).unwrap().0
}

fn marks(drawing: &Drawing) -> impl Iterator<Item = &Mark> {
    drawing.layers.iter().flat_map(|layer| &layer.marks)
}

fn count_class(drawing: &Drawing, class: &str) -> usize {
    marks(drawing).filter(|mark| mark.provenance.classes.contains(&class)).count()
}

#[test]
fn every_stage_of_every_example_model_is_drawn() {
    let style = Style::load("suggestive").expect("a built-in style");
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
fn stage_drawings_do_not_depend_on_thread_count() {
    let style = Style::load("suggestive").expect("a built-in style");
    let with = |threads: usize, stage: Stage| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| drawn("bear.ply", &style, stage).to_svg(&SvgOptions::default()))
    };
    for stage in Stage::ALL {
        assert!(with(1, stage) == with(2, stage), "{}", stage.name());
    }
}

#[test]
fn field_stage_draws_facing_bands_and_the_zero_set() {
    let style = Style::default();
    let bear = drawn("bear.ply", &style, Stage::Field);
    assert_eq!(count_class(&bear, "zero-set"), 1);
    assert!(count_class(&bear, "facing") > 50 && count_class(&bear, "flat") == 0);
    let gear = drawn("gear.obj", &style, Stage::Field);
    assert!(count_class(&gear, "flat") > 0 && count_class(&gear, "zero-set") == 0);
    let svg = bear.to_svg(&SvgOptions::default());
    assert!(svg.contains("<title>n·v 0.8 to 1.0</title></path>"));
}

#[test]
fn surfaces_are_cut_exactly_at_traced_contours() {
    let (scene, camera) = open_with_camera("bear.ply");
    let options = &Style::default().lines;
    let surface = lines::Surface::new(Mesh::build(scene.to_soup()), options)
        .finer_for(&camera, REFINEMENT_TOLERANCE_PX);
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
fn zeros_stage_has_forward_backward_and_witness_marks() {
    let knot = drawn("knot.ply", &Style::default(), Stage::Zeros);
    assert!(count_class(&knot, "forward") > 0 && count_class(&knot, "backward") > 0);
    assert!(count_class(&knot, "witness") > 0);
}

#[test]
fn strengths_stage_names_the_step_of_each_crease() {
    let pump = drawn("pump.glb", &Style::default(), Stage::Strengths);
    let notes: Vec<&str> = marks(&pump).filter_map(|mark| mark.provenance.note.as_deref()).collect();
    assert!(notes.contains(&"crease that turns by 90 to 120 degrees"), "{notes:?}");
    let style = Style::load("suggestive").expect("a built-in style");
    assert!(count_class(&drawn("bear.ply", &style, Stage::Strengths), "suggestive") > 1);
}

#[test]
fn removed_stage_is_empty_without_tidying() {
    let pump = drawn("pump.glb", &Style::default(), Stage::Removed);
    let (removed, noted) =
        (count_class(&pump, "removed"), marks(&pump).filter(|m| m.provenance.note.is_some()).count());
    assert!(removed > 0);
    assert_eq!(removed, noted);
    let sets = ["chain.tidy=0".to_owned(), "lines.contours=mesh".to_owned()];
    let plain = Style::load_with("ink", &sets).expect("a built-in style");
    assert_eq!(count_class(&drawn("pump.glb", &plain, Stage::Removed), "removed"), 0);
}
