//! Models with rounded coordinates are drawn like the exact models.
//!
//! Scenes of known exact form are rotated and written at full precision, in single precision, and with six
//! decimals.

use std::fmt::Write;

use crate::library::support::rewriting::pens::LinesByPen;
use crate::library::support::scenes::random_dice::Dice;
use glam::{DQuat, DVec3};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::load::ModelFormat;
use ligne::pipeline::render;
use ligne::scene::{Camera, NamedView, Projection, Scene, UpAxis};
use ligne::style::Style;

/// Largest distance that lines may move, px.
const TOLERANCE_PX: f64 = 0.06;
/// Largest total length that may differ, px: the round ends of lines.
const SLACK_PX: f64 = 1.0;
const ROTATIONS_PER_SCENE: u64 = 12;

/// A part: its corners, and its faces as polygons.
type Body = (Vec<DVec3>, Vec<Vec<usize>>);

/// A flat outline extruded upwards.
fn prism(outline: &[[f64; 2]], height: f64) -> Body {
    let count = outline.len();
    let corners =
        [0.0, height].into_iter().flat_map(|z| outline.iter().map(move |[x, y]| DVec3::new(*x, *y, z)));
    let mut faces = vec![(count..2 * count).collect(), (0..count).rev().collect()];
    faces.extend((0..count).map(|a| {
        let b = (a + 1) % count;
        vec![a, b, count + b, count + a]
    }));
    (corners.collect(), faces)
}

fn block(low: [f64; 3], high: [f64; 3]) -> Body {
    let [x, y, z] = low;
    let [u, v, w] = high;
    let (corners, faces) = prism(&[[x, y], [u, y], [u, v], [x, v]], w - z);
    (corners.into_iter().map(|p| p + DVec3::Z * z).collect(), faces)
}

fn sheet(corners: [[f64; 3]; 4]) -> Body {
    (corners.map(DVec3::from_array).to_vec(), vec![vec![0, 1, 2, 3]])
}

fn scenes() -> Vec<(&'static str, Vec<Body>)> {
    let tee =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [2.0, 2.0], [2.0, 3.0], [-1.0, 3.0], [-1.0, 2.0], [0.0, 2.0]];
    let plus = [
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [3.0, 1.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, 3.0],
        [1.0, 3.0],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
        [1.0, 1.0],
    ];
    let stairs =
        [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 3.0], [0.0, 3.0]];
    vec![
        ("a tee", vec![prism(&tee, 1.5)]),
        ("a plus", vec![prism(&plus, 1.0)]),
        ("stairs", vec![prism(&stairs, 2.0)]),
        ("flush blocks", vec![block([0.0; 3], [3.0, 2.0, 2.0]), block([1.0, -1.0, 0.0], [2.0, 0.0, 2.0])]),
        (
            "a block on a block",
            vec![block([0.0; 3], [3.0, 3.0, 1.0]), block([0.0, 0.0, 1.0], [2.0, 1.0, 2.0])],
        ),
        (
            "a sheet on a block",
            vec![
                block([0.0; 3], [3.0, 3.0, 1.0]),
                sheet([[1.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 2.0, 1.0], [1.0, 2.0, 1.0]]),
            ],
        ),
        (
            "walls in a corner",
            vec![
                sheet([[0.0; 3], [3.0, 0.0, 0.0], [3.0, 2.0, 0.0], [0.0, 2.0, 0.0]]),
                sheet([[0.0; 3], [0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [3.0, 0.0, 0.0]]),
                sheet([[0.0; 3], [0.0, 2.0, 0.0], [0.0, 2.0, 1.0], [0.0, 0.0, 1.0]]),
            ],
        ),
    ]
}

