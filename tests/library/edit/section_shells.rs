//! Sections of overlapping shells, surfaces with gaps and coplanar faces, against closed-form areas and
//! outline lengths.
//!
//! Also checks the hatching angles of cut faces.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};
use ligne::drawing::{Drawing, LayerKind, Page, Unit};
use ligne::edit::section::{Plane, Section, cut};
use ligne::geometry::numbers::portable_math::{atan2, cos, sin};
use ligne::kurbo::{ParamCurveArclen as _, PathEl, Point};
use ligne::pipeline::{Renderer, with_cut_hatching_for};
use ligne::scene::{Geometry, Part};
use ligne::{Camera, Scene, Style};

use crate::library::support::pipeline::orthographic;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid};

fn scene_of(solids: impl IntoIterator<Item = Solid>) -> Scene {
    let mut scene = Scene::default();
    for Solid { positions, triangles } in solids {
        let geometry = scene.geometries.len();
        scene.geometries.push(Geometry { positions, triangles, ..Geometry::default() });
        let name = format!("part {geometry}");
        scene.parts.push(Part { name, geometry, world_from_part: DAffine3::IDENTITY });
    }
    scene
}

fn area(section: &Section) -> f64 {
    section.faces.iter().map(|faces| faces.area).sum()
}

/// Drawing of a section across y with hatched cut faces, seen along y at 100 px per unit.
fn drawn(mut section: Section, preset: &str) -> Drawing {
    let camera = orthographic(DVec3::NEG_Y * 50.0, DVec3::ZERO, 10.0).with_frame(1000.0, 1000.0);
    let camera = Camera { up: DVec3::Z, ..camera };
    let style = Style::preset(preset).expect("a style");
    let style = with_cut_hatching_for(&style, &mut section.scene, &mut section.faces, &[camera]);
    let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
    Renderer::new(&section.scene, &style).draw(&camera, page).expect("a drawing").0
}

/// Total length of the visible lines, px.
fn ink_length(drawing: &Drawing) -> f64 {
    let lines = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
    let paths = lines.flat_map(|layer| &layer.marks).flat_map(|mark| mark.path.segments());
    paths.map(|segment| segment.arclen(1e-6)).sum()
}

