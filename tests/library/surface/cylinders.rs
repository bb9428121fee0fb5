//! Cylinders detected in meshes, compared with solids of known axes and with the cylindrical surfaces of STEP
//! sources.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;

use glam::{DMat3, DVec3};
use ligne::Scene;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::mesh::Mesh;
use ligne::surface::Cylinder;
use ligne::surface::cylinders;

use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::round_solids::icosphere;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus};

/// A pipe around the z axis, from z = 0 to `height`. `inner` is the radius of its hole.
fn pipe(corners: u32, outer: f64, inner: f64, height: f64) -> Solid {
    let mut solid = Solid::default();
    for k in 0..corners {
        let angle = TAU * f64::from(k) / f64::from(corners);
        let rim = DVec3::new(cos(angle), sin(angle), 0.0);
        let up = DVec3::Z * height;
        solid.positions.extend([rim * outer, rim * outer + up, rim * inner, rim * inner + up]);
    }
    for k in 0..corners {
        let at = |k: u32, of: u32| k % corners * 4 + of;
        let mut quad = |a: u32, b: u32, c: u32, d: u32| solid.triangles.extend([[a, b, c], [a, c, d]]);
        quad(at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1));
        quad(at(k, 2), at(k, 3), at(k + 1, 3), at(k + 1, 2));
        quad(at(k, 1), at(k + 1, 1), at(k + 1, 3), at(k, 3));
        quad(at(k, 0), at(k, 2), at(k + 1, 2), at(k + 1, 0));
    }
    solid
}

fn find_cylinders(solid: Solid) -> Vec<Cylinder> {
    let scene = Scene::from_triangles(solid.positions, solid.triangles).expect("a scene");
    cylinders(&Mesh::build(scene.to_soup()))
}

#[test]
fn pipes_have_two_cylinders_in_any_pose() {
    let mut dice = Dice::new(9);
    for corners in [12, 24, 57] {
        let (turn, shift): (DMat3, DVec3) = (dice.turn(), dice.point(50.0));
        let own = find_cylinders(pipe(corners, 5.0, 3.0, 8.0).moved(|p| turn * p + shift));
        assert_eq!(own.len(), 2, "{own:?}");
        for (cylinder, (radius, hollow)) in own.iter().zip([(5.0, false), (3.0, true)]) {
            let axis = turn * DVec3::Z;
            assert!(
                (cylinder.radius - radius).abs() < 1e-9 * radius && cylinder.is_hole == hollow,
                "{cylinder:?}"
            );
            assert!(cylinder.axis.cross(axis).length() < 1e-9);
            let aside = cylinder.point - shift;
            assert!((aside - axis * aside.dot(axis)).length() < 1e-9, "{cylinder:?}");
            assert!((cylinder.ends[1] - cylinder.ends[0] - 8.0).abs() < 1e-9);
            assert!((cylinder.arc - TAU).abs() < 1e-9, "{}", cylinder.arc);
        }
    }
}

#[test]
fn balls_tori_and_boxes_have_no_cylinders() {
    for solid in [cuboid(DVec3::ZERO, DVec3::ONE), sphere(12, 2.0), icosphere(3), torus(40, 20, 4.0, 1.0)] {
        let own = find_cylinders(solid);
        assert!(own.is_empty(), "{own:?}");
    }
}

/// Returns the statements of a STEP file by number, as name and arguments.
fn statements(text: &str) -> BTreeMap<u32, (String, String)> {
    let of = |statement: &str| {
        let (number, rest) = statement.trim().strip_prefix('#')?.split_once('=')?;
        let (name, arguments) = rest.trim().split_once('(')?;
        let number = number.trim().parse().ok()?;
        Some((number, (name.trim().to_owned(), arguments.trim_end_matches(')').to_owned())))
    };
    text.replace(['\n', '\r'], "").split(';').filter_map(of).collect()
}

