//! Coplanar surfaces of different materials: visible areas and lines in the overlap, compared with closed
//! forms.

use glam::{DMat3, DVec3};
use kurbo::{BezPath, Point, Shape};
use ligne::drawing::Drawing;
use ligne::scene::Camera;
use ligne::{Scene, Style, render};

use crate::library::support::measures::line_picture::{flatten_path, nearest_parameter};
use crate::library::support::pipeline::{orthographic, perspective};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::random_dice::Dice;

const COLOURS: &str =
    "newmtl grey\nKd 0.6 0.6 0.6\nnewmtl red\nKd 0.9 0.1 0.1\nnewmtl blue\nKd 0.1 0.1 0.9\n";

/// A square with a material, its lowest corner, its side, and whether it is a separate part.
struct Square {
    material: &'static str,
    at: [f64; 2],
    side: f64,
    own_part: bool,
}

impl Square {
    const fn new(material: &'static str, at: [f64; 2], side: f64) -> Self {
        Self { material, at, side, own_part: false }
    }

    fn corners(&self) -> [DVec3; 4] {
        let [x, y] = self.at;
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(u, v)| DVec3::new(x + u * self.side, y + v * self.side, 0.0))
    }
}

/// Rounding of the coordinates in a file.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Rounding {
    Exact,
    SixDecimals,
    Single,
}

/// Writes the rotated squares as an OBJ file and reads it.
fn squares_scene(squares: &[Square], turn: DMat3, rounding: Rounding) -> Scene {
    let mut text = String::from("mtllib colours.mtl\no first\n");
    for (k, square) in squares.iter().enumerate() {
        if square.own_part {
            text += &format!("o part{k}\n");
        }
        text += &format!("usemtl {}\n", square.material);
        for p in square.corners() {
            let p = turn * p;
            text += &match rounding {
                Rounding::Exact => format!("v {} {} {}\n", p.x, p.y, p.z),
                Rounding::SixDecimals => format!("v {:.6} {:.6} {:.6}\n", p.x, p.y, p.z),
                Rounding::Single => format!("v {} {} {}\n", p.x as f32, p.y as f32, p.z as f32),
            };
        }
        text += "f -4 -3 -2 -1\n";
    }
    ligne::load::obj::read_bytes(text.as_bytes(), "squares", |_| Some(COLOURS.into())).expect("a model")
}

/// Flat colours without light. Regions end at their borders.
fn flat_style() -> Style {
    let sets = ["fills.seams='exact'".to_owned()];
    Style::load_with("flat", &sets).expect("a style")
}

/// Returns the area painted in a material.
fn painted(drawing: &Drawing, material: &str) -> f64 {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let own = marks.filter(|mark| {
        mark.provenance.tone.is_some() && mark.provenance.material.as_deref() == Some(material)
    });
    own.map(|mark| mark.path.area().abs()).sum()
}

/// Returns the lines of a class.
fn lines(drawing: &Drawing, class: &str) -> Vec<[Point; 2]> {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let own = marks.filter(|mark| mark.provenance.classes.first() == Some(&class));
    own.flat_map(|mark| flatten_path(&mark.path, 1e-3)).collect()
}

fn length(lines: &[[Point; 2]]) -> f64 {
    lines.iter().map(|[a, b]| (*b - *a).hypot()).sum()
}

/// Returns the image of a polygon.
fn image(eye: &TextbookCamera, turn: DMat3, corners: &[DVec3]) -> BezPath {
    let mut path = BezPath::new();
    for (k, corner) in corners.iter().enumerate() {
        let p = eye.project(turn * *corner);
        if k == 0 { path.move_to(p) } else { path.line_to(p) }
    }
    path.close_path();
    path
}

fn perimeter(path: &BezPath) -> f64 {
    path.segments()
        .map(|s| (kurbo::PathSeg::as_path_el(&s), s))
        .map(|(_, s)| kurbo::ParamCurveArclen::arclen(&s, 1e-6))
        .sum()
}

/// Cameras on both sides, at least about three degrees away from the plane.
fn cameras(count: usize, turn: DMat3, middle: DVec3) -> Vec<Camera> {
    let mut dice = Dice::new(57);
    let mut cameras = Vec::new();
    while cameras.len() < count {
        let way = dice.direction();
        if way.z.abs() < 0.05 {
            continue;
        }
        let (eye, target) = (turn * (middle + way * 90.0), turn * middle);
        cameras.push(if cameras.len() % 3 == 0 {
            perspective(eye, target, 45.0)
        } else {
            orthographic(eye, target, 60.0)
        });
    }
    cameras
}

