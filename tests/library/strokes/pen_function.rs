//! Pens chosen by a function: the properties of lines that it sees, and what becomes of the pens it changes.

use std::f64::consts::TAU;
use std::sync::{Arc, Mutex};

use glam::{DAffine3, DVec3};
use ligne::drawing::{Length, Paint};
use ligne::scene::{Geometry, NamedView, Projection, UpAxis};
use ligne::style::LineKind;
use ligne::{Camera, Scene, Style, render};

use crate::library::support::scenes::round_solids::octasphere;

/// A ball of radius 1 with a straight line in front of it, at 100 px for a unit.
fn ball_and_line() -> (Scene, Camera) {
    let ball = octasphere(5);
    let mut scene = Scene::new(UpAxis::Z);
    let geometry = Geometry::from_triangles(ball.positions, ball.triangles, None).unwrap();
    let geometry = scene.add_geometry(geometry);
    scene.add_part("ball", geometry, DAffine3::IDENTITY);
    scene.add_polyline("line", [[-1.5, -2.0, 0.0], [1.5, -2.0, 0.0]]);
    let camera = Camera::named(NamedView::Front, scene.up)
        .with_frame(400.0, 400.0)
        .fit(&scene)
        .with_projection(Projection::Orthographic { height: 4.0 })
        .look_at(DVec3::ZERO);
    (scene, camera)
}

#[test]
fn the_function_sees_lines_as_geometry_has_them() {
    let (scene, camera) = ball_and_line();
    let seen = Arc::new(Mutex::new(Vec::new()));
    let found = Arc::clone(&seen);
    let style = Style::load("ink").unwrap().with_pens(move |line, _| {
        let numbers = [line.length, line.curvature, line.depth, line.light];
        found.lock().unwrap().push((line.kind, line.part.to_owned(), line.closed, line.hidden, numbers));
    });
    render(&scene, &camera, &style).unwrap();
    let seen = seen.lock().unwrap();
    let (_, _, closed, hidden, [length, curvature, depth, light]) =
        seen.iter().find(|(kind, part, ..)| *kind == LineKind::Contour && part == "ball").unwrap();
    assert!(*closed && !*hidden && (length / (100.0 * TAU) - 1.0).abs() < 0.01, "{length}");
    assert!((curvature * 100.0 - 1.0).abs() < 0.02, "{curvature}");
    let (_, _, closed, hidden, line) = seen.iter().find(|(_, part, ..)| part == "line").unwrap();
    assert!(!*closed && !*hidden && (line[0] - 300.0).abs() < 0.01 && line[1] < 1e-9, "{line:?}");
    assert!(line[2] < *depth && (0.0..=1.0).contains(light), "{line:?} {depth} {light}");
}

#[test]
fn changed_pens_are_drawn_and_a_width_of_zero_draws_nothing() {
    let (scene, camera) = ball_and_line();
    let style = Style::load("ink").unwrap().with_pens(|line, pen| {
        pen.width = Length::px(if line.part == "line" { 7.0 } else { 0.0 });
    });
    let drawing = render(&scene, &camera, &style).unwrap();
    let marks: Vec<_> = drawing.layers.iter().flat_map(|layer| &layer.marks).collect();
    assert_eq!(marks.len(), 1);
    assert!(matches!(&marks[0].paint, Paint::Stroke(stroke) if (stroke.width - 7.0).abs() < 1e-9));
}

#[test]
fn a_key_set_later_keeps_the_function_and_the_scale() {
    let style = Style::load("ink").unwrap().to_scale().with_pens(|_, pen| pen.opacity = 0.5);
    let mut changed = style.clone();
    changed.set("lines.crease_deg", 50).unwrap();
    assert!(changed != style && changed.set("no.such", 1).is_err());
    assert_eq!(*changed.set("lines.crease_deg", style.lines.crease_deg).unwrap(), style);
}
