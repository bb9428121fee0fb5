//! Joints between flush parts of one material: without them, the parts are drawn exactly as their geometric
//! union.

use std::collections::BTreeMap;
use std::fmt::Write;

use glam::{DQuat, DVec3};
use kurbo::Point;
use ligne::drawing::{Drawing, LayerKind};
use ligne::load::ModelFormat;
use ligne::pipeline::render;
use ligne::scene::{Camera, NamedView, Projection, Scene, UpAxis};
use ligne::style::Style;

use crate::library::support::measures::line_picture::{SegmentGrid, sample_segments};
use crate::library::support::references::drawing_judge::centre_line;
use crate::library::support::scenes::random_dice::Dice;

/// Largest distance that lines may move, px.
const TOLERANCE_PX: f64 = 0.06;
/// Largest total length that may differ, px. Corners may be slightly rounder.
const SLACK_PX: f64 = 0.5;
/// Distance between sample points along lines, px.
const STEP_PX: f64 = 0.25;
const SCENE_COUNT: u64 = 15;

/// A polygon mesh with one material.
#[derive(Clone)]
struct Body {
    corners: Vec<DVec3>,
    faces: Vec<Vec<usize>>,
    material: &'static str,
}

/// An outline in x and z, extruded along y. It is counter-clockwise if `front` is the nearer y.
fn prism(outline: &[[f64; 2]], [front, back]: [f64; 2]) -> Body {
    let count = outline.len();
    let corners =
        [front, back].into_iter().flat_map(|y| outline.iter().map(move |[x, z]| DVec3::new(*x, y, *z)));
    let mut faces = vec![(0..count).collect(), (count..2 * count).rev().collect()];
    faces.extend((0..count).map(|a| {
        let b = (a + 1) % count;
        vec![a, count + a, count + b, b]
    }));
    Body { corners: corners.collect(), faces, material: "stone" }
}

fn block(low: [f64; 3], high: [f64; 3]) -> Body {
    prism(&[[low[0], low[2]], [high[0], low[2]], [high[0], high[2]], [low[0], high[2]]], [low[1], high[1]])
}

