//! Creases, curved surfaces and rims by evidence (`lines.surfaces = "evidence"`), against solids with known
//! edges and circles.

use std::f64::consts::TAU;

use glam::DVec3;
use kurbo::Point;
use ligne::drawing::{Drawing, LayerKind};
use ligne::geometry::numbers::portable_math::{acos, cos, sin};
use ligne::load::ModelFormat;
use ligne::mesh::{DihedralCosines, Mesh, Soup};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use ligne::surface::Patches;
use ligne::surface::evidence::evidence_layout::patches_by_evidence;

use crate::library::support::measures::line_picture::{SegmentGrid, flatten_path};
use crate::library::support::pipeline::orthographic;
use crate::library::support::scenes::round_solids::globe;
use crate::library::support::scenes::solids::{Solid, cuboid, torus};

/// Radius and half height of the cylinders.
const SIZE: [f64; 2] = [1.0, 0.8];

/// OBJ text of a closed cylinder along z. Its side has the normals of a cylinder if `smooth`, those of its faces
/// otherwise.
fn cylinder(sides: u32, smooth: bool) -> String {
    let [radius, half] = SIZE;
    let mut text = String::new();
    let turn = |k: f64| TAU * k / f64::from(sides);
    for k in 0..sides {
        let (x, y) = (radius * cos(turn(f64::from(k))), radius * sin(turn(f64::from(k))));
        text += &format!("v {x} {y} {}\nv {x} {y} {half}\n", -half);
    }
    for k in 0..2 * sides {
        let at = turn(f64::from(k) / 2.0);
        text += &format!("vn {} {} 0\n", cos(at), sin(at));
    }
    text += "vn 0 0 1\nvn 0 0 -1\n";
    for k in 0..sides {
        let next = (k + 1) % sides;
        let [a, b] = [2 * k + 1, 2 * next + 1];
        // Normals at corners have even numbers, those between them odd ones.
        let [n, m] = if smooth { [2 * k + 1, 2 * next + 1] } else { [2 * k + 2; 2] };
        text += &format!("f {a}//{n} {b}//{m} {}//{m} {}//{n}\n", b + 1, a + 1);
    }
    for (first, normal) in [(2, 2 * sides + 1), (1, 2 * sides + 2)] {
        let corner = |k: u32| format!(" {}//{normal}", 2 * k + first);
        let corners: Vec<String> = if first == 2 {
            (0..sides).map(corner).collect()
        } else {
            (0..sides).rev().map(corner).collect()
        };
        text += &format!("f{}\n", corners.concat());
    }
    text
}

fn scene(text: &str) -> Scene {
    Scene::from_bytes(text.as_bytes(), ModelFormat::Obj).expect("a scene")
}

fn patches(text: &str) -> (Mesh, Patches) {
    let mut mesh = Mesh::build(scene(text).to_soup());
    let patches = patches_by_evidence(&mut mesh, 40.0, false);
    (mesh, patches)
}

#[test]
fn normals_of_the_file_decide_what_is_round() {
    for sides in [8, 9, 12, 18, 40] {
        let (mesh, found) = patches(&cylinder(sides, true));
        assert_eq!(
            found.hard.count(),
            2 * sides as usize,
            "{sides} sides: the rims, and no line of the side"
        );
        let is_side = |face: usize| mesh.face_normals[face][2].abs() < 0.5;
        for (face, rounded) in found.rounded.iter().enumerate() {
            assert_eq!(*rounded, is_side(face), "{sides} sides, face {face}");
        }
        // Components that the file shades face by face are not round.
        let (_, faceted) = patches(&cylinder(sides, false));
        assert!(!faceted.rounded.contains(&true), "{sides} sides");
    }
}

/// Mesh of a solid whose normals are the means of the faces around each vertex.
fn averaged(Solid { positions, triangles }: Solid) -> Mesh {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in &triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        triangle.iter().for_each(|v| sums[*v as usize] += (b - a).cross(c - a));
    }
    let normals = sums.iter().map(|sum| sum.normalize().as_vec3().to_array()).collect();
    let corner_normals = triangles.clone();
    Mesh::build(Soup { positions, triangles, normals, corner_normals, ..Soup::default() })
}

/// A globe whose rings alternate between wide and narrow, two to one.
fn uneven_globe() -> Solid {
    let step = TAU / 16.0;
    globe(8).moved(|p| {
        let ring = (acos(p.z.clamp(-1.0, 1.0)) / step).round();
        let from_pole = step * (ring + if ring % 2.0 == 1.0 { 1.0 / 3.0 } else { 0.0 });
        (p.truncate().normalize_or_zero() * sin(from_pole)).extend(cos(from_pole))
    })
}