/// Returns the distinct cylindrical surfaces of a single-part STEP file: axis point, axis direction and
/// radius.
fn step_cylinders(text: &str) -> Vec<(DVec3, DVec3, f64)> {
    let all = statements(text);
    let references = |arguments: &str| -> Vec<u32> {
        arguments.split(['#', ',', ' ']).filter_map(|word| word.parse().ok()).collect()
    };
    let triple = |number: u32| {
        let (_, arguments) = &all[&number];
        let inner = arguments.split('(').nth(1).expect("three numbers").trim_matches([')', ' ']);
        let numbers: Vec<f64> = inner.split(',').map(|n| n.trim().parse().expect("a number")).collect();
        DVec3::new(numbers[0], numbers[1], numbers[2])
    };
    let mut found: Vec<(DVec3, DVec3, f64)> = Vec::new();
    for (name, arguments) in all.values().filter(|(name, _)| name == "CYLINDRICAL_SURFACE") {
        let place = references(arguments)[0];
        let radius: f64 = arguments.rsplit(',').next().and_then(|r| r.trim().parse().ok()).expect(name);
        let parts = references(&all[&place].1);
        let (point, axis) = (triple(parts[0]), triple(parts[1]));
        let is_same = |known: &(DVec3, DVec3, f64)| {
            let apart = point - known.0;
            known.1.cross(axis).length() < 1e-6
                && (known.2 - radius).abs() < 1e-6
                && (apart - axis * apart.dot(axis)).length() < 1e-6
        };
        if !found.iter().any(is_same) {
            found.push((point, axis, radius));
        }
    }
    found
}

/// Returns the cylinders of a model. In assemblies, each shape is searched in its local frame, as in STEP
/// files.
fn model_cylinders(path: &std::path::Path, is_assembly: bool) -> Vec<Cylinder> {
    let scene = Scene::open(path).expect("a model");
    if !is_assembly {
        return cylinders(&Mesh::build(scene.to_soup()));
    }
    let alone = |number: usize| {
        let part = scene.parts.iter().find(|part| part.geometry == number)?.clone();
        let part = ligne::scene::Part { world_from_part: glam::DAffine3::IDENTITY, ..part };
        let mut one = scene.clone();
        one.parts = vec![part];
        Some(cylinders(&Mesh::build(one.to_soup())))
    };
    (0..scene.geometries.len()).filter_map(alone).flatten().collect()
}

#[test]
fn cylinders_of_cad_sources_are_found() {
    let (mut all, mut hit) = (0, 0);
    for (name, ending) in
        [("bracket", "stl"), ("gear", "stl"), ("elbow", "obj"), ("drive", "glb"), ("conveyor", "glb")]
    {
        let (Some(step), Some(model)) = (
            shared_folder::find(&format!("cad/{name}.step")),
            shared_folder::find(&format!("cad/{name}.{ending}")),
        ) else {
            continue;
        };
        let told = step_cylinders(&fs::read_to_string(step).expect("a file"));
        let own = model_cylinders(&model, ending == "glb");
        let mut missed = 0;
        for (point, axis, radius) in &told {
            let is_it = |found: &&Cylinder| {
                let apart = found.point - *point;
                found.axis.cross(*axis).length() < 1e-3
                    && (found.radius - radius).abs() < 0.01 * radius
                    && (apart - *axis * apart.dot(*axis)).length() < 0.01 * radius
            };
            if !own.iter().any(|found| is_it(&found)) {
                missed += 1;
                println!("{name}: no cylinder of radius {radius} at {point} along {axis}");
            }
        }
        (all, hit) = (all + told.len(), hit + told.len() - missed);
        let whole = own.iter().filter(|cylinder| cylinder.arc > 0.9 * TAU).count();
        println!(
            "{name}: {} told, {missed} missed, {} found in all, {whole} of them whole",
            told.len(),
            own.len()
        );
    }
    println!("{hit} of {all}");
    assert!(hit * 100 >= all * 95, "{hit} of {all}");
}
