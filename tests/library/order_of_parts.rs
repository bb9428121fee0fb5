//! The order of parts in a file changes no ownership: which part the line belongs to along which two parts
//! pass through each other is decided by what they are.

use std::collections::BTreeMap;

use crate::support::dice::Dice;
use crate::support::solids::{cuboid, sphere, tube};
use glam::{DAffine3, DVec3};
use ligne::drawing::Mark;
use ligne::render::render;
use ligne::scene::{Camera, Geometry, Part, Scene};
use ligne::style::Style;

/// The length of the lines along intersections that belong to each part, in hundredths of a px.
fn owned(scene: &Scene, camera: &Camera) -> BTreeMap<String, i64> {
    let style = Style::preset("technical").expect("a style of the project");
    let mut owned: BTreeMap<String, f64> = BTreeMap::new();
    for layer in &render(scene, camera, &style).unwrap().layers {
        let is_one = |mark: &&Mark| mark.provenance.classes.first() == Some(&"intersection");
        for mark in layer.marks.iter().filter(is_one) {
            let part = mark.provenance.part.as_deref().unwrap_or("none").to_owned();
            *owned.entry(part).or_default() +=
                mark.path.segments().map(|s| kurbo::ParamCurveArclen::arclen(&s, 1e-6)).sum::<f64>();
        }
    }
    owned.into_iter().map(|(part, length)| (part, (length * 100.0).round() as i64)).collect()
}

fn assert_order_does_not_matter(scene: &Scene, least: usize) {
    let mut camera = Camera::three_quarter_of(scene.up);
    (camera.width, camera.height) = (500.0, 500.0);
    let camera = camera.fit(scene);
    let own = owned(scene, &camera);
    assert!(own.len() >= least, "lines along intersections belong to {own:?}");
    let mut dice = Dice::new(47);
    for _ in 0..3 {
        let order = dice.shuffled((0..scene.parts.len()).collect());
        let mut other = scene.clone();
        other.parts = order.iter().map(|part| scene.parts[*part].clone()).collect();
        assert_eq!(owned(&other, &camera), own, "{order:?}");
    }
    let mut other = scene.clone();
    other.parts.reverse();
    assert_eq!(owned(&other, &camera), own, "reversed");
}

#[test]
fn solids_through_each_other_own_the_same_lines_in_any_order() {
    let mut dice = Dice::new(5);
    for _ in 0..4 {
        let mut scene = Scene::default();
        for k in 0..8 {
            let half = DVec3::new(dice.between(0.3, 1.0), dice.between(0.3, 1.0), dice.between(0.3, 1.0));
            let solid = match k % 3 {
                0 => cuboid(-half, half),
                1 => sphere(24, half.x),
                _ => tube(24, 3, half.x / 2.0, 2.0 * half.y),
            };
            let place = DAffine3::from_mat3_translation(dice.turn(), dice.point(0.9));
            scene.geometries.push(Geometry {
                positions: solid.positions,
                triangles: solid.triangles,
                ..Geometry::default()
            });
            scene.parts.push(Part { name: format!("part {k}"), geometry: k, world_from_part: place });
        }
        assert_order_does_not_matter(&scene, 3);
    }
}

#[test]
fn parts_of_equal_size_are_told_apart_by_their_places() {
    let cube = cuboid(DVec3::NEG_ONE, DVec3::ONE);
    let mut dice = Dice::new(6);
    let geometry = Geometry { positions: cube.positions, triangles: cube.triangles, ..Geometry::default() };
    let part = |k: usize| Part {
        name: format!("cube {k}"),
        geometry: 0,
        world_from_part: DAffine3::from_translation(dice.point(0.9)),
    };
    let parts = (0..5).map(part).collect();
    assert_order_does_not_matter(&Scene { geometries: vec![geometry], parts, ..Scene::default() }, 2);
}

#[test]
fn the_castle_owns_the_same_lines_in_any_order() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/castle.obj");
    assert_order_does_not_matter(&Scene::open(path).expect("a model of the project"), 3);
}