fn rotations() -> [DMat3; 2] {
    [DMat3::IDENTITY, DMat3::from_axis_angle(DVec3::new(0.36, -0.48, 0.8), 0.7)]
}

#[test]
fn a_coplanar_label_is_fully_visible_from_all_sides() {
    for own_part in [false, true] {
        for turn in rotations() {
            for rounding in [Rounding::Exact, Rounding::SixDecimals, Rounding::Single] {
                let wall = Square::new("grey", [0.0, 0.0], 40.0);
                let label = Square { own_part, ..Square::new("red", [12.0, 8.0], 12.0) };
                let squares = [wall, label];
                let scene = squares_scene(&squares, turn, rounding);
                for camera in cameras(6, turn, DVec3::new(20.0, 20.0, 0.0)) {
                    let drawing = render(&scene, &camera, &flat_style()).expect("a drawing");
                    let eye = TextbookCamera::new(&camera);
                    let [wall, label] = [0, 1].map(|k| image(&eye, turn, &squares[k].corners()));
                    let said = format!("{own_part} {rounding:?} {:?}", camera.eye);
                    let red = painted(&drawing, "red") / label.area().abs();
                    assert!((red - 1.0).abs() < 1e-3, "{red} of the label, {said}");
                    let grey = painted(&drawing, "grey") / (wall.area().abs() - label.area().abs());
                    assert!((grey - 1.0).abs() < 1e-3, "{grey} of the wall, {said}");
                    for (class, outline) in [("material", &label), ("border", &wall)] {
                        let off = length(&lines(&drawing, class)) - perimeter(outline);
                        assert!(off.abs() < 0.5, "{class} is {off} px too long, {said}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_smaller_coplanar_surface_wins_then_the_later_one() {
    let camera = orthographic(DVec3::new(20.0, 30.0, 90.0), DVec3::new(20.0, 20.0, 0.0), 60.0);
    let eye = TextbookCamera::new(&camera);
    let share = |squares: &[Square], material: &str, of: usize| {
        let drawing =
            render(&squares_scene(squares, DMat3::IDENTITY, Rounding::Exact), &camera, &flat_style())
                .unwrap();
        painted(&drawing, material) / image(&eye, DMat3::IDENTITY, &squares[of].corners()).area().abs()
    };
    let first = [Square::new("red", [12.0, 8.0], 12.0), Square::new("grey", [0.0, 0.0], 40.0)];
    assert!((share(&first, "red", 0) - 1.0).abs() < 1e-3);
    // Squares that overlap by a quarter of their area.
    let equal =
        |first, second| [Square::new(first, [5.0, 5.0], 16.0), Square::new(second, [13.0, 13.0], 16.0)];
    for [a, b] in [["red", "blue"], ["blue", "red"]] {
        let squares = equal(a, b);
        assert!((share(&squares, b, 1) - 1.0).abs() < 1e-3, "{b} after {a}");
        assert!((share(&squares, a, 0) - 0.75).abs() < 1e-3, "{a} before {b}");
    }
}

#[test]
fn an_overhanging_label_has_borders_outside_the_wall_only() {
    for turn in rotations() {
        let squares = [Square::new("grey", [0.0, 0.0], 40.0), Square::new("red", [34.0, 10.0], 12.0)];
        let scene = squares_scene(&squares, turn, Rounding::SixDecimals);
        for camera in cameras(6, turn, DVec3::new(22.0, 20.0, 0.0)) {
            let drawing = render(&scene, &camera, &flat_style()).expect("a drawing");
            let eye = TextbookCamera::new(&camera);
            let at = |x: f64, y: f64| eye.project(turn * DVec3::new(x, y, 0.0));
            let span = |points: &[[f64; 2]]| -> f64 {
                points.windows(2).map(|p| (at(p[1][0], p[1][1]) - at(p[0][0], p[0][1])).hypot()).sum()
            };
            let inner = span(&[[40.0, 10.0], [34.0, 10.0], [34.0, 22.0], [40.0, 22.0]]);
            let outer = span(&[[40.0, 22.0], [46.0, 22.0], [46.0, 10.0], [40.0, 10.0]])
                + span(&[[40.0, 22.0], [40.0, 40.0], [0.0, 40.0], [0.0, 0.0], [40.0, 0.0], [40.0, 10.0]]);
            for (class, wanted) in [("material", inner), ("border", outer)] {
                let off = length(&lines(&drawing, class)) - wanted;
                assert!(off.abs() < 0.5, "{class} is {off} px too long from {:?}", camera.eye);
            }
            let red = painted(&drawing, "red") / image(&eye, turn, &squares[1].corners()).area().abs();
            assert!((red - 1.0).abs() < 1e-3, "{red} of the label");
        }
    }
}

#[test]
fn material_borders_on_a_flat_face_keep_their_corners() {
    // A square inset into a plane, with faces all around it.
    let text = "mtllib colours.mtl\nusemtl grey\nv 0 0 0\nv 40 0 0\nv 40 40 0\nv 0 40 0\nv 12 8 0\nv 24 8 0\nv 24 20 0\nv 12 20 0\n\
                f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nusemtl red\nf 5 6 7 8\n";
    let scene =
        ligne::load::obj::read_bytes(text.as_bytes(), "plate", |_| Some(COLOURS.into())).expect("a model");
    let corners = Square::new("red", [12.0, 8.0], 12.0).corners();
    for camera in cameras(24, DMat3::IDENTITY, DVec3::new(20.0, 20.0, 0.0)) {
        let drawing = render(&scene, &camera, &flat_style()).expect("a drawing");
        let eye = TextbookCamera::new(&camera);
        let marks = || drawing.layers.iter().flat_map(|layer| &layer.marks);
        let red = marks().filter(|mark| {
            mark.provenance.tone.is_some() && mark.provenance.material.as_deref() == Some("red")
        });
        let fill: Vec<[Point; 2]> = red.flat_map(|mark| flatten_path(&mark.path, 1e-3)).collect();
        for (name, lines) in [("line", lines(&drawing, "material")), ("fill", fill)] {
            for corner in corners {
                let p = eye.project(corner);
                let off = lines
                    .iter()
                    .map(|line| (nearest_point(p, *line) - p).hypot())
                    .fold(f64::INFINITY, f64::min);
                assert!(off < 0.1, "the corner of the {name} is {off} px off from {:?}", camera.eye);
            }
        }
    }
}

/// Returns the point of a segment nearest to `p`.
fn nearest_point(p: Point, segment: [Point; 2]) -> Point {
    segment[0].lerp(segment[1], nearest_parameter(p, segment))
}

#[test]
fn an_inset_block_has_a_material_line_around_its_top() {
    // A red block inside a grey one, with both tops in one plane.
    let mut text = String::from("mtllib colours.mtl\n");
    for (name, low, high) in
        [("grey", [0.0, 0.0, 0.0], [40.0, 40.0, 10.0]), ("red", [10.0, 12.0, 4.0], [30.0, 22.0, 10.0])]
    {
        text += &format!("o {name}\nusemtl {name}\n");
        for k in 0..8_usize {
            let side = |axis: usize, high_at: bool| if high_at { high[axis] } else { low[axis] };
            let (x, y) = (side(0, k % 4 == 1 || k % 4 == 2), side(1, k % 4 > 1));
            text += &format!("v {x} {y} {}\n", side(2, k > 3));
        }
        text += "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\n";
    }
    let scene =
        ligne::load::obj::read_bytes(text.as_bytes(), "blocks", |_| Some(COLOURS.into())).expect("a model");
    let top = [(10.0, 12.0), (30.0, 12.0), (30.0, 22.0), (10.0, 22.0)].map(|(x, y)| DVec3::new(x, y, 10.0));
    for way in [DVec3::new(0.5, -0.6, 0.6), DVec3::new(-0.7, 0.2, 0.3), DVec3::new(0.1, 0.2, 0.9)] {
        let camera =
            orthographic(DVec3::new(20.0, 20.0, 5.0) + way * 90.0, DVec3::new(20.0, 20.0, 5.0), 60.0);
        let drawing = render(&scene, &camera, &flat_style()).expect("a drawing");
        let rim = image(&TextbookCamera::new(&camera), DMat3::IDENTITY, &top);
        let red = painted(&drawing, "red") / rim.area().abs();
        assert!((red - 1.0).abs() < 1e-3, "{red} of the top from {way}");
        let off = length(&lines(&drawing, "material")) - perimeter(&rim);
        assert!(off.abs() < 0.5, "{off} px too long from {way}");
    }
}