/// An OBJ file of bodies, with each number formatted by `write`.
fn obj_scene(bodies: &[Body], turn: DQuat, move_by: DVec3, write: impl Fn(f64) -> String) -> Scene {
    let mut text = String::new();
    let mut first = 1;
    for (number, (corners, faces)) in bodies.iter().enumerate() {
        let _ = writeln!(text, "o body-{number}");
        for corner in corners {
            let [x, y, z] = (turn * *corner + move_by).to_array().map(&write);
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in faces {
            let ids: Vec<String> = face.iter().map(|v| (first + v).to_string()).collect();
            let _ = writeln!(text, "f {}", ids.join(" "));
        }
        first += corners.len();
    }
    Scene::from_bytes(text.as_bytes(), ModelFormat::Obj).unwrap()
}

#[test]
fn scenes_with_rounded_coordinates_are_drawn_like_exact_ones() {
    let mut wrong = Vec::new();
    let mut drawn = 0;
    for (name, bodies) in scenes() {
        let mut dice = Dice::new(name.len() as u64);
        for turn in 0..ROTATIONS_PER_SCENE {
            let mut number = || dice.between(-1.0, 1.0);
            let axis = DVec3::new(number(), number(), number()).normalize();
            let turned = DQuat::from_axis_angle(axis, 3.0 * number());
            let away = 5.0 * DVec3::new(number(), number(), number());
            let exact = obj_scene(&bodies, turned, away, |x| format!("{x:?}"));
            let camera = Camera::named(NamedView::Iso, UpAxis::Z).with_frame(800.0, 800.0);
            // Every second view is along the faces of the scene, rotated with it.
            let camera = if turn % 2 == 0 {
                camera.fit(&exact)
            } else {
                let (eye, up) = (turned * DVec3::NEG_Y, turned * DVec3::Z);
                let target = away + turned * DVec3::ONE;
                let projection = Projection::Orthographic { height: 8.0 };
                Camera { eye: target + 20.0 * eye, target, up, projection, ..camera }
            };
            for style in ["ink", "technical"] {
                let style = Style::preset(style).unwrap();
                // Where lines coincide in the image, such as edges of a sheet seen edge-on, any of them may
                // be drawn with the same pen.
                let pens = |scene: &Scene| LinesByPen::by_width(&render(scene, &camera, &style).unwrap());
                let reference = pens(&exact);
                let single = obj_scene(&bodies, turned, away, |x| (x as f32).to_string());
                let six = obj_scene(&bodies, turned, away, |x| format!("{x:.6}"));
                for (how, scene) in [("single precision", single), ("six decimals", six)] {
                    drawn += 1;
                    let difference = reference.difference(&pens(&scene), TOLERANCE_PX);
                    if difference.length() > SLACK_PX {
                        wrong.push(format!("{name}, turn {turn}, {how}: {difference}"));
                    }
                }
            }
        }
    }
    // Allowance for one thin inner contour along a plane seen edge-on: a plus in six decimals, in both
    // styles.
    assert!(wrong.len() <= 2, "{} of {drawn} differ\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn angles_at_the_crease_threshold_are_no_creases() {
    for sides in [6, 9, 12, 24] {
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / sides as f64;
        let outline: Vec<[f64; 2]> = (0..sides).map(|k| [5.0 * cos(angle(k)), 5.0 * sin(angle(k))]).collect();
        let body = [prism(&outline, 10.0)];
        let mut style = Style::preset("ink").unwrap();
        let creases = |style: &Style, write: fn(f64) -> String| {
            let scene = obj_scene(&body, DQuat::IDENTITY, DVec3::ZERO, write);
            let camera = Camera::named(NamedView::Front, UpAxis::Z).with_frame(800.0, 800.0).fit(&scene);
            let drawing = render(&scene, &camera, style).unwrap();
            let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
            marks.filter(|mark| mark.provenance.classes.contains(&"crease")).count()
        };
        let writers: [fn(f64) -> String; 3] =
            [|x| format!("{x:?}"), |x| (x as f32).to_string(), |x| format!("{x:.6}")];
        for write in writers {
            style.lines.crease_deg = 360.0 / sides as f64;
            assert_eq!(creases(&style, write), 0, "{sides} sides at the limit");
            style.lines.crease_deg -= 1.0;
            assert!(creases(&style, write) > 0, "{sides} sides above the limit");
        }
    }
}

/// A bumpy ball of irregular triangles. No two neighbours are coplanar.
fn bumpy_ball() -> Body {
    let mut dice = Dice::new(5);
    let mut corners: Vec<DVec3> = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|p| [p, -p]).collect();
    let mut faces: Vec<[usize; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..5 {
        let mut middles = std::collections::BTreeMap::new();
        let mut finer = Vec::with_capacity(4 * faces.len());
        for [a, b, c] in faces {
            let mut middle = |p: usize, q: usize| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    let at = dice.between(0.4, 0.6);
                    corners.push(corners[p.min(q)].lerp(corners[p.max(q)], at).normalize());
                    corners.len() - 1
                })
            };
            let [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
            finer.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
        }
        faces = finer;
    }
    let bumps = |p: DVec3| p * (1.0 + 0.12 * sin(5.0 * p.x + 1.0) * cos(4.0 * p.y) + 0.1 * sin(6.0 * p.z));
    (corners.into_iter().map(bumps).collect(), faces.into_iter().map(|face| face.to_vec()).collect())
}

/// On a curved surface, rounding decides whether a face near the contour is front-facing. That must not move
/// lines.
#[test]
fn contours_of_curved_surfaces_do_not_move_with_rounding() {
    let body = [bumpy_ball()];
    let style = Style::preset("ink").unwrap();
    let mut moved = 0.0;
    for azimuth in 0..12 {
        let turned = DQuat::from_axis_angle(DVec3::new(0.2, 0.3, 0.9).normalize(), 0.5 * f64::from(azimuth));
        let pens = |write: fn(f64) -> String| {
            let scene = obj_scene(&body, turned, DVec3::ZERO, write);
            let camera = Camera::named(NamedView::Iso, UpAxis::Z).with_frame(800.0, 800.0);
            let camera = camera.fit(&obj_scene(&body, turned, DVec3::ZERO, |x| format!("{x:?}")));
            LinesByPen::by_width(&render(&scene, &camera, &style).unwrap())
        };
        let exact = pens(|x| format!("{x:?}"));
        moved += exact.difference(&pens(|x| format!("{x:.5}")), 0.5).length();
    }
    // The ends of two lines differ, by 4.8 px.
    assert!(moved < 6.0, "{moved} px of lines differ in twelve drawings");
}