/// Prism about the x axis over a regular polygon with a corner at y = 0.
fn shaft(corners: u32, radius: f64, from: f64, to: f64) -> Solid {
    let mut solid = Solid::default();
    for k in 0..corners {
        let angle = TAU * f64::from(k) / f64::from(corners);
        let rim = DVec3::new(0.0, radius * sin(angle), radius * cos(angle));
        solid.positions.extend([rim + DVec3::X * from, rim + DVec3::X * to]);
    }
    let at = |k: u32| k % corners * 2;
    for k in 0..corners {
        let [a, b, c, d] = [at(k), at(k + 1), at(k + 1) + 1, at(k) + 1];
        solid.triangles.extend([[a, c, b], [a, d, c]]);
        if k > 1 {
            solid.triangles.extend([[0, at(k - 1), at(k)], [1, at(k) + 1, at(k - 1) + 1]]);
        }
    }
    let inward = solid
        .triangles
        .iter()
        .map(|t| t.map(|v| solid.positions[v as usize]))
        .map(|[a, b, c]| a.dot(b.cross(c)))
        .sum::<f64>()
        < 0.0;
    if inward {
        solid.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    solid
}

fn across_y(at: f64) -> Plane {
    // Everything with smaller y is removed.
    Plane::new(DVec3::Y * at, DVec3::NEG_Y).expect("a direction")
}

#[test]
fn overlapping_shells_have_one_section_outline() {
    let mut dice = Dice::new(573);
    for round in 0..12 {
        // A stepped shaft of overlapping prisms, all shells of one part. Their corners lie in the plane or
        // very near it.
        let steps: Vec<(f64, f64, f64)> = (0..4)
            .map(|k| {
                let from = -4.0 + 2.0 * f64::from(k);
                (dice.between(0.5, 3.0), from - dice.between(0.1, 0.4), from + 2.0 + dice.between(0.1, 0.4))
            })
            .collect();
        let corners = 4 * (2 + dice.below(5) as u32);
        let mut solid = Solid::default();
        for (k, (radius, from, to)) in steps.iter().enumerate() {
            let shift = [0.0, 3e-10, -2e-9, 1e-12][(k + round) % 4];
            solid.add(shaft(corners, *radius, *from, *to).moved(|p| p + DVec3::Y * shift));
        }
        // Profile: the largest radius at each x.
        let mut places: Vec<f64> = steps.iter().flat_map(|step| [step.1, step.2]).collect();
        places.sort_by(f64::total_cmp);
        let height = |x: f64| steps.iter().filter(|s| s.1 < x && x < s.2).map(|s| s.0).fold(0.0, f64::max);
        let heights: Vec<(f64, f64)> =
            places.windows(2).map(|pair| (pair[1] - pair[0], height((pair[0] + pair[1]) / 2.0))).collect();
        let exact: f64 = heights.iter().map(|(length, height)| 2.0 * length * height).sum();
        let ends = [0.0].into_iter().chain(heights.iter().map(|own| own.1)).chain([0.0]).collect::<Vec<_>>();
        let steps_up: f64 = ends.windows(2).map(|pair| (pair[0] - pair[1]).abs()).sum();
        let along: f64 = heights.iter().map(|(length, _)| length).sum();
        let outline = 100.0 * (2.0 * along + 2.0 * steps_up);
        // Offsets near a millionth of the size of the part are left out: there the edges of slivers are drawn
        // as well.
        for at in [0.0, 1e-10, -1e-10, 1e-9, -3e-8, 1e-7, 2e-6, 1e-3] {
            let section = cut(scene_of([solid.clone()]), &across_y(at), &[]);
            assert!(section.scene.warnings.is_empty(), "{round} at {at}: {}", section.scene.warnings);
            let found = area(&section);
            assert!((found - exact).abs() < 4e-3 * exact, "{round} at {at}: {found} instead of {exact}");
            let found = ink_length(&drawn(section, "ink"));
            assert!((found - outline).abs() < 0.01 * outline, "{round} at {at}: {found} px of {outline}");
        }
    }
}

#[test]
fn sections_through_and_near_box_faces_have_equal_areas() {
    let mut dice = Dice::new(574);
    for round in 0..30 {
        // Boxes with integer corners in one part. Many of their faces lie in the plane.
        let boxes: Vec<[DVec3; 2]> = (0..5)
            .map(|_| {
                let low = DVec3::from_array([0; 3].map(|_: i32| dice.below(5) as f64 - 4.0));
                [low, low + DVec3::from_array([0; 3].map(|_: i32| 1.0 + dice.below(4) as f64))]
            })
            .collect();
        // Whether a box covers a point. It is sampled on both sides of the plane.
        let covers = |x: f64, z: f64, y: f64| {
            boxes.iter().any(|[low, high]| {
                let p = DVec3::new(x, y, z);
                p.cmpgt(*low).all() && p.cmplt(*high).all()
            })
        };
        for y in [-3.0, -2.0, -1.0, 0.0] {
            let mut exact = 0.0;
            for (i, k) in (-4..8).flat_map(|i| (-4..8).map(move |k| (i, k))) {
                let (x, z) = (f64::from(i) + 0.5, f64::from(k) + 0.5);
                if covers(x, z, y + 0.5) && covers(x, z, y - 0.5) {
                    exact += 1.0;
                }
            }
            for beside in [0.0, 1e-10, -1e-10, 1e-13, -1e-7] {
                let mut one = Solid::default();
                boxes.iter().for_each(|[low, high]| one.add(cuboid(*low, *high)));
                let section = cut(scene_of([one]), &across_y(y + beside), &[]);
                let found = area(&section);
                assert!(
                    (found - exact).abs() < 1e-6,
                    "{round}, y = {y} + {beside}: {found} instead of {exact}"
                );
                assert!(section.scene.warnings.is_empty(), "{round}: {}", section.scene.warnings);
            }
        }
    }
}

#[test]
fn coplanar_faces_inside_another_shell_draw_no_line() {
    let big = cuboid(DVec3::new(-3.0, -3.0, -3.0), DVec3::new(3.0, 3.0, 3.0));
    let small = cuboid(DVec3::new(-1.0, 0.0, -1.0), DVec3::new(1.0, 2.0, 1.0));
    let beside = cuboid(DVec3::new(2.0, 0.0, -1.0), DVec3::new(4.0, 2.0, 1.0));
    let mut one = big.clone();
    one.add(small.clone());
    let section = cut(scene_of([one.clone()]), &across_y(0.0), &[]);
    assert!((area(&section) - 36.0).abs() < 1e-9);
    assert!((ink_length(&drawn(section, "ink")) - 2400.0).abs() < 2.0);
    // A second shell that is half outside. Its outer half is not a cut face, and its border is drawn.
    one.add(beside);
    let section = cut(scene_of([one]), &across_y(0.0), &[]);
    assert!((area(&section) - 36.0).abs() < 1e-9);
    let found = ink_length(&drawn(section, "ink"));
    assert!((found - 2800.0).abs() < 3.0, "{found}");
    // Where two parts overlap, the smaller one owns the area.
    let section = cut(scene_of([big, small]), &across_y(0.0), &[]);
    let areas: Vec<f64> = section.faces.iter().map(|faces| faces.area).collect();
    assert!((areas[0] - 32.0).abs() < 1e-9 && (areas[1] - 4.0).abs() < 1e-9, "{areas:?}");
}

#[test]
fn small_surface_gaps_are_closed_and_large_ones_stay_open() {
    // A box with its upper side moved up by `by`.
    let opened = |by: f64| {
        let mut solid = cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
        let first = solid.positions.len() as u32;
        let copies = solid.positions.clone();
        solid.positions.extend(copies.iter().map(|p| *p + DVec3::Z * by));
        for triangle in &mut solid.triangles {
            if triangle.iter().all(|v| copies[*v as usize].z > 0.0) {
                *triangle = triangle.map(|v| v + first);
            }
        }
        solid
    };
    for by in [1e-12, 1e-8, 1e-6, 1e-4] {
        let section = cut(scene_of([opened(by)]), &across_y(0.1), &[]);
        assert!((area(&section) - 4.0).abs() < 2e-3, "{by}: {}", area(&section));
        assert!(section.scene.warnings.is_empty(), "{by}: {}", section.scene.warnings);
    }
    for by in [1e-2, 0.3] {
        let section = cut(scene_of([opened(by)]), &across_y(0.1), &[]);
        assert_eq!(section.faces.len(), 0, "{by}");
        let warnings = section.scene.warnings.lines();
        assert!(warnings.iter().any(|line| line.contains("do not close")), "{warnings:?}");
        let drawing = drawn(section, "technical");
        assert!(drawing.layers.iter().all(|layer| layer.kind != LayerKind::Hatching));
        assert!(ink_length(&drawing) > 700.0);
    }
}

/// Part name and angle in degrees of each hatch line.
fn hatch_angles(drawing: &Drawing) -> Vec<(String, f64)> {
    let hatching = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Hatching);
    let mut found = Vec::new();
    for mark in hatching.flat_map(|layer| &layer.marks) {
        let name = mark.provenance.part.as_deref().unwrap_or_default().to_owned();
        let mut start = Point::ZERO;
        for element in mark.path.elements() {
            match element {
                PathEl::MoveTo(p) => start = *p,
                PathEl::LineTo(p) => {
                    let way = *p - std::mem::replace(&mut start, *p);
                    if way.hypot() > 5.0 {
                        found.push((name.clone(), atan2(-way.y, way.x).to_degrees().rem_euclid(180.0)));
                    }
                }
                other => panic!("{other:?}"),
            }
        }
    }
    found
}

