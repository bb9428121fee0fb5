//! Patterns over tones: they lie in their tone and nowhere else, as dense and as turned as they are asked for.

use std::f64::consts::PI;

use glam::DVec3;
use kurbo::{Point, Shape};
use ligne::drawing::{Drawing, LayerKind, Mark, Page, Paint, Unit};
use ligne::math::function::{cos, sin};
use ligne::render::{render, render_reported};
use ligne::scene::{Camera, Material, Scene};
use ligne::style::Style;

use crate::support::ink::{flattened, samples};
use crate::support::pipeline::{self, orthographic};
use crate::support::segments::length;
use crate::support::solids::cuboid;

fn style(patterns: &str) -> Style {
    let sets = [format!("fills.pattern=[{patterns}]")];
    Style::load("toon", &sets).unwrap_or_else(|error| panic!("{error}"))
}

fn marks(drawing: &Drawing, kind: LayerKind) -> Vec<&Mark> {
    drawing.layers.iter().filter(|layer| layer.kind == kind).flat_map(|layer| &layer.marks).collect()
}

/// A cube of 4 units, seen from in front on 500 px.
fn wall() -> (Scene, Camera) {
    let mut scene = pipeline::scene([cuboid(DVec3::splat(-2.0), DVec3::splat(2.0))]);
    scene.materials = vec![Material { name: "wall".to_owned(), ..Material::default() }];
    scene.geometries[0].material = Some(0);
    let mut camera = orthographic(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 5.0);
    (camera.width, camera.height) = (500.0, 500.0);
    (scene, camera)
}

#[test]
fn patterns_lie_in_their_tone_and_nowhere_else() {
    let scene = Scene::open("examples/models/castle.obj").unwrap();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let patterns = "{ material = 'stone', tones = [0], kind = 'lines', size = 5, angle = 30 }, \
                    { material = 'roof', tones = [-1], kind = 'crosses', size = 7 }, \
                    { material = 'grass', kind = 'tile', path = 'M2 8L5 2L8 8', size = 11, angle = 10 }, \
                    { material = 'sand*', tones = [1], kind = 'lines', fixed = 'surface', size = 6 }";
    let drawing = render(&scene, &camera, &style(patterns)).unwrap();
    let fills = marks(&drawing, LayerKind::Fills);
    // What is painted on top at a place.
    let at = |p: Point| fills.iter().rev().find(|fill| fill.path.contains(p)).map(|fill| &fill.provenance);
    let mut asked = [0; 4];
    let of =
        |name: &str| ["stone", "roof", "grass", "sandstone"].iter().position(|own| *own == name).unwrap();
    for mark in marks(&drawing, LayerKind::Hatching) {
        assert_eq!(mark.provenance.classes, ["pattern"]);
        let name = mark.provenance.material.as_deref().unwrap();
        for (p, _) in samples(&flattened(&mark.path, 0.05), 25.0) {
            // Painted borders are fitted, and reach a little under their neighbours.
            let near = [(0., 0.), (1.2, 0.), (-1.2, 0.), (0., 1.2), (0., -1.2)];
            let tone = [Some(0), Some(1), None, Some(1)][of(name)];
            let fits = near.iter().any(|(x, y)| {
                at(p + kurbo::Vec2::new(*x, *y)).is_some_and(|fill| {
                    fill.material.as_deref() == Some(name) && tone.is_none_or(|tone| fill.tone == Some(tone))
                })
            });
            assert!(fits, "{name} {p:?}");
            asked[of(name)] += 1;
        }
    }
    assert!(asked.iter().all(|count| *count > 30), "{asked:?}");
}

