//! Sections by planes: cut areas against closed forms and rows of rays, closed results and open surfaces.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};
use ligne::edit::section::{Plane, Section, cut};
use ligne::geometry::names::glob::Glob;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::load::ModelFormat;
use ligne::mesh::{EdgeFaces, FaceId, Mesh};
use ligne::scene::{Geometry, Part, UpAxis};
use ligne::{Camera, Scene, Style};

use crate::library::support::properties::picture::Picture;
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::round_solids::icosphere;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus};

pub(crate) fn add_part(scene: &mut Scene, name: &str, solid: Solid) {
    let geometry = scene.geometries.len();
    let Solid { positions, triangles } = solid;
    scene.geometries.push(Geometry { positions, triangles, ..Geometry::default() });
    scene.parts.push(Part { name: name.into(), geometry, world_from_part: DAffine3::IDENTITY });
}

fn scene_of(solid: Solid) -> Scene {
    let mut scene = Scene::default();
    add_part(&mut scene, "solid", solid);
    scene
}

pub(crate) fn inside_out(mut solid: Solid) -> Solid {
    solid.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    solid
}

pub(crate) fn plane(point: DVec3, normal: DVec3) -> Plane {
    Plane::new(point, normal).expect("a direction")
}

/// Prism about the z axis over a regular polygon, from z = −1 to 1.
pub(crate) fn prism(corners: u32, radius: f64) -> Solid {
    let mut solid = Solid::default();
    for k in 0..corners {
        let angle = TAU * f64::from(k) / f64::from(corners);
        let rim = DVec3::new(radius * cos(angle), radius * sin(angle), 0.0);
        solid.positions.extend([rim - DVec3::Z, rim + DVec3::Z]);
    }
    let bottom = |k: u32| k % corners * 2;
    for k in 0..corners {
        let [a, b, c, d] = [bottom(k), bottom(k + 1), bottom(k + 1) + 1, bottom(k) + 1];
        solid.triangles.extend([[a, b, c], [a, c, d]]);
        if k > 1 {
            solid.triangles.extend([[0, bottom(k), bottom(k - 1)], [1, bottom(k - 1) + 1, bottom(k) + 1]]);
        }
    }
    solid
}

pub(crate) fn area(section: &Section) -> f64 {
    section.faces.iter().map(|faces| faces.area).sum()
}

fn volume(scene: &Scene) -> f64 {
    let soup = scene.to_soup();
    let corner = |v: u32| soup.positions[v as usize];
    soup.triangles.iter().map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2])))).sum::<f64>() / 6.0
}

/// Number of edges without two consistently oriented faces.
fn open_edges(scene: &Scene) -> usize {
    let mesh = Mesh::build(scene.to_soup());
    let is_closed = |e: &usize| matches!(mesh.edges.faces(*e), EdgeFaces::Two { same_way: false, .. });
    (0..mesh.edges.len()).filter(|e| !is_closed(e)).count()
}

/// Area of a section by scan lines: rows of rays in the plane, inside where their signed crossings do not
/// cancel.
fn area_by_rows(solid: &Solid, plane: &Plane, half: f64, rows: u32) -> f64 {
    let at = |x: f64, y: f64| plane.raised(glam::DVec2::new(x, y));
    let step = 2.0 * half / f64::from(rows);
    let mut inside = 0.0;
    for row in 0..rows {
        let y = -half + (f64::from(row) + 0.5) * step;
        let (from, to) = (at(-half, y), at(half, y));
        let mut crossings: Vec<(f64, i32)> = Vec::new();
        for t in &solid.triangles {
            let [a, b, c] = t.map(|v| solid.positions[v as usize]);
            let normal = (b - a).cross(c - a);
            let rate = (to - from).dot(normal);
            let share = (a - from).dot(normal) / rate;
            if !(0.0..=1.0).contains(&share) {
                continue;
            }
            let p = from + (to - from) * share;
            let within = |u: DVec3, v: DVec3| (v - u).cross(p - u).dot(normal) >= 0.0;
            if within(a, b) && within(b, c) && within(c, a) {
                crossings.push((share, if rate < 0.0 { 1 } else { -1 }));
            }
        }
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut depth = 0;
        for pair in crossings.windows(2) {
            depth += pair[0].1;
            if depth != 0 {
                inside += (pair[1].0 - pair[0].0) * 2.0 * half * step;
            }
        }
    }
    inside
}