#[test]
fn facets_of_curved_surfaces_are_no_chamfers() {
    // The facets turn by more than 20 degrees and less than 40, and soft edges count half.
    for (name, solid) in [
        ("globe 5", globe(5)),
        ("globe 8", globe(8)),
        ("uneven globe", uneven_globe()),
        ("torus 16x12", torus(16, 12, 1.0, 0.4)),
    ] {
        let found = patches_by_evidence(&mut averaged(solid), 20.0, false);
        assert_eq!(found.hard.count(), 0, "{name}");
        assert!(!found.rounded.contains(&false), "{name}");
    }
}

#[test]
fn averaged_normals_make_no_ball_of_a_cube() {
    let mut mesh = averaged(cuboid(DVec3::NEG_ONE, DVec3::ONE));
    let found = patches_by_evidence(&mut mesh, 40.0, false);
    assert_eq!(found.hard.count(), 12);
    assert!(!found.rounded.contains(&true));
}

#[test]
fn a_single_sharp_edge_inside_a_figure_is_no_crease() {
    // Next to it the surface hardly turns.
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/bear.ply");
    let mut mesh = Mesh::build(Scene::open(path).expect("a model").to_soup());
    let turns = DihedralCosines::of(&mesh);
    let sharp = (0..mesh.edges.len()).filter(|edge| turns.of_two(*edge) < 0.76).count();
    assert!(sharp > 10, "{sharp} edges above 40 degrees");
    let found = patches_by_evidence(&mut mesh, 40.0, false);
    assert_eq!(found.hard.count(), 0);
}

#[test]
fn flat_sheets_that_touch_stay_flat() {
    // Four sheets in one plane around a vertex; two of them face the other way.
    let sheets = "v 0 0 0\nv 1 0.1 0\nv 1 1 0\nv 0.1 1 0\nv -1 0.1 0\nv -1 1 0\nv -0.1 1 0\n\
        v -1 -0.1 0\nv -1 -1 0\nv -0.1 -1 0\nf 1 2 3 4\nf 1 5 6 7\nf 1 8 9 10\n";
    assert!(!patches(sheets).1.rounded.contains(&true));
}

#[test]
fn a_cylinder_without_normals_is_round_and_a_roof_is_not() {
    let bare = |text: String| -> String {
        let lines = text.lines().filter(|line| !line.starts_with("vn"));
        let without = |word: &str| word.split("//").next().unwrap_or(word).to_owned();
        lines.map(|line| line.split(' ').map(without).collect::<Vec<_>>().join(" ") + "\n").collect()
    };
    for sides in [10, 12, 18, 40] {
        let (_, found) = patches(&bare(cylinder(sides, true)));
        assert_eq!(found.hard.count(), 2 * sides as usize);
        let round = found.rounded.iter().filter(|rounded| **rounded).count();
        assert_eq!(round, 2 * sides as usize, "the faces of the side, {sides} sides");
    }
    // The ridge turns by 10 degrees.
    let roof = "v -2 0 3\nv 2 0 3\nv 2 0.26 0\nv -2 0.26 0\nv 2 0 -3\nv -2 0 -3\nf 1 2 3 4\nf 4 3 5 6\n";
    assert!(!patches(roof).1.rounded.contains(&true));
}

fn drawn(text: &str, camera: &Camera, sets: &[&str]) -> Drawing {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let style = Style::load_with("ink", &sets).unwrap_or_else(|error| panic!("{error}"));
    render(&scene(text), camera, &style).expect("a drawing")
}

/// Largest distance (px) of the upper rim of the cylinder from the drawing.
fn rim_distance(drawing: &Drawing, camera: &Camera) -> f64 {
    let marks = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines).flat_map(|l| &l.marks);
    let ink = SegmentGrid::new(marks.flat_map(|mark| flatten_path(&mark.path, 0.01)).collect(), 4.0);
    let [right, up, _] = camera.axes();
    let scale = camera.height / 3.0;
    let place = |p: DVec3| {
        let from = p - camera.target;
        Point::new(camera.width / 2.0 + from.dot(right) * scale, camera.height / 2.0 - from.dot(up) * scale)
    };
    let [radius, half] = SIZE;
    (0..720)
        .map(|k| TAU * f64::from(k) / 720.0)
        .map(|turn| ink.distance(place(DVec3::new(radius * cos(turn), radius * sin(turn), half))))
        .fold(0.0, f64::max)
}

#[test]
fn rims_of_coarse_cylinders_are_circles() {
    let camera = orthographic(DVec3::new(6.0, 4.0, 7.0), DVec3::ZERO, 3.0);
    for sides in [9, 12, 18, 40] {
        let text = cylinder(sides, true);
        let off = |sets: &[&str]| rim_distance(&drawn(&text, &camera, sets), &camera);
        let round = off(&["lines.surfaces=evidence"]);
        assert!(round < 0.3, "{sides} sides: {round} px");
        let polygon = off(&["lines.surfaces=evidence", "lines.round_rims=off"]);
        let rise = SIZE[0] * (1.0 - cos(TAU / 2.0 / f64::from(sides))) * camera.height / 3.0;
        assert!(polygon > 0.5 * rise, "{sides} sides: {polygon} px");
    }
}