/// A rectangle in x and z.
fn sheet(low: [f64; 2], high: [f64; 2]) -> Body {
    let corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
    let corners = corners.map(|[x, z]| DVec3::new(x, 0.0, z)).to_vec();
    Body { corners, faces: vec![(0..4).collect()], material: "stone" }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum NumberFormat {
    Exact,
    Single,
    SixDecimals,
}

/// Writes bodies as an OBJ file with one part each, and reads it.
fn scene(bodies: &[Body], place: impl Fn(DVec3) -> DVec3, numbers: NumberFormat) -> Scene {
    let mut text = String::new();
    let mut first = 1;
    for (number, body) in bodies.iter().enumerate() {
        let _ = writeln!(text, "o body-{number}\nusemtl {}", body.material);
        for corner in &body.corners {
            let [x, y, z] = place(*corner).to_array().map(|x| match numbers {
                NumberFormat::Exact => format!("{x:?}"),
                NumberFormat::Single => (x as f32).to_string(),
                NumberFormat::SixDecimals => format!("{x:.6}"),
            });
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in &body.faces {
            let ids: Vec<String> = face.iter().map(|v| (first + v).to_string()).collect();
            let _ = writeln!(text, "f {}", ids.join(" "));
        }
        first += body.corners.len();
    }
    Scene::from_bytes(text.as_bytes(), ModelFormat::Obj).unwrap()
}

/// Returns the lines of a drawing, grouped by visible or hidden and by silhouette or inside.
///
/// Pens would differ: the foot of a box on a wider box is a contour of the box, but a crease of the union.
fn lines(drawing: &Drawing) -> BTreeMap<String, Vec<[Point; 2]>> {
    let mut lines: BTreeMap<String, Vec<[Point; 2]>> = BTreeMap::new();
    let layers = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
    for mark in layers.flat_map(|layer| &layer.marks) {
        let seen = if mark.provenance.invisibility == 0 { "seen" } else { "hidden" };
        let is_silhouette = mark.provenance.classes.contains(&"silhouette");
        let name = format!("{seen} {}", if is_silhouette { "silhouette" } else { "inside" });
        lines.entry(name).or_default().extend(centre_line(mark));
    }
    lines
}

/// Describes the lines that only one of two drawings has, with their lengths. Returns `None` if the drawings
/// agree.
fn difference(one: &Drawing, two: &Drawing) -> Option<String> {
    let (one, two) = (lines(one), lines(two));
    let mut said = String::new();
    for (what, of, by) in [("gone", &one, &two), ("new", &two, &one)] {
        for (name, lines) in of {
            let ink = SegmentGrid::new(by.get(name).cloned().unwrap_or_default(), 4.0);
            let far: Vec<(Point, f64)> = sample_segments(lines, STEP_PX)
                .into_iter()
                .filter(|(p, _)| ink.distance(*p) > TOLERANCE_PX)
                .collect();
            let length: f64 = far.iter().map(|(_, share)| share).sum();
            if length > SLACK_PX {
                let _ = write!(said, "{what}: {length:.1} px, {name}, at {:?}; ", far[0].0);
            }
        }
    }
    (!said.is_empty()).then_some(said)
}

/// A style that draws hidden lines and moves no corners.
fn style(name: &str, joints: bool) -> Style {
    let exact =
        ["lines.hidden=solid", "chain.smooth=0", "chain.simplify=0", "chain.tidy=0", "chain.fit=false"];
    let mut set = exact.map(str::to_owned).to_vec();
    set.push(format!("lines.joints={joints}"));
    Style::load_with(name, &set).unwrap()
}

/// Returns random parts, and their union as one body.
fn parts_and_union(dice: &mut Dice, kind: usize) -> (Vec<Body>, Body) {
    let steps = |dice: &mut Dice, count: usize| -> Vec<f64> {
        let ways = (0..count).map(|k| if k == 0 { 0.0 } else { dice.between(0.4, 2.0) });
        ways.scan(0.0, |at, way| {
            *at += way;
            Some(*at)
        })
        .collect()
    };
    let depth = dice.between(0.3, 1.5);
    match kind {
        // A row of boxes of equal height. In kind 1 they overlap.
        0 | 1 => {
            let count = 3 + dice.below(4);
            let (at, height) = (steps(dice, count), dice.between(0.5, 2.0));
            let mut over = || if kind == 0 { 0.0 } else { dice.between(0.05, 0.35) };
            let boxes: Vec<Body> =
                at.windows(2).map(|x| block([x[0], 0.0, 0.0], [x[1] + over(), depth, height])).collect();
            let end = boxes.iter().flat_map(|body| &body.corners).map(|p| p.x).fold(0.0, f64::max);
            (boxes, block([0.0; 3], [end, depth, height]))
        }
        // A brick wall whose courses have joints at random places.
        2 => {
            let (length, courses) = (6.0, 2 + dice.below(3));
            let mut bricks = Vec::new();
            let mut z = 0.0;
            for _ in 0..courses {
                let top = z + dice.between(0.4, 1.0);
                let count = 2 + dice.below(4);
                let mut ends = steps(dice, count);
                ends.retain(|x| *x < length - 0.2);
                ends.push(length);
                bricks.extend(ends.windows(2).map(|x| block([x[0], 0.0, z], [x[1], depth, top])));
                z = top;
            }
            (bricks, block([0.0; 3], [length, depth, z]))
        }
        // Two crossing bars.
        3 => {
            let [a, b, c] = [0, 1, 2].map(|_| dice.between(0.3, 2.0));
            let [d, e, f] = [0, 1, 2].map(|_| dice.between(0.3, 1.5));
            let bars = vec![
                block([0.0, 0.0, d], [a + b + c, depth, d + e]),
                block([a, 0.0, 0.0], [a + b, depth, d + e + f]),
            ];
            let [x, z] = [[0.0, a, a + b, a + b + c], [0.0, d, d + e, d + e + f]];
            let plus = [
                [x[1], z[0]],
                [x[2], z[0]],
                [x[2], z[1]],
                [x[3], z[1]],
                [x[3], z[2]],
                [x[2], z[2]],
                [x[2], z[3]],
                [x[1], z[3]],
                [x[1], z[2]],
                [x[0], z[2]],
                [x[0], z[1]],
                [x[1], z[1]],
            ];
            (bars, prism(&plus, [0.0, depth]))
        }
        // Columns of different heights on a plinth that is longer than each of them.
        _ => {
            let count = 3 + dice.below(3);
            let at = steps(dice, count);
            let end = at[at.len() - 1];
            let mut boxes = vec![block([0.0; 3], [end, depth, 0.5])];
            let mut outline = vec![[0.0, 0.0], [end, 0.0]];
            for x in at.windows(2).rev() {
                let top = 0.5 + dice.between(0.3, 2.5);
                boxes.push(block([x[0], 0.0, 0.5], [x[1], depth, top]));
                outline.extend([[x[1], top], [x[0], top]]);
            }
            (boxes, prism(&outline, [0.0, depth]))
        }
    }
}

#[test]
fn without_joints_parts_are_drawn_as_their_union() {
    let mut wrong = Vec::new();
    let mut drawn = 0;
    for number in 0..SCENE_COUNT {
        let mut dice = Dice::new(number);
        let (parts, union) = parts_and_union(&mut dice, number as usize % 5);
        let turn = DQuat::from_axis_angle(dice.direction(), dice.between(0.0, 3.0));
        let away = dice.point(5.0);
        for turned in [false, true] {
            let place = |p: DVec3| if turned { turn * p + away } else { p };
            let whole = scene(std::slice::from_ref(&union), place, NumberFormat::Exact);
            let iso = Camera::named(NamedView::Iso, UpAxis::Z).with_frame(600.0, 600.0);
            // In perspective from a corner, from a random direction, and along the faces.
            let target = place(DVec3::new(2.0, 0.5, 0.7));
            let towards = |eye: DVec3, up: DVec3| {
                let projection = Projection::Orthographic { height: 9.0 };
                Camera { eye: target + 20.0 * eye, target, up, projection, ..iso }
            };
            let own = |v: DVec3| if turned { turn * v } else { v };
            let cameras = [
                iso.fit(&whole),
                towards(dice.direction(), dice.direction()),
                towards(own(DVec3::NEG_Y), own(DVec3::Z)),
                towards(own(DVec3::Z), own(DVec3::Y)),
            ];
            for (view, camera) in cameras.iter().enumerate() {
                for name in ["ink", "flat"] {
                    let reference = render(&whole, camera, &style(name, true)).unwrap();
                    for numbers in [NumberFormat::Exact, NumberFormat::Single, NumberFormat::SixDecimals] {
                        drawn += 1;
                        let joined = render(&scene(&parts, place, numbers), camera, &style(name, false));
                        if let Some(said) = difference(&reference, &joined.unwrap()) {
                            wrong.push(format!(
                                "scene {number}, {turned}, view {view}, {name}, {numbers:?}: {said}"
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {drawn} differ\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn without_joints_sheets_are_drawn_as_one() {
    // A long sheet above two short ones; one of these is wound the other way in the second round.
    let mut parts =
        vec![sheet([0.0, 1.0], [4.0, 2.0]), sheet([0.0, 0.0], [1.5, 1.0]), sheet([1.5, 0.0], [4.0, 1.0])];
    let whole = scene(&[sheet([0.0, 0.0], [4.0, 2.0])], |p| p, NumberFormat::Exact);
    let camera = Camera::named(NamedView::Iso, UpAxis::Z).with_frame(600.0, 600.0).fit(&whole);
    for is_turned in [false, true] {
        if is_turned {
            parts[1].faces[0].reverse();
        }
        let reference = render(&whole, &camera, &style("ink", true)).unwrap();
        let joined =
            render(&scene(&parts, |p| p, NumberFormat::Exact), &camera, &style("ink", false)).unwrap();
        assert_eq!(difference(&reference, &joined), None);
    }
}

#[test]
fn edges_that_are_no_joints_stay() {
    let long = block([0.0; 3], [3.0, 1.0, 1.0]);
    let beside = block([3.0, 0.0, 0.0], [5.0, 1.0, 1.0]);
    let painted = Body { material: "wood", ..beside.clone() };
    // The front leans by half a degree, or stands slightly back.
    let mut leaning = beside.clone();
    for corner in leaning.corners.iter_mut().filter(|p| p.x > 4.0 && p.y < 0.5) {
        corner.y += 0.02;
    }
    let back = block([3.0, 0.002, 0.0], [5.0, 1.0, 1.0]);
    let apart = block([3.002, 0.0, 0.0], [5.0, 1.0, 1.0]);
    for (what, other) in [("paint", painted), ("leaning", leaning), ("back", back), ("apart", apart)] {
        let scene = scene(&[long.clone(), other], |p| p, NumberFormat::Exact);
        // Only the front is compared, because the other sides are flush.
        let front = Camera::named(NamedView::Front, UpAxis::Z).with_frame(600.0, 600.0).fit(&scene);
        let [with, without] =
            [true, false].map(|joints| render(&scene, &front, &style("ink", joints)).unwrap());
        let seen = |drawing: &Drawing| -> f64 {
            let own = lines(drawing).into_iter().filter(|(name, _)| name.starts_with("seen"));
            own.flat_map(|(_, lines)| lines).map(|[a, b]| (b - a).hypot()).sum()
        };
        let [with, without] = [seen(&with), seen(&without)];
        assert!((with - without).abs() < 1.0, "{what}: {with} px, {without} px without joints");
    }
}

#[test]
fn fills_do_not_depend_on_joints() {
    let parts = [block([0.0; 3], [3.0, 1.0, 1.0]), block([3.0, 0.0, 0.0], [5.0, 1.0, 1.0])];
    let scene = scene(&parts, |p| p, NumberFormat::Exact);
    let camera = Camera::named(NamedView::Iso, UpAxis::Z).with_frame(600.0, 600.0).fit(&scene);
    for name in ["flat", "toon"] {
        let fills = |joints: bool| {
            let drawing = render(&scene, &camera, &style(name, joints)).unwrap();
            let layers = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Fills);
            layers.flat_map(|layer| &layer.marks).map(|mark| mark.path.to_svg()).collect::<Vec<_>>()
        };
        let kept = fills(true);
        assert!(!kept.is_empty());
        assert_eq!(kept, fills(false), "{name}");
    }
}

#[test]
fn equal_materials_listed_twice_count_as_one() {
    let mut scene = scene(
        &[
            block([0.0; 3], [3.0, 1.0, 1.0]),
            Body { material: "wood", ..block([3.0, 0.0, 0.0], [5.0, 1.0, 1.0]) },
        ],
        |p| p,
        NumberFormat::Exact,
    );
    let camera = Camera::named(NamedView::Iso, UpAxis::Z).with_frame(600.0, 600.0).fit(&scene);
    let count = |scene: &Scene| {
        let drawing = render(scene, &camera, &style("ink", false)).unwrap();
        lines(&drawing).values().flatten().map(|[a, b]| (*b - *a).hypot()).sum::<f64>()
    };
    let two = count(&scene);
    scene.materials[1] = scene.materials[0].clone();
    assert!(count(&scene) < two - 50.0);
}