#[test]
fn cut_areas_match_closed_forms() {
    let close = |section: &Section, exact: f64| {
        let found = area(section);
        assert!((found - exact).abs() <= 1e-9 * exact, "{found} instead of {exact}");
    };
    let block = || scene_of(cuboid(DVec3::new(-1.0, -2.0, -3.0), DVec3::new(1.0, 2.0, 3.0)));
    close(&cut(block(), &plane(DVec3::ZERO, DVec3::X), &[]), 24.0);
    close(&cut(block(), &plane(DVec3::new(0.0, 0.0, 1.5), DVec3::Z), &[]), 8.0);
    close(&cut(block(), &plane(DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0)), &[]), 2.0 * 2f64.sqrt() * 4.0);
    // A prism cut across its axis, along it through two edges, and at an angle.
    let n = 24;
    let polygon = f64::from(n) / 2.0 * sin(TAU / f64::from(n)) * 4.0;
    close(&cut(scene_of(prism(n, 2.0)), &plane(DVec3::ZERO, DVec3::Z), &[]), polygon);
    close(&cut(scene_of(prism(n, 2.0)), &plane(DVec3::ZERO, DVec3::Y), &[]), 8.0);
    let slanting = DVec3::new(0.3, 0.0, 1.0);
    close(&cut(scene_of(prism(n, 2.0)), &plane(DVec3::ZERO, slanting), &[]), polygon * slanting.length());
    // A ball with a cavity that contains a core.
    let ball = |radius: f64| sphere(16, radius);
    let equator = |radius: f64| 16.0 * sin(TAU / 32.0) * radius * radius;
    let mut nested = ball(3.0);
    nested.add(inside_out(ball(2.0)));
    nested.add(ball(1.0));
    close(
        &cut(scene_of(nested), &plane(DVec3::ZERO, DVec3::Z), &[]),
        equator(3.0) - equator(2.0) + equator(1.0),
    );
    // A torus cut along its axis gives two polygons, across its axis a ring.
    let ring = |m: u32, r: f64| f64::from(m) / 2.0 * sin(TAU / f64::from(m)) * r * r;
    let across = cut(scene_of(torus(40, 16, 4.0, 1.0)), &plane(DVec3::ZERO, DVec3::Y), &[]);
    close(&across, 2.0 * ring(16, 1.0));
    close(
        &cut(scene_of(torus(40, 16, 4.0, 1.0)), &plane(DVec3::ZERO, DVec3::Z), &[]),
        ring(40, 5.0) - ring(40, 3.0),
    );
    // Overlapping solids of one part count as their union.
    let mut crossed = cuboid(DVec3::new(-3.0, -1.0, -1.0), DVec3::new(3.0, 1.0, 1.0));
    crossed.add(cuboid(DVec3::new(-1.0, -3.0, -1.0), DVec3::new(1.0, 3.0, 1.0)));
    close(&cut(scene_of(crossed), &plane(DVec3::ZERO, DVec3::Z), &[]), 20.0);
}

#[test]
fn nested_balls_of_opposite_winding_are_hollow() {
    let equator = |radius: f64| 16.0 * sin(TAU / 32.0) * radius * radius;
    let camera = Camera { width: 300.0, height: 300.0, ..Camera::three_quarter_of(UpAxis::Y) };
    let styles = ["toon", "pencil", "pencil-object", "technical"];
    let mut first: [Option<Vec<String>>; 2] = [None, None];
    for flags in 0..4 {
        let is_hollow = flags == 1 || flags == 2;
        let wound = |inward: bool, solid: Solid| if inward { inside_out(solid) } else { solid };
        let mut ball = wound(flags & 1 == 1, sphere(16, 3.0));
        ball.add(wound(flags & 2 == 2, sphere(16, 2.0)));
        let section = cut(scene_of(ball), &plane(DVec3::ZERO, DVec3::Z), &[]);
        let (found, exact) = (area(&section), equator(3.0) - if is_hollow { equator(2.0) } else { 0.0 });
        assert!((found - exact).abs() < 1e-9 * exact, "{flags}: {found} instead of {exact}");
        // Surfaces inside a union are kept, so only hollow results must be closed.
        assert!(!is_hollow || open_edges(&section.scene) == 0);
        let drawn = styles.map(|name| {
            let style = Style::load(name).unwrap();
            let drawing =
                ligne::pipeline::render(&section.scene, &camera.fit(&section.scene), &style).unwrap();
            Picture::of_drawing(drawing).bytes().to_owned()
        });
        let first = &mut first[usize::from(is_hollow)];
        assert!(first.get_or_insert(drawn.to_vec()) == &drawn.to_vec(), "{flags}");
    }
}

