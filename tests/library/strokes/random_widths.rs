//! Random line widths: each line has its own width within the range of the style, and the seed decides it.

use ligne::drawing::{LayerKind, Paint};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

/// Returns the mean width of each line of a drawing with 2 px pens and no taper.
fn widths(sets: &[&str]) -> Vec<f64> {
    let scene = Scene::open("examples/models/gear.obj").unwrap();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let pens = ["pen.width=2", "pen.contour.width=2", "pen.silhouette.width=2", "pen.crease.width=2"];
    let sets: Vec<String> = pens.iter().chain(sets).map(|set| (*set).to_owned()).collect();
    let drawing = render(&scene, &camera, &Style::load_with("ink", &sets).unwrap()).unwrap();
    let lines = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
    lines
        .flat_map(|layer| &layer.marks)
        .map(|mark| match &mark.paint {
            Paint::Stroke(stroke) => stroke.width,
            Paint::Outline(outline) => outline.width,
            Paint::Fill(_) | Paint::Gradient(_) | Paint::Image(_) => panic!("a line"),
        })
        .collect()
}

#[test]
fn each_line_has_a_random_width() {
    let even = widths(&[]);
    assert!(even.len() > 30 && even.iter().all(|width| (width - 2.0).abs() < 1e-9));
    let uneven = widths(&["pen.swell.chance=0.6"]);
    assert_eq!(uneven.len(), even.len());
    // Lines that continue each other meet in one width, so their ends may be slightly thinner or thicker.
    assert!(uneven.iter().all(|width| (0.79..=2.001).contains(width)), "{uneven:?}");
    let (thin, thick) = uneven.iter().partition::<Vec<f64>, _>(|width| **width < 1.4);
    assert!(thin.len() > even.len() / 5 && thick.len() > even.len() / 5, "{uneven:?}");
    assert_eq!(uneven, widths(&["pen.swell.chance=0.6"]));
    assert_ne!(uneven, widths(&["pen.swell.chance=0.6", "seed=5"]));
}

#[test]
fn random_width_combines_with_light_and_depth() {
    let [alone, with_others] =
        [&["pen.swell.chance=0.6"][..], &["pen.swell.chance=0.6", "pen.swell.near=0.5", "pen.swell.lit=0.5"]]
            .map(widths);
    assert!(alone.iter().zip(&with_others).all(|(a, b)| *b <= a + 1e-9));
    assert!(with_others.iter().sum::<f64>() < 0.8 * alone.iter().sum::<f64>());
}