fn angle_between(a: f64, b: f64) -> f64 {
    let apart = (a - b).rem_euclid(180.0);
    apart.min(180.0 - apart)
}

#[test]
fn hatching_avoids_long_sides_and_differs_between_neighbours() {
    let mut dice = Dice::new(575);
    for round in 0..40 {
        let degrees = if round < 8 { f64::from(round) * 22.5 } else { dice.between(0.0, 180.0) };
        let (s, c) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
        let turned = |p: DVec3| DVec3::new(p.x * c - p.z * s, p.y, p.x * s + p.z * c);
        let thickness = dice.between(0.3, 2.0);
        let one = cuboid(DVec3::new(-3.0, -1.0, 0.0), DVec3::new(3.0, 1.0, thickness)).moved(turned);
        let other = cuboid(DVec3::new(-3.0, -1.0, -thickness), DVec3::new(3.0, 1.0, 0.0)).moved(turned);
        let section = cut(scene_of([one, other]), &across_y(0.1), &[]);
        let kinds: Vec<usize> = section.faces.iter().map(|faces| faces.kind).collect();
        assert_eq!(kinds.len(), 2);
        let lines = hatch_angles(&drawn(section, "technical"));
        assert!(lines.len() > 10);
        for (name, angle) in &lines {
            assert!(
                angle_between(*angle, degrees) > 9.99,
                "{round}: {name} at {angle}, its sides at {degrees}"
            );
        }
        // Neighbours differ in angle or spacing.
        let of =
            |name: &str| lines.iter().filter(|line| line.0 == name).map(|line| line.1).collect::<Vec<_>>();
        let [a, b] = ["part 0", "part 1"].map(of);
        assert!(
            angle_between(a[0], b[0]) > 5.0 || a.len().abs_diff(b.len()) > 3,
            "{round}: {} and {}",
            a[0],
            b[0]
        );
    }
}

#[test]
fn parts_without_long_sides_are_hatched_at_45_degrees() {
    for (corners, radius) in [(64, 3.0), (128, 2.0)] {
        let mut solid = shaft(corners, radius, -1.0, 1.0);
        // Turns the axis to y.
        solid = solid.moved(|p| DVec3::new(p.y, p.x, -p.z));
        let section = cut(scene_of([solid]), &across_y(0.1), &[]);
        let lines = hatch_angles(&drawn(section, "technical"));
        assert!(lines.len() > 20 && lines.iter().all(|line| angle_between(line.1, 45.0) < 0.01), "{lines:?}");
    }
    let upright = cuboid(DVec3::new(-1.0, -1.0, -3.0), DVec3::new(1.0, 1.0, 3.0));
    let lines = hatch_angles(&drawn(cut(scene_of([upright]), &across_y(0.1), &[]), "technical"));
    assert!(lines.iter().all(|line| angle_between(line.1, 45.0) < 0.01));
}