#[test]
fn cut_areas_match_rows_of_rays() {
    let mut dice = Dice::new(11);
    for round in 0..8 {
        let mut solid = torus(18, 12, 3.0, 1.2);
        solid.add(icosphere(2).moved(|p| p * 1.7 + DVec3::new(2.0, 0.5, 0.3)));
        solid.add(inside_out(sphere(8, 0.6).moved(|p| p + DVec3::new(-3.0, 0.0, 0.1))));
        let mut number = || dice.between(-1.0, 1.0);
        let normal = DVec3::new(number(), number(), number());
        let plane = plane(DVec3::new(number(), number(), number()) * 0.5, normal);
        let slow = area_by_rows(&solid, &plane, 7.0, 20_000);
        let found = area(&cut(scene_of(solid), &plane, &[]));
        assert!((found - slow).abs() < 2e-5 * slow, "round {round}: {found} and {slow}");
    }
}

#[test]
fn both_halves_are_closed_and_sum_to_the_whole() {
    let mut dice = Dice::new(5);
    let solids =
        [cuboid(DVec3::splat(-1.0), DVec3::splat(1.0)), torus(24, 12, 3.0, 1.0), icosphere(3), prism(7, 1.5)];
    for (k, solid) in solids.iter().enumerate() {
        for round in 0..6 {
            let mut number = || dice.between(-1.0, 1.0);
            let normal = DVec3::new(number(), number(), number());
            let plane = plane(normal * 0.3 * f64::from(round), normal);
            let [behind, before] =
                [plane, plane.turned()].map(|plane| cut(scene_of(solid.clone()), &plane, &[]));
            let whole = volume(&scene_of(solid.clone()));
            let halves = volume(&behind.scene) + volume(&before.scene);
            assert!((whole - halves).abs() < 1e-12 * whole, "solid {k}: {whole} and {halves}");
            assert!((area(&behind) - area(&before)).abs() < 1e-12);
            assert_eq!(
                [&behind, &before].map(|half| open_edges(&half.scene)),
                [0, 0],
                "solid {k}, round {round}"
            );
            assert!(behind.scene.warnings.is_empty());
        }
    }
}

#[test]
fn coplanar_vertices_edges_and_faces_are_cut_once() {
    // Vertices, edges and faces of these solids lie in the plane.
    let block = || cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    let on_top = plane(DVec3::Z, DVec3::Z);
    let under = cut(scene_of(block()), &on_top, &[]);
    assert_eq!((under.faces.len(), open_edges(&under.scene)), (0, 0));
    assert!((volume(&under.scene) - 8.0).abs() < 1e-12);
    let over = cut(scene_of(block()), &plane(DVec3::NEG_Z, DVec3::Z), &[]);
    assert!(over.scene.parts.is_empty());
    // A stair step whose tread lies in the plane: only the block behind its riser is cut.
    let mut step = Solid::default();
    let points = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    for [x, z] in points {
        step.positions.extend([DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)]);
    }
    let front = [[0u32, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]];
    step.triangles.extend(front.map(|t| t.map(|k| 2 * k)));
    step.triangles.extend(front.map(|[a, b, c]| [2 * a + 1, 2 * c + 1, 2 * b + 1]));
    for k in 0..6u32 {
        let n = (k + 1) % 6;
        step.triangles.extend([[2 * k, 2 * k + 1, 2 * n + 1], [2 * k, 2 * n + 1, 2 * n]]);
    }
    assert!((volume(&scene_of(step.clone())) - 3.0).abs() < 1e-12);
    let lower = cut(scene_of(step.clone()), &plane(DVec3::Z, DVec3::Z), &[]);
    assert!((area(&lower) - 1.0).abs() < 1e-12, "{}", area(&lower));
    assert_eq!(open_edges(&lower.scene), 0);
    let upper = cut(scene_of(step), &plane(DVec3::Z, DVec3::NEG_Z), &[]);
    assert!((area(&upper) - 1.0).abs() < 1e-12);
    assert_eq!(open_edges(&upper.scene), 0);
    assert!((volume(&lower.scene) + volume(&upper.scene) - 3.0).abs() < 1e-12);
    // An octahedron cut through four corners and the edges between them.
    let positions = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z].into();
    let mut eight = Solid { positions, ..Solid::default() };
    for k in 0..4u32 {
        let next = (k + 1) % 4;
        eight.triangles.extend([[k, next, 4], [next, k, 5]]);
    }
    let half = cut(scene_of(eight), &plane(DVec3::ZERO, DVec3::Z), &[]);
    assert!((area(&half) - 2.0).abs() < 1e-12);
    assert_eq!(open_edges(&half.scene), 0);
}

#[test]
fn open_section_outlines_are_left_open_and_counted() {
    let mut open = cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    // Two triangles of one side are missing.
    open.triangles.truncate(10);
    open.add(cuboid(DVec3::new(4.0, -1.0, -1.0), DVec3::new(6.0, 1.0, 1.0)));
    let section = cut(scene_of(open), &plane(DVec3::ZERO, DVec3::Z), &[]);
    assert!((area(&section) - 4.0).abs() < 1e-12, "{}", area(&section));
    let warnings = section.scene.warnings.lines();
    assert_eq!(warnings, ["1 outlines of cut surfaces that do not close, and are left open"]);
}

