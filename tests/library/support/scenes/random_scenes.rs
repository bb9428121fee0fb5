//! Random scenes and random cameras for them.

use glam::DVec3;
use ligne::scene::{Camera, Projection, Scene};

use super::random_dice::Dice;
use super::solids::{Solid, cuboid, sphere, torus};
use crate::library::support::pipeline::{orthographic, perspective, scene};

/// Kinds of random scenes.
pub(crate) const ALL_SCENE_KINDS: [&str; 7] =
    ["boxes", "tetrahedra", "spheres", "tori", "soup", "interpenetrating", "mixture"];

/// A random scene of one of the kinds in [`ALL_SCENE_KINDS`], about two units across.
pub(crate) fn random_scene(kind: &str, dice: &mut Dice) -> Scene {
    match kind {
        "boxes" => scene_of_many(dice, 8, 0.9, random_box),
        "tetrahedra" => scene_of_many(dice, 14, 0.9, random_tetrahedron),
        "spheres" => scene_of_many(dice, 4, 0.9, |dice| sphere(7, dice.between(0.2, 0.5))),
        "tori" => scene_of_many(dice, 3, 0.7, random_torus),
        "soup" => scene([triangle_soup(dice, 90)]),
        "interpenetrating" => scene_of_many(dice, 7, 0.25, random_box),
        _ => {
            let mut solids = vec![torus(24, 12, 0.8, 0.3), sphere(6, 0.5)];
            solids.extend([random_box(dice), random_tetrahedron(dice), triangle_soup(dice, 12)]);
            scene(solids.into_iter().map(|solid| randomly_placed(solid, 0.4, dice)).collect::<Vec<_>>())
        }
    }
}

/// Kinds of random cameras.
pub(crate) const ALL_CAMERA_KINDS: [&str; 5] = ["perspective", "orthographic", "inside", "cutting", "near"];

/// A random camera of one of the kinds in [`ALL_CAMERA_KINDS`], for scenes about the origin.
pub(crate) fn random_camera(kind: &str, dice: &mut Dice) -> Camera {
    let direction = dice.direction();
    let target = dice.point(0.1);
    match kind {
        "perspective" => perspective(direction * dice.between(4.0, 7.0), target, 35.0),
        "orthographic" => orthographic(direction * 5.0, target, 3.0),
        // A camera inside the scene, without an explicit near plane.
        "inside" => perspective(dice.point(0.5), direction * 2.0, 80.0),
        // A near plane that cuts through the scene.
        "cutting" => Camera { near: Some(5.0), ..perspective(direction * 5.0, target, 30.0) },
        // A near plane that cuts through the scene in an orthographic view.
        _ => Camera {
            near: Some(4.8),
            projection: Projection::Orthographic { height: 2.0 },
            ..orthographic(direction * 5.0, target, 2.0)
        },
    }
}

fn scene_of_many(dice: &mut Dice, count: usize, spread: f64, make: impl Fn(&mut Dice) -> Solid) -> Scene {
    let mut solids = Vec::new();
    for _ in 0..count {
        let solid = make(dice);
        solids.push(randomly_placed(solid, spread, dice));
    }
    scene(solids)
}

/// The solid with a random rotation and translation.
pub(crate) fn randomly_placed(solid: Solid, spread: f64, dice: &mut Dice) -> Solid {
    let (turn, place) = (dice.turn(), dice.point(spread));
    solid.moved(|p| turn * p + place)
}

fn random_box(dice: &mut Dice) -> Solid {
    let mut side = || dice.between(0.1, 0.5);
    let half = DVec3::new(side(), side(), side());
    cuboid(-half, half)
}

fn random_tetrahedron(dice: &mut Dice) -> Solid {
    let positions = (0..4).map(|_| dice.point(0.6)).collect();
    Solid { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] }
}

fn random_torus(dice: &mut Dice) -> Solid {
    let radius = dice.between(0.4, 0.7);
    torus(20, 10, radius, dice.between(0.15, 0.6) * radius)
}

fn triangle_soup(dice: &mut Dice, count: u32) -> Solid {
    let mut solid = Solid::default();
    for i in 0..count {
        let middle = dice.point(0.9);
        solid.positions.extend((0..3).map(|_| middle + dice.point(0.4)));
        solid.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    solid
}