/// OBJ text of a ring along z, with the coordinates of a file with `decimals`.
fn ring(sides: u32, decimals: usize) -> String {
    let [radius, half] = SIZE;
    let mut text = String::new();
    for k in 0..sides {
        let turn = 0.37 + TAU * f64::from(k) / f64::from(sides);
        for (r, z) in [(radius, -half), (radius, half), (0.6 * radius, -half), (0.6 * radius, half)] {
            text += &format!("v {:.decimals$} {:.decimals$} {z}\n", r * cos(turn), r * sin(turn));
        }
    }
    for k in 0..sides {
        let [i, j] = [4 * k + 1, 4 * ((k + 1) % sides) + 1];
        for [a, b, c, d] in [
            [i, j, j + 1, i + 1],
            [j + 2, i + 2, i + 3, j + 3],
            [i + 1, j + 1, j + 3, i + 3],
            [j, i, i + 2, j + 2],
        ] {
            text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    text
}

#[test]
fn cylinders_seen_along_their_axis_are_circles() {
    for height in [2.5, 3.0, 4.0, 7.0, 20.0] {
        let camera = orthographic(DVec3::new(0.0, 0.0, 7.0), DVec3::ZERO, height);
        for sides in [9, 10, 12, 15, 16, 18, 24, 36, 48] {
            let lines = |text: &str| {
                let drawing = drawn(text, &camera, &["lines.surfaces=evidence"]);
                let lines = drawing.layers.into_iter().filter(|layer| layer.kind == LayerKind::Lines);
                lines.map(|layer| layer.marks.len()).sum::<usize>()
            };
            assert_eq!(lines(&cylinder(sides, true)), 1, "a cylinder of {sides} sides, {height}");
            for decimals in [4, 17] {
                assert_eq!(lines(&ring(sides, decimals)), 2, "a ring of {sides} sides, {height}");
            }
        }
    }
}

#[test]
fn evidence_decides_where_the_file_shades() {
    let camera = orthographic(DVec3::new(6.0, 4.0, 7.0), DVec3::ZERO, 3.0);
    let svg = |text: &str, surfaces: &str| {
        let drawing = drawn(text, &camera, &[&format!("lines.surfaces={surfaces}")]);
        drawing
            .layers
            .iter()
            .flat_map(|layer| &layer.marks)
            .map(|mark| mark.path.to_svg())
            .collect::<Vec<_>>()
    };
    let (smooth, flat) = (cylinder(12, true), cylinder(12, false));
    assert_eq!(svg(&smooth, "shaded"), svg(&smooth, "evidence"));
    assert_ne!(svg(&smooth, "shaded"), svg(&smooth, "statistics"));
    assert_eq!(svg(&flat, "shaded"), svg(&flat, "statistics"));
    // A roof without normals, in another component, changes nothing.
    let roof =
        "v -9 9 3\nv -8 9 3\nv -8 9 4\nv -9 9 4\nv -8 9.2 5\nv -9 9.2 5\nf -6 -5 -4 -3\nf -3 -4 -2 -1\n";
    let both = drawn(&(smooth + roof), &camera, &["lines.surfaces=shaded"]);
    assert!(rim_distance(&both, &camera) < 0.3);
}

#[test]
fn the_ridge_of_a_roof_does_not_depend_on_how_it_is_written() {
    const CORNERS: &str = "v -2 0 3\nv 2 0 3\nv 2 1 0\nv -2 1 0\nv 2 0 -3\nv -2 0 -3\n";
    const FACES: &str = "f 1 2 3 4\nf 4 3 5 6\n";
    let roofs = [
        ("plain", format!("{CORNERS}{FACES}")),
        ("wound the other way", format!("{CORNERS}f 1 2 3 4\nf 6 5 3 4\n")),
        ("a vertex on the eave", format!("{CORNERS}v 0 0 3\nf 1 7 2 3 4\nf 4 3 5 6\n")),
        ("a vertex on the ridge", format!("{CORNERS}v 0 1 0\nf 1 2 3 7 4\nf 4 7 3 5 6\n")),
        ("a face without area", format!("{CORNERS}{FACES}v 0 0 3\nf 1 7 2\n")),
        ("a doubled face", format!("{CORNERS}{FACES}f 4 3 2 1\n")),
        ("a doubled part", format!("{CORNERS}o one\n{FACES}o two\n{FACES}")),
    ];
    let camera = orthographic(DVec3::new(5.0, 6.0, 7.0), DVec3::ZERO, 8.0);
    for (name, text) in roofs {
        for surfaces in ["statistics", "evidence"] {
            let drawing = drawn(&text, &camera, &[&format!("lines.surfaces={surfaces}")]);
            let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
            let creases = marks.filter(|mark| mark.provenance.classes.contains(&"crease")).count();
            assert_eq!(creases, 1, "{name}, {surfaces}");
        }
    }
}