#[test]
fn uncut_parts_stay_whole_and_cut_neighbours_differ() {
    let mut scene = Scene::default();
    add_part(&mut scene, "left", cuboid(DVec3::new(-2.0, -1.0, -1.0), DVec3::new(0.0, 1.0, 1.0)));
    add_part(&mut scene, "right", cuboid(DVec3::new(0.0, -1.0, -1.0), DVec3::new(2.0, 1.0, 1.0)));
    add_part(&mut scene, "bolt 1", cuboid(DVec3::new(-3.0, -0.1, -0.1), DVec3::new(3.0, 0.1, 0.1)));
    add_part(&mut scene, "above", cuboid(DVec3::new(0.0, 0.0, 2.0), DVec3::new(1.0, 1.0, 3.0)));
    add_part(&mut scene, "far", cuboid(DVec3::new(9.0, -1.0, -1.0), DVec3::new(10.0, 1.0, 1.0)));
    let section = cut(scene, &plane(DVec3::ZERO, DVec3::Z), &[Glob::new("bolt*")]);
    let names: Vec<&str> = section.scene.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["left", "right", "bolt 1", "far"]);
    let of = |k: usize| (section.faces[k].part, section.faces[k].kind);
    assert_eq!([of(0), of(1), of(2)], [(0, 0), (1, 1), (3, 0)]);
    let name = |k: usize| &*section.scene.materials[section.faces[k].material as usize].name;
    assert_eq!([name(0), name(1), name(2)], ["cut 1", "cut 2", "cut 1"]);
}

#[test]
fn transformed_and_mirrored_parts_are_cut_in_place() {
    let mut scene = scene_of(cuboid(DVec3::splat(-1.0), DVec3::splat(1.0)));
    scene.parts[0].world_from_part = DAffine3::from_scale_rotation_translation(
        DVec3::new(2.0, -1.0, 3.0),
        glam::DQuat::IDENTITY,
        DVec3::X * 5.0,
    );
    let section = cut(scene, &plane(DVec3::X * 5.0, DVec3::X), &[]);
    assert!((area(&section) - 12.0).abs() < 1e-12);
    assert_eq!(open_edges(&section.scene), 0);
    assert!((volume(&section.scene) - 24.0).abs() < 1e-12);
}

#[test]
fn halves_of_closed_models_sum_to_the_whole() {
    for name in ["cad/bracket.glb", "cad/drive.glb", "cad/gear.stl"] {
        let Some(path) = shared_folder::find(name) else { continue };
        let scene = Scene::open(&path).expect("a model");
        let (low, high) = scene.bounds().expect("something to draw");
        for normal in [DVec3::X, DVec3::Y, DVec3::new(0.3, 1.0, -0.4)] {
            let plane = plane(low.lerp(high, 0.47), normal);
            let halves = [plane, plane.turned()].map(|plane| cut(scene.clone(), &plane, &[]));
            let whole = volume(&scene);
            let sum: f64 = halves.iter().map(|half| volume(&half.scene)).sum();
            assert!((sum - whole).abs() < 1e-9 * whole, "{name} {normal}: {sum} and {whole}");
            assert!((area(&halves[0]) - area(&halves[1])).abs() < 1e-9 * area(&halves[0]));
            assert!(halves[0].scene.warnings.is_empty(), "{name}: {}", halves[0].scene.warnings);
        }
    }
}

#[test]
fn stl_models_with_unshared_vertices_are_cut_closed() {
    // Each triangle has its own corners, as in STL.
    let solid = torus(20, 10, 3.0, 1.0);
    let mut stl = vec![0u8; 80];
    stl.extend((solid.triangles.len() as u32).to_le_bytes());
    for t in &solid.triangles {
        stl.extend([0u8; 12]);
        for v in t {
            let p = solid.positions[*v as usize].as_vec3();
            stl.extend(p.to_array().map(f32::to_le_bytes).as_flattened());
        }
        stl.extend([0u8; 2]);
    }
    let scene = Scene::from_bytes(&stl, ModelFormat::Stl).expect("a model");
    let section = cut(scene, &plane(DVec3::new(0.01, 0.02, 0.03), DVec3::new(0.2, 1.0, 0.1)), &[]);
    assert!(section.scene.warnings.is_empty() && section.faces.len() == 1);
    assert_eq!(open_edges(&section.scene), 0);
    let mesh = Mesh::build(section.scene.to_soup());
    assert!((0..mesh.triangles.len()).all(|f| mesh.corners(FaceId(f as u32)).iter().all(|p| p.is_finite())));
}