#[test]
fn dots_and_lines_are_as_dense_and_as_turned_as_asked() {
    let (scene, camera) = wall();
    let side = 400.0;
    let drawing = render(&scene, &camera, &style("{ size = 10, width = 6, angle = 20 }")).unwrap();
    let dots = marks(&drawing, LayerKind::Hatching);
    let inked: f64 = dots.iter().map(|mark| mark.path.area().abs()).sum();
    let wanted = PI * 9.0 / 100.0 * side * side;
    assert!((inked / wanted - 1.0).abs() < 0.01, "{inked} {wanted}");
    for angle in [0.0_f64, 25.0, 90.0, -60.0] {
        let pattern = format!("{{ kind = 'lines', size = 8, width = 2, angle = {angle} }}");
        let drawing = render(&scene, &camera, &style(&pattern)).unwrap();
        let lines: Vec<[Point; 2]> = marks(&drawing, LayerKind::Hatching)
            .iter()
            .flat_map(|mark| flattened(&mark.path, 0.01))
            .collect();
        assert!((length(&lines) * 8.0 / (side * side) - 1.0).abs() < 0.02, "{angle}");
        for [a, b] in lines {
            // Counter-clockwise as the page is seen, y down.
            let along = (b - a).normalize();
            let turn = kurbo::Vec2::new(cos(angle.to_radians()), -sin(angle.to_radians()));
            assert!(along.cross(turn).abs() < 1e-6, "{angle}");
            let row = a.to_vec2().dot(kurbo::Vec2::new(turn.y, -turn.x)) / 8.0;
            assert!((row - row.round()).abs() < 1e-6, "lines keep their place on the page");
        }
    }
}

#[test]
fn sizes_may_be_millimetres() {
    let (scene, mut camera) = wall();
    (camera.width, camera.height) = (100.0, 100.0);
    let page = Page { width: 100.0, height: 100.0, unit: Unit::Mm, background: None };
    let of = |pattern: &str| {
        let (drawing, _) = render_reported(&scene, &camera, &style(pattern), page, None).unwrap();
        let lines: Vec<[Point; 2]> = marks(&drawing, LayerKind::Hatching)
            .iter()
            .flat_map(|mark| flattened(&mark.path, 0.01))
            .collect();
        let widths: Vec<f64> = marks(&drawing, LayerKind::Hatching)
            .iter()
            .filter_map(|mark| match &mark.paint {
                Paint::Stroke(stroke) => Some(stroke.width),
                _ => None,
            })
            .collect();
        (length(&lines), widths[0])
    };
    let (lines, width) = of("{ kind = 'lines', size = '2mm', width = '0.3mm' }");
    assert!((lines - 80.0 * 40.0).abs() < 100.0 && (width - 0.3).abs() < 1e-9, "{lines} {width}");
}

#[test]
fn what_is_fixed_to_the_surface_turns_with_it_and_what_is_fixed_to_the_page_does_not() {
    let (scene, camera) = wall();
    let count = |camera: &Camera, fixed: &str| {
        let pattern = format!("{{ kind = 'lines', size = 21, fixed = '{fixed}' }}");
        let drawing = render(&scene, camera, &style(&pattern)).unwrap();
        let marks = marks(&drawing, LayerKind::Hatching);
        marks
            .iter()
            .flat_map(|mark| mark.path.elements())
            .filter(|e| matches!(e, kurbo::PathEl::MoveTo(_)))
            .count()
    };
    // Rolled about the line of sight: the same face, turned on the page.
    let rolled = Camera { up: DVec3::new(0.4, 1.0, 0.0).normalize(), ..camera };
    assert_eq!(count(&camera, "surface"), count(&rolled, "surface"));
    assert!(count(&rolled, "page") > count(&camera, "page") + 3);
}

#[test]
fn patterns_that_cannot_be_are_refused_by_name() {
    for (pattern, word) in [
        ("{ kind = 'spots' }", "kind"),
        ("{ size = 0 }", "size above 0"),
        ("{ kind = 'tile', path = 'M0 0 Q' }", "tile"),
        ("{ kind = 'tile', path = '' }", "no lines"),
        ("{ opacity = 2 }", "from 0 to 1"),
        ("{ tone = [1] }", "tones"),
    ] {
        let error = Style::load("toon", &[format!("fills.pattern=[{pattern}]")]).unwrap_err().to_string();
        assert!(error.contains(word), "{pattern}: {error}");
    }
}
